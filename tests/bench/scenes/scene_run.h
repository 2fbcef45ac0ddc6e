// A scene of ./run demo as an experiment: run by scene-runner, read from its report.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "idl/scene.pb.h"
#include "tests/bench/harness/options.h"

namespace collision::bench {

struct SceneFolders {
  std::string programs;  ///< With scene-runner and what it starts.
  std::string scenes;
  std::string data;
};

/// The options of a benchmark that runs scenes.
struct SceneOptions : CommonOptions {
  SceneFolders folders;

  /// Also adds --bin, --scenes and --data, which are required.
  void AddTo(CLI::App* app, const std::string& quick_means, const std::string& only_means);
};

struct SceneRequest {
  std::string scene;
  double seconds = 0;       ///< 0: as the scene says.
  std::string config = {};  ///< Over the scene's own.
  bool stream = false;
  std::string logs = {};  ///< A folder for the motion logs; empty: none are kept.
};

/// Waits until the run has ended; the clients and the service are ended by scene-runner. Nullopt:
/// it failed, or its checker was not satisfied; the reason is on the standard error output.
std::optional<v1::RunReport> RunScene(const SceneFolders& folders, const SceneRequest& request);

/// A new folder under the system's temporary one; removed at the end, with all in it.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::string& path() const { return path_; }
  std::string File(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

}  // namespace collision::bench
