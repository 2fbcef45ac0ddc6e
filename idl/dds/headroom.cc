#include "idl/dds/headroom.h"

#include <fcntl.h>
#include <unistd.h>

#include <latch>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

namespace collision::dds {
namespace {

/// How many of so many further files can be open at once.
std::size_t FilesToBeHad(std::size_t wanted) {
  std::vector<int> files;
  while (files.size() < wanted) {
    const int file = open("/dev/null", O_RDONLY | O_CLOEXEC);
    if (file < 0) break;
    files.push_back(file);
  }
  for (const int file : files) close(file);
  return files.size();
}

void Require(const char* what, std::size_t there, std::size_t needed, const char* where) {
  if (there >= needed) return;
  throw std::runtime_error("only " + std::to_string(there) + " more " + what +
                           " can be had here, and " + std::to_string(needed) +
                           " are needed: raise " + where);
}

}  // namespace

std::size_t ThreadsToBeHad(std::size_t wanted) {
  std::latch counted(1);
  std::vector<std::jthread> threads;
  try {
    while (threads.size() < wanted) threads.emplace_back([&counted] { counted.wait(); });
  } catch (const std::system_error&) {
    // That is the answer.
  }
  counted.count_down();
  return threads.size();
}

void RequireHeadroom() {
  Require("files", FilesToBeHad(kFilesNeeded), kFilesNeeded,
          "the limit of open files (ulimit -n; LimitNOFILE= of a unit)");
  Require("threads", ThreadsToBeHad(kThreadsNeeded), kThreadsNeeded,
          "the limit of processes and threads (ulimit -u; TasksMax= of a unit, --pids-limit of a "
          "container) or of memory (ulimit -v)");
}

}  // namespace collision::dds
