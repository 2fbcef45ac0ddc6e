// A folder for files that go with it.
#pragma once

#include <filesystem>
#include <string>

namespace collision::client {

/// In the folder for temporary files; removed with all that is in it.
class TemporaryFolder {
 public:
  /// Its name begins with `name`. Throws std::runtime_error if it cannot be made.
  explicit TemporaryFolder(const std::string& name);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string path() const { return path_.string(); }
  std::string Path(const std::string& file) const { return (path_ / file).string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace collision::client
