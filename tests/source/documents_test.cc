// Goal:   every file, folder and command that a document of the repository names exists, and every
//         file and folder that a script names.
// Method: links, and the words between backticks or in a block of shell commands that look like a
//         path of the repository, are looked up from the document's folder, from those above it
//         and from collision_core/. A star and a word in capitals (NAME) stand for any text. In a
//         script a path begins with a room, alone or after "$root/".
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>

#include "tests/source/source_tree.h"

namespace collision::source {
namespace {

std::vector<SourceFile> Documents() {
  std::vector<SourceFile> documents = SourceFiles({".md"});
  for (const char* path : {"README.md", "CHANGELOG.md"})
    documents.push_back({path, ReadFile(path)});
  return documents;
}

std::vector<std::string> Captures(const std::string& text, const std::regex& pattern) {
  std::vector<std::string> captures;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it) {
    captures.push_back((*it)[1]);
  }
  return captures;
}

/// The text between backticks, and the lines of ```sh blocks up to their comments.
std::vector<std::string> CodeOf(const std::string& text) {
  std::vector<std::string> code;
  std::string block;  // the fence that is open: "" or "```language"
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("```", 0) == 0) {
      block = block.empty() ? line : "";
    } else if (block == "```sh") {
      code.push_back(line.substr(0, line.find(" #")));
    } else if (block.empty()) {
      for (std::string& span : Captures(line, std::regex("`([^`]+)`"))) {
        code.push_back(std::move(span));
      }
    }
  }
  return code;
}

/// Whether a word of code is meant as a path of the repository: it has a slash, and an extension,
/// a slash at its end, or a first part that is a folder of the root. What a build or a user
/// writes, and the names of topics, are none.
bool LooksLikePath(const std::string& word) {
  static const std::regex kPath(R"([A-Za-z_.*][A-Za-z0-9_.*-]*(/[A-Za-z0-9_.*-]+)*/?)");
  static const std::set<std::string> kFarCoordinate = {"build", "report", "collision", "..."};
  const auto slash = word.find('/');
  if (slash == std::string::npos || !std::regex_match(word, kPath)) return false;
  const std::string first = word.substr(0, slash);
  if (kFarCoordinate.count(first) != 0) return false;
  const std::string last = word.substr(word.rfind('/') + 1);
  return last.empty() || last.find('.') != std::string::npos || (first != ".." && Exists(first));
}

/// A bare name of a source, for example `detector.h` or `agent_table.*`.
bool LooksLikeSource(const std::string& word) {
  return std::regex_match(word, std::regex(R"([A-Za-z0-9_]+\.(h|cc|proto|idl|\*))"));
}

/// A regular expression for a path in which `*` and words in capitals stand for any text.
std::string Pattern(const std::string& path) {
  std::string pattern = std::regex_replace(path, std::regex(R"(\.)"), R"(\.)");
  pattern = std::regex_replace(pattern, std::regex(R"(\*)"), "[^/]*");
  return std::regex_replace(pattern, std::regex("[A-Z]{2,}"), "[^/]+");
}

bool AnyMatches(const std::vector<std::string>& paths, const std::string& pattern) {
  const std::regex regex(pattern);
  return std::any_of(paths.begin(), paths.end(),
                     [&](const std::string& path) { return std::regex_match(path, regex); });
}

/// The folders from which a document may name a path: its own, those above it, the core.
std::vector<std::filesystem::path> FoldersFor(const std::string& document) {
  std::vector<std::filesystem::path> folders = {"collision_core"};
  std::filesystem::path folder = std::filesystem::path(document).parent_path();
  for (; !folder.empty(); folder = folder.parent_path()) folders.push_back(folder);
  folders.emplace_back();
  return folders;
}

bool PathExists(const std::string& document, const std::string& path,
                const std::vector<std::string>& all) {
  for (const std::filesystem::path& folder : FoldersFor(document)) {
    const std::string from_root = (folder / path).lexically_normal().generic_string();
    // A module without its extension stands for its header and its source.
    if (Exists(from_root) || Exists(from_root + ".h")) return true;
    const std::string pattern = Pattern(path);
    if (pattern != path && AnyMatches(all, (folder / pattern).generic_string())) return true;
  }
  return false;
}

TEST(Documents, LinksLeadToFilesThatExist) {
  int links = 0;
  for (const SourceFile& document : Documents()) {
    const std::filesystem::path folder = std::filesystem::path(document.path).parent_path();
    for (const std::string& link :
         Captures(document.text, std::regex(R"(\]\(([A-Za-z0-9_./-]+)[)#])"))) {
      const std::string path = (folder / link).lexically_normal().generic_string();
      EXPECT_TRUE(Exists(path)) << document.path << ": " << link;
      ++links;
    }
  }
  EXPECT_GT(links, 30);
}

TEST(Documents, PathsTheyNameExist) {
  const std::vector<std::string> all = PathsInRooms();
  int paths = 0;
  int sources = 0;
  for (const SourceFile& document : Documents()) {
    for (const std::string& code : CodeOf(document.text)) {
      for (std::string& word : Captures(code, std::regex(R"(([^\s,;'"]+))"))) {
        while (!word.empty() && std::string(".:)").find(word.back()) != std::string::npos) {
          word.pop_back();
        }
        if (LooksLikePath(word)) {
          EXPECT_TRUE(PathExists(document.path, word, all)) << document.path << ": " << word;
          ++paths;
        } else if (LooksLikeSource(word)) {
          EXPECT_TRUE(AnyMatches(all, ".*/" + Pattern(word))) << document.path << ": " << word;
          ++sources;
        }
      }
    }
  }
  EXPECT_GT(paths, 100);
  EXPECT_GT(sources, 100);
}

/// The paths of the repository that a script names: what follows "$root/" or, at the begin of a
/// word, the name of a room. A path that goes on with a variable is cut before it. Objects in the
/// folder of a build are none.
std::vector<std::string> PathsIn(const std::string& script) {
  std::vector<std::string> paths = Captures(
      script,
      std::regex(R"re((?:^|[\s"'(=]|\$root"?/))re"
                 R"re(((?:collision_core|idl|server|client|config|docker|tests)/[\w./*-]*))re"));
  std::erase_if(paths, [](const auto& path) { return path.find("/CMakeFiles/") != path.npos; });
  for (std::string& path : paths) {
    while (path.back() == '.') path.pop_back();
  }
  return paths;
}

TEST(Documents, PathsThatScriptsNameExist) {
  EXPECT_EQ(PathsIn("find \"$root/tests/a\" tests/b.cc $build/tests/c \"$root\"/idl/$name"),
            (std::vector<std::string>{"tests/a", "tests/b.cc", "idl/"}));
  const std::vector<std::string> all = PathsInRooms();
  int paths = 0;
  for (const SourceFile& script : Scripts()) {
    for (const std::string& path : PathsIn(script.text)) {
      EXPECT_TRUE(PathExists(script.path, path, all)) << script.path << ": " << path;
      ++paths;
    }
  }
  EXPECT_GT(paths, 30);
}

TEST(Documents, CommandsOfRunThatTheyNameExist) {
  const std::string script = ReadFile("run");
  const std::string usage = script.substr(0, script.find("\nEND\n"));
  int commands = 0;
  for (const SourceFile& document : Documents()) {
    for (const std::string& command :
         Captures(document.text, std::regex(R"(\./run ([a-z][a-z-]*))"))) {
      EXPECT_TRUE(std::regex_search(usage, std::regex("\n  " + command + "\\b")))
          << document.path << ": ./run " << command;
      ++commands;
    }
  }
  EXPECT_GT(commands, 30);
}

}  // namespace
}  // namespace collision::source
