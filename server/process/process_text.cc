#include "server/process/process_text.h"

#include <unistd.h>

namespace collision::server {

std::string ProcessText() {
  char host[65] = {};  // As long as Linux allows, and a zero.
  if (gethostname(host, sizeof host - 1) != 0 || host[0] == '\0')
    return "pid " + std::to_string(getpid());
  return "pid " + std::to_string(getpid()) + " on " + host;
}

}  // namespace collision::server
