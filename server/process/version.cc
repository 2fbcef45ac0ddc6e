#include "server/process/version.h"

namespace collision::server {

const char* Version() { return COLLISION_VERSION; }

}  // namespace collision::server
