// The version of this library.
#pragma once

namespace collision::client {

/// As the hello of a simulator tells it.
const char* LibraryVersion();

}  // namespace collision::client
