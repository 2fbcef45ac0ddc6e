// What is wrong with a field of a configuration.
#pragma once

#include <string>

namespace collision::server {

struct ConfigError {
  std::string field;  ///< Its path, as in "clock.kind".
  std::string what;
};

}  // namespace collision::server
