// The layers of the code, as rules over #include lines.
#pragma once

#include <string>
#include <vector>

namespace collision::source {

/// What one #include line names, without its brackets or quotes.
struct Include {
  int line = 0;
  std::string name;
  bool quoted = false;  ///< With "quotes": ours. With <brackets>: a library's.
};

/// The #include lines of a C++ file's text, in order.
std::vector<Include> Includes(const std::string& text);

/// One sentence, "path:line: ...", for each include of the file `path` (relative to the project's
/// root, with '/') that breaks the layers: each file includes only what its folder may stand on.
/// The rooms of the core are drawn in collision_core/README.md, "The layers"; the daemon stands on
/// core and idl/, the client on idl/ and almost nothing of the core, and the core on no other
/// folder. In a folder without an entry every include is refused.
std::vector<std::string> Violations(const std::string& path, const std::string& text);

}  // namespace collision::source
