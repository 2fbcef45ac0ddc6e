#include "tests/bench/scenes/scene_run.h"

#include <google/protobuf/util/json_util.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "client/programs/scene_runner/child_process.h"

namespace collision::bench {
namespace {

namespace fs = std::filesystem;

/// No scene of ours runs longer.
constexpr std::chrono::minutes kLongest{15};

std::string TextOf(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

ScratchFolder::ScratchFolder() {
  std::string name = (fs::temp_directory_path() / "collision-bench-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error(name + ": cannot be made");
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void SceneOptions::AddTo(CLI::App* app, const std::string& quick_means,
                         const std::string& only_means) {
  CommonOptions::AddTo(app, quick_means, only_means);
  app->add_option("--bin", folders.programs, "folder of the programs")->required();
  app->add_option("--scenes", folders.scenes, "folder of the scenes")->required();
  app->add_option("--data", folders.data, "folder of the data sets")->required();
}

std::optional<v1::RunReport> RunScene(const SceneFolders& folders, const SceneRequest& request) {
  const ScratchFolder scratch;
  const std::string json = scratch.File("report.json"), output = scratch.File("output");
  std::vector<std::string> arguments = {folders.programs + "/scene-runner",
                                        request.scene,
                                        "--scenes",
                                        folders.scenes,
                                        "--data",
                                        folders.data,
                                        "--bin",
                                        folders.programs,
                                        "--json",
                                        json};
  const auto add = [&](const char* option, const std::string& value) {
    arguments.emplace_back(option);
    arguments.push_back(value);
  };
  if (request.seconds > 0) add("--seconds", std::to_string(request.seconds));
  if (!request.config.empty()) add("--config", request.config);
  if (!request.logs.empty()) add("--logs", request.logs);
  if (request.stream) arguments.emplace_back("--stream");
  client::ChildProcess runner("scene-runner", arguments, output);
  runner.Finish(std::chrono::steady_clock::now() + kLongest);
  v1::RunReport report;
  const std::string text = TextOf(json);
  if (text.empty() || !google::protobuf::util::JsonStringToMessage(text, &report).ok() ||
      report.violations_size() > 0) {
    std::fprintf(stderr, "bench: %s: no good run; it said:\n%s\n", request.scene.c_str(),
                 TextOf(output).c_str());
    return std::nullopt;
  }
  return report;
}

}  // namespace collision::bench
