// A page of one file, that shows a recorded world without a server.
#pragma once

#include <string>
#include <vector>

namespace collision::client {

struct SinglePageTitle {
  std::string name;       ///< Of the world, for the reader.
  std::string event_key;  ///< The event that is shown first; empty: none.
};

/// Puts the messages of a page (PageStream) into its template, which the build makes of the
/// gateway's page. Throws std::runtime_error if the template is none.
std::string SinglePage(const std::string& page_template, const SinglePageTitle& title,
                       const std::vector<std::string>& messages);

}  // namespace collision::client
