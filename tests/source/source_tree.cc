#include "tests/source/source_tree.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace collision::source {
namespace {

const std::filesystem::path kRoot = COLLISION_SOURCE_DIR;
const char* const kRooms[] = {"collision_core", "idl",    "server", "client",
                              "config",         "docker", "tests"};

}  // namespace

std::string ReadFile(const std::string& path) {
  std::ifstream file(kRoot / path, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf())) throw std::runtime_error("cannot read " + path);
  return text.str();
}

int CountLines(const std::string& text) {
  return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

std::vector<SourceFile> SourceFiles(const std::vector<std::string>& endings) {
  std::vector<SourceFile> files;
  for (const char* room : kRooms) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot / room)) {
      const std::string ending = entry.path().extension().string();
      if (!entry.is_regular_file() ||
          std::find(endings.begin(), endings.end(), ending) == endings.end()) {
        continue;
      }
      const std::string path = entry.path().lexically_relative(kRoot).generic_string();
      files.push_back({path, ReadFile(path)});
    }
  }
  std::sort(files.begin(), files.end(),
            [](const auto& a, const auto& b) { return a.path < b.path; });
  return files;
}

std::vector<SourceFile> Scripts() {
  std::vector<SourceFile> scripts = {{"run", ReadFile("run")}, {".ci/run", ReadFile(".ci/run")}};
  for (SourceFile& file : SourceFiles({""})) {
    if (file.text.rfind("#!", 0) == 0) scripts.push_back(std::move(file));
  }
  return scripts;
}

std::vector<std::string> PathsInRooms() {
  std::vector<std::string> paths;
  for (const char* room : kRooms) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot / room)) {
      paths.push_back(entry.path().lexically_relative(kRoot).generic_string() +
                      (entry.is_directory() ? "/" : ""));
    }
  }
  return paths;
}

bool Exists(const std::string& path) { return std::filesystem::exists(kRoot / path); }

}  // namespace collision::source
