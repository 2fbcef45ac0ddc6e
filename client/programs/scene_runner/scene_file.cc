#include "client/programs/scene_runner/scene_file.h"

#include <google/protobuf/text_format.h>

#include <cmath>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "client/programs/shared/proto_text.h"

namespace collision::client {
namespace {

namespace fs = std::filesystem;

constexpr char kSuffix[] = ".textproto";

v1::Scene ReadScene(const std::string& path) {
  v1::Scene scene;
  ReadProtoText(path, &scene);
  if (!(scene.seconds() > 0) || !std::isfinite(scene.seconds())) {
    throw std::runtime_error(path + ": seconds: " + std::to_string(scene.seconds()) +
                             ", allowed: greater than 0");
  }
  if (scene.processes().empty())
    throw std::runtime_error(path + ": processes: 0, allowed: 1 or more");
  return scene;
}

std::string MissingData(const Folders& folders, const v1::Scene& scene) {
  if (scene.data_file().empty()) return "";
  if (folders.data.empty()) return "needs the data folder: " + scene.data_file();
  const fs::path path = fs::path(folders.data) / scene.data_file();
  return fs::exists(path) ? "" : "needs " + path.string();
}

struct ByName {
  bool operator()(const fs::path& a, const fs::path& b) const { return a.stem() < b.stem(); }
};

std::set<fs::path, ByName> ScenePaths(const Folders& folders) {
  std::set<fs::path, ByName> paths;
  for (const auto& entry : fs::directory_iterator(folders.scenes)) {
    if (entry.path().extension() == kSuffix) paths.insert(entry.path());
  }
  return paths;
}

void RequireScene(const Folders& folders, const std::string& name) {
  std::string names;
  for (const fs::path& path : ScenePaths(folders)) {
    if (path.stem() == name) return;
    names += (names.empty() ? "" : ", ") + path.stem().string();
  }
  throw NoSuchScene("no scene \"" + name + "\"; there are: " + names);
}

}  // namespace

Folders DefaultFolders() {
  return {COLLISION_SCENES_DIR, COLLISION_DATA_DIR,
          fs::read_symlink("/proc/self/exe").parent_path()};
}

v1::Scene LoadScene(const Folders& folders, const std::string& name) {
  RequireScene(folders, name);
  v1::Scene scene = ReadScene((fs::path(folders.scenes) / (name + kSuffix)).string());
  const std::string missing = MissingData(folders, scene);
  if (!missing.empty()) throw std::runtime_error("scene " + name + ": " + missing);
  return scene;
}

void ChangeConfig(const std::string& text, v1::Scene* scene) {
  const google::protobuf::LogSilencer silent;  // the exception below reports it
  google::protobuf::TextFormat::Parser parser;
  if (!parser.MergeFromString(text, scene->mutable_config())) {
    throw std::invalid_argument("--config: \"" + text +
                                "\" is not protobuf text of a configuration; example: "
                                "'time_budget_us: 100'");
  }
}

std::string ListScenes(const Folders& folders) {
  std::string text;
  for (const fs::path& path : ScenePaths(folders)) {
    const v1::Scene scene = ReadScene(path.string());
    std::string name = path.stem().string();
    name.resize(std::max<std::size_t>(name.size(), 16), ' ');
    const std::string missing = MissingData(folders, scene);
    text += name + "  " + scene.title() +
            (missing.empty() ? "" : " (not offered: " + missing + ")") + "\n";
  }
  return text;
}

std::string Substitute(const std::string& text, const std::map<std::string, std::string>& values) {
  std::string result;
  std::size_t at = 0;
  for (;;) {
    const std::size_t start = text.find("${", at);
    if (start == std::string::npos) return result + text.substr(at);
    const std::size_t end = text.find('}', start);
    const auto value = values.find(text.substr(start + 2, end - start - 2));
    if (end == std::string::npos || value == values.end()) {
      throw std::runtime_error("in \"" + text +
                               "\": allowed are ${SECONDS}, ${SCENES}, ${DATA} and ${LOG}");
    }
    result += text.substr(at, start - at) + value->second;
    at = end + 1;
  }
}

}  // namespace collision::client
