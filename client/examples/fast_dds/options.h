// The command line of both programs.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace example {

struct Options {
  std::string world;         ///< COLLISION_WORLD, else "default".
  std::uint32_t domain = 0;  ///< COLLISION_DOMAIN, else 0.
  std::string simulator;     ///< Not empty: the option exists, with this default.
  double seconds = 0;        ///< 0: without end.
  bool help = false;
};

/// A word that cannot be used; what() says which, and what is allowed.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Reads the environment, then the words, over `defaults`. Throws UsageError.
Options ParseOptions(int argc, char** argv, Options defaults);

}  // namespace example
