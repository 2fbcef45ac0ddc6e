// The files of the page, as browsers get them.
#pragma once

#include <map>
#include <string>

#include "client/programs/gateway/web/web_types.h"

namespace collision::gateway {

/// All files of a folder and below, read once. Any thread.
class PageFiles {
 public:
  /// Throws std::runtime_error, with the path and the cause, if there is no such folder, no
  /// index.html in it, or a file cannot be read.
  explicit PageFiles(const std::string& folder);

  /// The file of a path such as "/view/main.js"; "/" is /index.html. Status 404 if it is not there.
  /// FILE.gz is sent in place of FILE where the browser takes it.
  WebResponse Answer(const std::string& path, bool takes_gzip) const;

 private:
  std::map<std::string, Payload> files_;  ///< By path, from "/" on.
  std::string policy_;                    ///< Content-Security-Policy.
};

/// What a page may do: fetch from its own server, run that server's scripts and the import map that
/// stands in `index`, and nothing else.
std::string SecurityPolicyFor(const std::string& index);

}  // namespace collision::gateway
