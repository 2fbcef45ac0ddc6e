#include "tests/fuzz/scratch_file.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace collision::fuzz {
namespace {

std::string MemoryFolder() {
  const std::filesystem::path shared = "/dev/shm";
  return access(shared.c_str(), W_OK) == 0 ? shared.string()
                                           : std::filesystem::temp_directory_path().string();
}

}  // namespace

ScratchFile::ScratchFile(const std::string& name, Bytes bytes)
    : folder_(MemoryFolder() + "/collision-fuzz-" + std::to_string(getpid())),
      path_(folder_ + "/" + name) {
  std::filesystem::create_directory(folder_);
  std::ofstream file(path_, std::ios::binary | std::ios::trunc);
  file.write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw std::runtime_error(path_ + ": cannot be written");
}

ScratchFile::~ScratchFile() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

}  // namespace collision::fuzz
