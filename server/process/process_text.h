// Which process this is, in words.
#pragma once

#include <string>

namespace collision::server {

/// "pid 1234 on host-a", with the name that the system gives this host.
std::string ProcessText();

}  // namespace collision::server
