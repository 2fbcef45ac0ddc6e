#include "tests/system/test_world.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "tests/system/two_hosts.h"

namespace collision::system_test {
namespace {

/// Positions at 10 Hz, as a user would have them in a file.
std::string Table(const Flight& flight) {
  std::ostringstream table;
  table << "time_s,agent_id,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s\n";
  for (int row = 0; row <= 10 * flight.seconds; ++row) {
    const double time = row / 10.0;
    table << time << "," << flight.name << "," << flight.x_m + flight.velocity_m_s * time << ",0,0,"
          << flight.velocity_m_s << ",0,0\n";
  }
  return table.str();
}

std::vector<std::string> Joined(std::vector<std::string> words,
                                const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// On a busy machine a service may be heard late. Whoever expects none says how long it waits.
std::vector<std::string> Patient(const std::vector<std::string>& words) {
  const bool says = std::find(words.begin(), words.end(), "--timeout") != words.end();
  return says ? words : Joined(words, {"--timeout", "60"});
}

}  // namespace

std::string ConfigFile(const std::string& name) {
  return std::string(COLLISION_SOURCE_DIR) + "/config/" + name;
}

std::string Program(const std::string& name) { return std::string(COLLISION_BIN_DIR) + "/" + name; }

Folder::Folder() {
  std::string path = std::filesystem::temp_directory_path() / "collision-XXXXXX";
  if (mkdtemp(path.data()) == nullptr) throw std::runtime_error("no folder at " + path);
  path_ = path;
}

Folder::~Folder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string Folder::Write(const std::string& name, const std::string& text) const {
  std::ofstream file(Path(name), std::ios::binary);
  if (!(file << text) || !file.flush()) throw std::runtime_error("cannot write " + Path(name));
  return Path(name);
}

TestWorld::TestWorld(int domain, const std::string& clock, const std::string& more)
    : domain_(std::to_string(domain)),
      name_("test-" + domain_ + "-" + std::to_string(getpid())),
      clock_(clock),
      more_(more) {
  SetStateFolder(folder_.Path("state"));
  variables_ = {"CYCLONEDDS_URI=file://" + ConfigFile("cyclonedds-loopback.xml")};
}

void TestWorld::SetStateFolder(const std::string& path) {
  state_folder_ = path;
  WriteConfig();
}

void TestWorld::Configure(const std::string& more) {
  more_ += more;
  WriteConfig();
}

void TestWorld::WriteConfig() {
  config_file_ = folder_.Write("collisiond.textproto",
                               "world: \"" + name_ + "\"\ndomain: " + domain_ + "\nclock { " +
                                   clock_ + " }\nstate_dir: \"" + state_folder_ + "\"\n" + more_);
}

void TestWorld::MoveTo(const std::string& network_namespace) {
  network_namespace_ = network_namespace;
  // The cable is the only network there is: the profile needs no adapting to find it.
  variables_ = {"CYCLONEDDS_URI=file://" + ConfigFile("cyclonedds-lan.xml")};
}

std::vector<std::string> TestWorld::OnHost(const std::vector<std::string>& command) const {
  return network_namespace_.empty() ? command : InNamespace(network_namespace_, command);
}

std::unique_ptr<Process> TestWorld::LaunchDaemon(const std::vector<std::string>& options,
                                                 const std::string& program) const {
  return std::make_unique<Process>(
      OnHost(Joined({Program(program), "--config", config_file_}, options)), variables_);
}

std::unique_ptr<Process> TestWorld::StartDaemon(const std::vector<std::string>& options) const {
  auto daemon = LaunchDaemon(options);
  if (!daemon->WaitForOutput("serves world"))
    throw std::runtime_error("collisiond: " + daemon->err());
  return daemon;
}

std::unique_ptr<Process> TestWorld::StartSimulator(const Flight& flight,
                                                   const std::vector<std::string>& options) const {
  const std::string table = folder_.Write(flight.name + ".csv", Table(flight));
  const std::vector<std::string> words = {
      table, "--simulator", flight.name + "-sim", "--radius", "0.5", "--acceleration-max", "0.01"};
  return StartPlayer(Joined(words, options));
}

std::unique_ptr<Process> TestWorld::StartProgram(const std::string& program,
                                                 const std::vector<std::string>& words) const {
  return std::make_unique<Process>(InWorld(program, words), variables_);
}

std::unique_ptr<Process> TestWorld::StartPlayer(const std::vector<std::string>& words) const {
  return StartProgram("trajectory-player", words);
}

std::unique_ptr<Process> TestWorld::StartHelper(const std::string& program,
                                                const std::vector<std::string>& words) const {
  return std::make_unique<Process>(
      OnHost(Joined(Joined({Program(program)}, words), {name_, domain_})), variables_);
}

std::unique_ptr<Process> TestWorld::StartMonitor(const std::vector<std::string>& words) const {
  return StartProgram("collisionctl", Patient(words));
}

Outcome TestWorld::Monitor(const std::vector<std::string>& words) const {
  return RunToEnd(InWorld("collisionctl", Patient(words)), variables_);
}

bool TestWorld::MonitorComesToSay(const std::vector<std::string>& words,
                                  const std::string& text) const {
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (std::chrono::steady_clock::now() < deadline) {
    const Outcome outcome = RunToEnd(InWorld("collisionctl", words), variables_);
    if (Contains(outcome.out, text)) return true;
  }
  return false;
}

std::vector<std::string> TestWorld::InWorld(const std::string& program,
                                            const std::vector<std::string>& words) const {
  return OnHost(Joined(Joined({Program(program)}, words), {"--world", name_, "--domain", domain_}));
}

}  // namespace collision::system_test
