// A world of its own for one test: a folder, a DDS domain, a configuration, and the programs in it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tests/system/event_log.h"
#include "tests/system/process.h"

namespace collision::system_test {

/// The path of one of our programs.
std::string Program(const std::string& name);

/// The path of a file of the project's config folder.
std::string ConfigFile(const std::string& name);

inline bool Contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A folder for the files of one test, empty at first; removed, with what is in it, at the end.
class Folder {
 public:
  Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder();

  std::string Path(const std::string& name) const { return path_ + "/" + name; }

  /// Writes a file and returns its path.
  std::string Write(const std::string& name, const std::string& text) const;

 private:
  std::string path_;
};

/// A ball of radius 0.5 m that flies along x at constant velocity.
struct Flight {
  std::string name;  ///< Of the agent, and with "-sim" of its simulator.
  double x_m = 0;    ///< At the start.
  double velocity_m_s = 0;
  int seconds = 10;  ///< Then its simulator ends.
};

/// Two that meet head-on: the balls touch from 4.5 s to 5.5 s. Each is a simulator of its own.
const Flight kLeft{"left", -5, 1};
const Flight kRight{"right", 5, -1};

/// Options with which a flight takes minutes: a simulator that waits for it stands still.
const std::vector<std::string> kHardlyMoves = {"--speed", "0.02"};

class TestWorld {
 public:
  /// `domain` is the test's own, so that tests can run at once. `clock` is what stands in the field
  /// clock {}, `more` behind it. The service keeps its journal in the folder "state".
  explicit TestWorld(int domain, const std::string& clock = "simulators_awaited: 2",
                     const std::string& more = "");

  /// Another folder for the journal from here on; empty: none.
  void SetStateFolder(const std::string& path);

  /// More fields of the configuration from here on.
  void Configure(const std::string& more);

  /// From here on programs start in this network namespace, with the profile for several hosts.
  void MoveTo(const std::string& network_namespace);

  const Folder& folder() const { return folder_; }
  const std::string& name() const { return name_; }
  std::uint32_t domain() const { return static_cast<std::uint32_t>(std::stoul(domain_)); }

  /// Starts collisiond, or another build of it, in this world.
  std::unique_ptr<Process> LaunchDaemon(const std::vector<std::string>& options = {},
                                        const std::string& program = "collisiond") const;

  /// Likewise, and waits until it serves.
  std::unique_ptr<Process> StartDaemon(const std::vector<std::string>& options = {}) const;

  /// Starts a trajectory-player for one flight; `options` go on its command line.
  std::unique_ptr<Process> StartSimulator(const Flight& flight,
                                          const std::vector<std::string>& options = {}) const;

  /// Starts a simulator, one of our programs, with these words, in this world.
  std::unique_ptr<Process> StartProgram(const std::string& program,
                                        const std::vector<std::string>& words) const;

  /// Likewise a trajectory-player.
  std::unique_ptr<Process> StartPlayer(const std::vector<std::string>& words) const;

  /// Starts a program of the tests; world and domain follow its words.
  std::unique_ptr<Process> StartHelper(const std::string& program,
                                       const std::vector<std::string>& words) const;

  /// Starts collisionctl with these words, in this world.
  std::unique_ptr<Process> StartMonitor(const std::vector<std::string>& words) const;

  /// Runs it to its end.
  Outcome Monitor(const std::vector<std::string>& words) const;

  /// Asks collisionctl again and again until it prints `text`; false when the patience is over.
  bool MonitorComesToSay(const std::vector<std::string>& words, const std::string& text) const;

 private:
  void WriteConfig();
  std::vector<std::string> OnHost(const std::vector<std::string>& command) const;
  std::vector<std::string> InWorld(const std::string& program,
                                   const std::vector<std::string>& words) const;

  Folder folder_;
  std::string domain_;
  std::string name_;
  std::string clock_, state_folder_, more_;
  std::string config_file_;
  std::vector<std::string> variables_;
  std::string network_namespace_;  ///< Empty: that of the test.
};

}  // namespace collision::system_test
