// Files of tests that run at once.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <set>
#include <string>
#include <system_error>

namespace collision {

/// A path for this process alone, since each test is one; what is there is removed at its end.
inline std::string TemporaryPath(const std::string& name) {
  static struct Paths {
    const pid_t process = getpid();
    std::set<std::string> all = {};
    ~Paths() {
      if (getpid() != process) return;  // a copy of it that has been forked
      std::error_code ignored;
      for (const std::string& path : all) std::filesystem::remove_all(path, ignored);
    }
  } paths;
  return *paths.all.insert(testing::TempDir() + name + "." + std::to_string(getpid())).first;
}

}  // namespace collision
