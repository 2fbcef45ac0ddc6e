// The version of this build.
#pragma once

namespace collision::server {

/// As the status, recordings and --version tell it. Defined in a file of its own, so that tests can
/// build the service in another version.
const char* Version();

}  // namespace collision::server
