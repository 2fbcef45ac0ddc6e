// Runs a scene from start to verdict.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/programs/scene_runner/child_process.h"
#include "client/programs/scene_runner/metrics.h"
#include "client/programs/scene_runner/observer.h"
#include "client/programs/scene_runner/scene_file.h"

namespace collision::client {

struct RunnerOptions {
  std::string scene = "spaceships";
  Folders folders = DefaultFolders();
  double seconds = 0;  ///< 0: as the scene says.
  bool real_time = false;
  bool stream = false;     ///< Simulators send every state, not only those the service needs.
  bool secure = false;     ///< In a secured world, each program with credentials of its own.
  std::string world = {};  ///< Empty: one that depends on this process.
  std::optional<std::uint32_t> domain;  ///< Default: OwnDomain().
  std::string config;        ///< Fields that override the scene's configuration, as protobuf text.
  std::string arguments;     ///< Further ones of every simulator, separated by spaces.
  bool every_event = false;  ///< Print every event, however many.
  bool unjudged = false;     ///< Leave the checker out: it may take longer than the run.
  std::string json;          ///< File for the report; empty: none.
  std::string record;        ///< File for the recording of the service; empty: none.
  std::string logs;          ///< Folder for configuration and logs, kept; empty: a temporary one.
};

/// A DDS domain that depends on this process.
std::uint32_t OwnDomain();

/// Sets CYCLONEDDS_URI to the profile of this machine alone, unless it is set. Throws
/// std::runtime_error if there is no such file.
void UseLoopback(const Folders& folders);

/// Exit codes of a run.
enum RunResult { kSatisfied = 0, kNotSatisfied = 1, kInterrupted = 130 };

/// Starts collisiond and the scene's simulators on loopback in a world of their own, watches them
/// with a monitor to the end of the scene, ends them by their ids, and lets the checker judge. If
/// there is a terminal, a scene may give it to one of its programs; the run then ends with that
/// program, and the time flown is judged.
class Runner {
 public:
  explicit Runner(const RunnerOptions& options);
  ~Runner();

  /// Throws std::runtime_error if the scene cannot be run.
  RunResult Run();

 private:
  enum class Watch { kEnded, kLeft, kFailed, kInterrupted };

  std::string Path(const std::string& file) const;
  /// The scene's credentials, by a new authority in a folder that is removed with the rest.
  void MakeCredentials() const;
  /// Adds the option that names the folder `of` one program, if the scene is secured.
  void AddCredentials(const std::string& of, std::vector<std::string>* arguments) const;
  std::string CredentialsOf(const std::string& program) const;
  void StartService();
  void StartSimulator(const v1::SceneProcess& process);
  std::int64_t EndTime() const;
  Watch WatchToEnd();
  bool AllRunning();
  bool PersonLeft();
  void TakeTerminal();
  void Drain(std::chrono::milliseconds quiet, std::chrono::milliseconds longest);
  void StopSimulators();
  void ReadTraffic(Measured* measured) const;
  /// Programs that failed, and samples that the service refused.
  checker::Violations Failures() const;
  RunResult Judge(const Measured& measured);
  RunResult Conclude(const checker::Violations& violations, const char* satisfied) const;

  RunnerOptions options_;
  v1::Scene scene_;
  std::string world_;
  std::uint32_t domain_ = 0;
  std::int64_t start_ns_ = 0;
  std::optional<std::int64_t> left_ns_;  // the service's time when the person ended the run
  std::string folder_;
  std::unique_ptr<Observer> observer_;
  std::unique_ptr<ChildProcess> service_;
  std::vector<std::unique_ptr<ChildProcess>> simulators_;  // end before the service
  ChildProcess* person_ = nullptr;  // among them, the program that has the terminal
};

}  // namespace collision::client
