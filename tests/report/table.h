// A table of the page.
#pragma once

#include <string>
#include <vector>

namespace collision::report {

struct Table {
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  bool folded = false;  ///< Shown when it is asked for.
};

}  // namespace collision::report
