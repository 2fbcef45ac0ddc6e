// The options that every benchmark takes.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace collision::bench {

struct CommonOptions {
  bool quick = false;
  std::string only;  ///< A part of a row's path; empty: everything.
  std::string json;  ///< The file for the results; empty: none.

  /// Adds --quick, --only and --json to a program. `quick_means` and `only_means` are their help.
  void AddTo(CLI::App* app, const std::string& quick_means, const std::string& only_means);

  bool Wants(const std::string& path) const { return path.find(only) != std::string::npos; }
};

}  // namespace collision::bench
