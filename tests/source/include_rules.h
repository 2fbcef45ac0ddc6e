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
/// root, with '/') that breaks the layers of DESIGN, section 4:
///   numeric <- motion, shape <- broad_phase <- narrow_phase <- detection <- server, and client
///   -> idl <- server.
std::vector<std::string> Violations(const std::string& path, const std::string& text);

}  // namespace collision::source
