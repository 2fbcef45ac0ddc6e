#include "server/process/write_all.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace collision::server {

std::string CauseOf(int error_number) { return std::generic_category().message(error_number); }

int WriteAll(int file, const std::string& bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t written = write(file, bytes.data() + done, bytes.size() - done);
    if (written < 0 && errno != EINTR) return errno;
    if (written > 0) done += static_cast<std::size_t>(written);
  }
  return 0;
}

bool IsRemoved(int file) {
  struct stat facts {};
  return fstat(file, &facts) == 0 && facts.st_nlink == 0;
}

}  // namespace collision::server
