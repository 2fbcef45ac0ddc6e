#include "tests/bench/harness/options.h"

#include <CLI/CLI.hpp>

namespace collision::bench {

void CommonOptions::AddTo(CLI::App* app, const std::string& quick_means,
                          const std::string& only_means) {
  app->add_flag("--quick", quick, quick_means);
  app->add_option("--json", json, "write every measurement and the figures to this file");
  app->add_option("--only", only, only_means);
}

}  // namespace collision::bench
