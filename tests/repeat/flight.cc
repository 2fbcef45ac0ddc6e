#include "tests/repeat/flight.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "client/programs/shared/stop_signal.h"
#include "tests/network/lan.h"
#include "tests/repeat/stopper.h"
#include "tests/system/event_log.h"
#include "tests/system/process.h"
#include "tests/system/two_hosts.h"

namespace collision::repeat {
namespace {

namespace fs = std::filesystem;
using std::chrono::steady_clock;
using system_test::Process;

constexpr char kService[] = "collisiond";
// A starved service takes long to build a tree. After a limit time would go on without it.
constexpr char kWaitForShapes[] = "clock { shape_wait_max_s: 3600 }";
constexpr network::LinkFaults kFaults{.loss = 0.01, .delay_min_s = 0.001, .delay_max_s = 0.005};
constexpr std::chrono::minutes kLongest{20};  // no flight takes so long
constexpr std::chrono::milliseconds kStopCheck{50};
constexpr std::size_t kSaidMax = 2000;

std::string Quoted(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += "'" + word + "' ";
  return text;
}

std::string ReadFile(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// How a program of the scene is started.
struct Start {
  std::vector<std::string> before;  ///< The program.
  std::vector<std::string> after;   ///< The options of the scene.
  bool starved = false;
};

Start StartOf(const std::string& program, const FlightPlan& plan, const network::Lan* lan) {
  const Condition& condition = plan.condition;
  const bool service = program == kService;
  Start start;
  start.starved = service ? condition.starves_service : condition.starves_simulators;
  if (start.starved) start.before = {"nice", "-n", "5"};
  if (service) return start;
  if (lan != nullptr) start.before = system_test::InNamespace(lan->host(1), start.before);
  if (plan.speed > 0) start.after = {"--speed", std::to_string(plan.speed)};
  return start;
}

/// A folder that has a script in place of each program: it notes the process id of what is to be
/// starved and becomes the program.
void WriteScripts(const FlightPlan& plan, const Places& places, const network::Lan* lan,
                  const fs::path& folder) {
  fs::create_directories(folder / "bin");
  fs::create_directories(folder / "starved");
  for (const auto& entry : fs::directory_iterator(places.bin)) {
    const std::string program = entry.path().filename().string();
    const Start start = StartOf(program, plan, lan);
    const fs::path path = folder / "bin" / program;
    std::ofstream script(path);
    script << "#!/bin/sh\n";
    if (start.starved) script << ": >'" << (folder / "starved").string() << "'/$$\n";
    script << "exec " << Quoted(start.before) << Quoted({entry.path().string()}) << "\"$@\" "
           << Quoted(start.after) << "\n";
    script.close();
    if (!script) throw std::runtime_error(path.string() + ": cannot be written");
    fs::permissions(path, fs::perms::owner_all);
  }
}

/// As many as there are processors.
std::vector<std::unique_ptr<Process>> BusyLoops() {
  std::vector<std::unique_ptr<Process>> loops;
  for (unsigned i = 0; i < std::thread::hardware_concurrency(); ++i) {
    const std::vector<std::string> loop = {"sh", "-c", "while :; do :; done"};
    loops.push_back(std::make_unique<Process>(loop));
  }
  return loops;
}

std::vector<std::string> Command(const FlightPlan& plan, const Places& places,
                                 const fs::path& folder) {
  const std::pair<std::string, std::string> options[] = {
      {"--seconds", std::to_string(plan.seconds)},
      {"--config", kWaitForShapes},
      {"--scenes", places.config + "/scenes"},
      {"--bin", (folder / "bin").string()},
      {"--logs", (folder / "logs").string()},
      {"--json", plan.judged ? (folder / "report.json").string() : ""},
      {"--data", places.data}};
  std::vector<std::string> words = {(fs::path(places.bin) / "scene-runner").string(), plan.scene};
  for (const auto& [option, value] : options) {
    if (!value.empty()) words.insert(words.end(), {option, value});
  }
  if (!plan.judged) words.emplace_back("--unjudged");
  return words;
}

/// Until it has ended, must stop, or has taken too long.
void Attend(Process* runner, Stopper* stopper) {
  const auto deadline = steady_clock::now() + kLongest;
  const auto never = [] { return false; };
  std::chrono::nanoseconds patience = kStopCheck;
  while (!runner->WaitForExit(std::chrono::nanoseconds(0)) && !client::StopRequested() &&
         steady_clock::now() < deadline) {
    if (stopper != nullptr) patience = stopper->Turn();
    runner->WaitUntil(never, patience);
  }
}

}  // namespace

Flight Fly(const FlightPlan& plan, const Places& places, const std::string& folder) {
  const Condition& condition = plan.condition;
  const bool starves = condition.starves();
  fs::remove_all(folder);
  fs::create_directories(folder);
  std::optional<network::Lan> lan;
  if (condition.slow_network) lan.emplace(2, plan.seed).SetFaults(kFaults);
  WriteScripts(plan, places, lan ? &*lan : nullptr, folder);
  std::vector<std::string> command = Command(plan, places, folder);
  if (lan) command = system_test::InNamespace(lan->host(0), command);
  const std::string profile = lan ? "cyclonedds-lan.xml" : "cyclonedds-loopback.xml";
  const auto loops = starves ? BusyLoops() : std::vector<std::unique_ptr<Process>>();
  const auto began = steady_clock::now();
  Process runner(command, {"CYCLONEDDS_URI=file://" + places.config + "/" + profile});
  Flight flight;
  {
    Stopper stopper((fs::path(folder) / "starved").string(), plan.seed);
    Attend(&runner, starves ? &stopper : nullptr);
    flight.stops = stopper.stops();
  }
  flight.wall_s = std::chrono::duration<double>(steady_clock::now() - began).count();
  flight.satisfied = runner.WaitForExit(std::chrono::nanoseconds(0)) == 0;
  flight.ended = runner.out().find("\nchecker: ") != std::string::npos;
  flight.event_log =
      system_test::EventLogLine(ReadFile(fs::path(folder) / "logs" / "collisiond.log"));
  if (flight.satisfied) return flight;
  flight.said = runner.out() + runner.err();
  if (flight.said.size() > kSaidMax) flight.said.erase(0, flight.said.size() - kSaidMax);
  return flight;
}

}  // namespace collision::repeat
