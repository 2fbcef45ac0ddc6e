// ./run repeat: flies every scene in lock-step again and again, undisturbed and disturbed, and
// compares the event logs.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "client/programs/shared/command_line.h"
#include "client/programs/shared/stop_signal.h"
#include "tests/bench/harness/json.h"
#include "tests/repeat/flight.h"
#include "tests/repeat/judgement.h"
#include "tests/repeat/scene_choice.h"

namespace collision::repeat {
namespace {

namespace fs = std::filesystem;

constexpr int kSame = 0, kNotTheSame = 1, kNothingToFly = 2, kInterrupted = 130;
constexpr double kQuickSeconds = 4;
constexpr int kTimes = 10, kQuickTimes = 2;

struct Options {
  Choice choice;
  int times = 0;  ///< 0: the default.
  std::string json;
  Places places{COLLISION_BIN_DIR, std::string(COLLISION_SOURCE_DIR) + "/config",
                COLLISION_DATA_DIR, "repeat-logs"};
};

/// Keeps what a flight left behind if its event log is a new one, or it failed: to compare.
class Keeper {
 public:
  explicit Keeper(const Places& places) : places_(places) {}

  Flight Fly(const FlightPlan& plan, const std::string& name) {
    const fs::path folder = fs::path(places_.logs) / name;
    const Flight flight = repeat::Fly(plan, places_, folder.string());
    const bool is_new = known_.insert(plan.scene + " " + flight.event_log).second;
    if (flight.satisfied && !is_new) fs::remove_all(folder);
    return flight;
  }

 private:
  Places places_;
  std::set<std::string> known_;
};

Row FlySeries(const Series& series, int times, Keeper* keeper) {
  Row row{series, {}};
  for (int i = 1; i <= times && !client::StopRequested(); ++i) {
    const std::string name = series.scene + "-" + series.condition.name + "-" + std::to_string(i);
    const FlightPlan plan{
        series.scene, series.seconds, series.speed, series.condition, static_cast<std::uint64_t>(i),
        i == 1};
    const Flight flight = keeper->Fly(plan, name);
    if (client::StopRequested()) break;
    std::fprintf(stderr, "%s: %.1f s, %s%s\n", name.c_str(), flight.wall_s,
                 flight.event_log.c_str(), flight.satisfied ? "" : ", not satisfied:");
    if (!flight.satisfied) std::fprintf(stderr, "%s\n", flight.said.c_str());
    row.flights.push_back(flight);
  }
  return row;
}

int FlyAll(const Options& options) {
  client::Folders folders;
  folders.scenes = options.places.config + "/scenes";
  folders.data = options.places.data;
  folders.bin = options.places.bin;
  const Chosen chosen = Choose(folders, options.choice);
  for (const std::string& reason : chosen.left_out) std::printf("left out: %s\n", reason.c_str());
  if (chosen.series.empty()) {
    std::fprintf(stderr, "repeat: nothing to fly: no SCENE/CONDITION contains \"%s\"\n",
                 options.choice.only.c_str());
    return kNothingToFly;
  }
  std::printf("%s", TableHead().c_str());
  Keeper keeper(options.places);
  std::vector<Row> rows;
  std::size_t flights = 0;
  for (const Series& series : chosen.series) {
    std::fflush(stdout);
    Row row = FlySeries(series, options.times, &keeper);
    if (row.flights.empty()) break;
    std::printf("%s", TableLine(row).c_str());
    flights += row.flights.size();
    rows.push_back(std::move(row));
  }
  const std::vector<std::string> faults = Faults(rows);
  for (const std::string& fault : faults) std::printf("NOT THE SAME: %s\n", fault.c_str());
  if (const int status = bench::WriteJson(options.json, Json(rows)); status != 0) return status;
  if (client::StopRequested()) return kInterrupted;
  if (!faults.empty()) return kNotTheSame;
  std::printf("SAME: %zu flights, of each scene one event log\n", flights);
  return kSame;
}

}  // namespace
}  // namespace collision::repeat

int main(int argc, char** argv) {
  using namespace collision;
  using namespace collision::repeat;
  constexpr double kSecondsMax = 3600;
  constexpr int kTimesMax = 1000;
  Options options;
  CLI::App app("Flies scenes in lock-step again and again and compares their event logs.",
               "repeat");
  app.add_flag("--quick", options.choice.quick, "Two scenes, 4 s of each, twice");
  app.add_option("--times", options.times, "Flights of each row; default 10")
      ->check(CLI::Range(1, kTimesMax));
  app.add_option("--only", options.choice.only, "Only rows whose SCENE/CONDITION contains this");
  app.add_option("--seconds", options.choice.seconds,
                 "Simulated length of each flight; default: as the scene says")
      ->check(client::Finite(kSecondsMax, false));
  app.add_option("--paced-max", options.choice.paced_max_s,
                 "Longest time of a flight at real time [s]: a longer scene is flown faster")
      ->check(client::Finite(kSecondsMax, false))
      ->capture_default_str();
  app.add_option("--json", options.json, "Write the table to this file");
  app.add_option("--logs", options.places.logs, "Folder for logs of flights that differ")
      ->capture_default_str();
  if (const auto code = client::ParseCommandLine(&app, argc, argv)) return *code;
  const bool quick = options.choice.quick;
  if (options.times == 0) options.times = quick ? kQuickTimes : kTimes;
  if (options.choice.seconds == 0 && quick) options.choice.seconds = kQuickSeconds;
  client::CatchStopSignals();
  return client::RunProgram("repeat", [&] { return FlyAll(options); });
}
