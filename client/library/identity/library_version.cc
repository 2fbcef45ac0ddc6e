#include "client/library/identity/library_version.h"

namespace collision::client {

const char* LibraryVersion() { return COLLISION_VERSION; }

}  // namespace collision::client
