// The files of this project, as the tests of the source read them.
#pragma once

#include <string>
#include <vector>

namespace collision::source {

struct SourceFile {
  std::string path;  ///< Relative to the project's root, with '/'.
  std::string text;
};

/// The file `path`, relative to the project's root; throws std::runtime_error if it cannot be read.
std::string ReadFile(const std::string& path);

/// How many lines a text has.
int CountLines(const std::string& text);

/// Every file in the rooms of the project (not build/) whose name ends in one of `endings`, sorted
/// by path.
std::vector<SourceFile> SourceFiles(const std::vector<std::string>& endings);

/// The programs that are text: `run`, `.ci/run`, and the files in the rooms without an ending that
/// begin with "#!".
std::vector<SourceFile> Scripts();

/// Every file and folder in the rooms of the project, a folder with '/' at its end.
std::vector<std::string> PathsInRooms();

/// Whether the file or folder `path`, relative to the project's root, exists.
bool Exists(const std::string& path);

}  // namespace collision::source
