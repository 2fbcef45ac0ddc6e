// trajectory-player: a simulator that plays a table of positions.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>

#include "client/library/validation.h"
#include "client/programs/shared/command_line.h"
#include "client/programs/shared/mesh_option.h"
#include "client/programs/shared/stop_signal.h"
#include "client/programs/simulators/player/csv_rows.h"
#include "client/programs/simulators/player/player.h"
#include "collision/event_text.h"

namespace collision::client {
namespace {

constexpr std::size_t kAgentsPrinted = 10;
constexpr double kLookAheadMax = 86400;              // the service's greatest announce_within_s
constexpr double kBeginMin = -1e9, kBeginMax = 4e9;  // file times [s]

const std::map<std::string, KnownUse> kKnownUses = {
    {"auto", KnownUse::kAuto}, {"always", KnownUse::kTold}, {"never", KnownUse::kUntold}};

struct Options {
  SimulatorOptions simulator;
  PlayerOptions player;
  MeshOptions mesh;
  std::string file;
  std::vector<std::string> agents;  // ID or ID=NAME; none: all
  double begin_s = 0;               // file time at which the run begins
  bool quiet = false;
  std::vector<double> planes;  // of half-spaces: normal and offset, one after another
};

std::int64_t BeginOf(const Options& options) { return std::llround(options.begin_s * 1e9); }

// The selected agents, played from `start_ns` on. Throws CsvError if one is not in the file.
std::vector<PlayedAgent> Choose(const Options& options, const CsvRows& file,
                                std::int64_t start_ns) {
  std::vector<std::string> chosen = options.agents;
  if (chosen.empty()) {
    for (const auto& [id, rows] : file.rows) chosen.push_back(id);
  }
  std::vector<PlayedAgent> agents;
  for (const std::string& choice : chosen) {
    const std::size_t equals = choice.find('=');
    const std::string id = choice.substr(0, equals);
    const auto rows = file.rows.find(id);
    if (rows == file.rows.end())
      throw CsvError(options.file + ": no agent \"" + id + "\" in the file");
    PlayedAgent agent{equals == std::string::npos ? id : choice.substr(equals + 1),
                      Trajectory(rows->second, file.velocities, start_ns - BeginOf(options))};
    agent.known = KnownOf(agent.trajectory, options.player);
    agents.push_back(std::move(agent));
  }
  return agents;
}

// "agent 9: 187 rows, acceleration at most 5.3 m/s2 (derived)"
void PrintAgent(const PlayedAgent& agent, const PlayerOptions& options) {
  const bool derived = options.acceleration_max_m_s2 < 0;
  if (derived && agent.trajectory.pieces().empty()) {
    std::printf(
        "agent %s: 1 row, which tells nothing about its acceleration; it is there for that "
        "instant only\n",
        agent.name.c_str());
    return;
  }
  std::printf("agent %s: %zu rows, acceleration at most %.6g m/s2%s\n", agent.name.c_str(),
              agent.trajectory.rows().size(),
              derived ? agent.trajectory.AccelerationMax() : options.acceleration_max_m_s2,
              derived ? " (derived)" : "");
  if (!agent.known) return;
  std::printf(
      "  a from rows; deviation %.3g m/s2, jerk %.3g m/s3 (derived from the curve played)\n",
      agent.known->deviation_max_m_s2(), agent.known->jerk_max_m_s3());
}

// Least, middle and greatest.
std::string SpreadText(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  char text[96];
  std::snprintf(text, sizeof text, "%.3g / %.3g / %.3g", values.front(), values[values.size() / 2],
                values.back());
  return text;
}

void PrintSummary(const Options& options, const std::vector<PlayedAgent>& agents) {
  std::vector<double> greatest, deviations, jerks;
  for (const PlayedAgent& agent : agents) {
    if (agent.trajectory.pieces().empty()) continue;
    greatest.push_back(agent.trajectory.AccelerationMax());
    if (!agent.known) continue;
    deviations.push_back(agent.known->deviation_max_m_s2());
    jerks.push_back(agent.known->jerk_max_m_s3());
  }
  if (greatest.empty()) return;
  std::printf("%zu agents, acceleration %s m/s2 (least / median / greatest)\n", agents.size(),
              options.player.acceleration_max_m_s2 < 0
                  ? SpreadText(greatest).c_str()
                  : std::to_string(options.player.acceleration_max_m_s2).c_str());
  if (deviations.empty()) return;
  std::printf("a from rows of %zu of them: deviation %s m/s2, jerk %s m/s3\n", deviations.size(),
              SpreadText(deviations).c_str(), SpreadText(jerks).c_str());
}

void Print(const Options& options, const std::vector<PlayedAgent>& agents) {
  if (options.quiet) return;
  for (std::size_t i = 0; i < agents.size() && i < kAgentsPrinted; ++i) {
    PrintAgent(agents[i], options.player);
  }
  if (agents.size() > 1) PrintSummary(options, agents);
  if (options.player.acceleration_max_m_s2 < 0 &&
      options.player.known_acceleration == KnownUse::kAuto) {
    const auto tells = [](const PlayedAgent& agent) { return agent.known.has_value(); };
    std::printf(
        "%td of %zu agents tell their acceleration: those whose bound that makes smaller %g s on\n",
        std::count_if(agents.begin(), agents.end(), tells), agents.size(),
        options.player.look_ahead_s);
  }
  std::fflush(stdout);
}

double SecondsToPlay(const Options& options, const CsvRows& file) {
  std::int64_t last = BeginOf(options);
  for (const auto& [id, rows] : file.rows) last = std::max(last, rows.back().time_ns);
  return static_cast<double>(last - BeginOf(options)) * 1e-9;
}

// Checks everything before the program connects.
void CheckAgents(const Options& options, const CsvRows& file) {
  std::size_t rows = 0, before = 0;
  const std::vector<PlayedAgent> agents = Choose(options, file, 0);
  RequireNamesOfTheirOwn(agents, options.player);
  for (const PlayedAgent& agent : agents) {
    RequirePlayable(agent, options.player, options.file);
    for (const CsvRow& row : agent.trajectory.rows()) before += row.time_ns < 0;
    rows += agent.trajectory.rows().size();
  }
  const std::string late = LateStartText(agents, BeginOf(options));
  // A start that was given is meant: with 0, stamps are those of the file.
  if (!late.empty() && options.simulator.start_ns < 0) {
    std::fprintf(stderr, "trajectory-player: %s: %s\n", options.file.c_str(), late.c_str());
  }
  if (before == 0) return;
  const std::string what = options.file + ": " + std::to_string(before) + " of " +
                           std::to_string(rows) + " rows are before the run's start (--begin-at)";
  if (before == rows) throw CsvError(what);
  std::fprintf(stderr, "trajectory-player: %s; they are not sent\n", what.c_str());
}

// Gives each agent the shape, inside the ball that was asked for or the smallest one.
void TakeMesh(Options* options) {
  options->player.shape = LoadAgentShape(options->mesh, options->quiet);
  const bool radius_given = options->player.radius_m >= 0;
  if (options->player.shape && !radius_given) {
    options->player.radius_m = options->player.shape->radius_m();
  }
}

// The motion checker knows only what is there: throws BadInput for plans.
void CheckPlans(const Options& options) {
  if (options.player.hypothetical && !options.simulator.motion_log.empty()) {
    throw BadInput("--hypothetical: beside --motion-log, allowed: one of the two");
  }
}

// Counts what it prints.
void PrintScreening(Pace* pace, int* printed) {
  pace->world().OnEvent([pace, printed](const Event& event) {
    if (!event.hypothetical) return;
    ++*printed;
    const auto name = [pace](const AgentId& id) { return pace->world().Name(id); };
    std::printf("%s\n", EventLine(event, name, pace->start_ns()).c_str());
  });
}

int Run(Options options) {
  std::error_code ignored;
  if (std::filesystem::is_directory(options.file, ignored)) {
    std::fprintf(stderr, "trajectory-player: %s: is a directory\n", options.file.c_str());
    return kExitNoInput;
  }
  std::ifstream stream(options.file);
  if (!stream) {
    std::fprintf(stderr, "trajectory-player: %s: cannot be read\n", options.file.c_str());
    return kExitNoInput;
  }
  const CsvRows file = ReadCsv(stream, options.file);
  TakeMesh(&options);
  CheckAgents(options, file);
  if (options.simulator.seconds <= 0) options.simulator.seconds = SecondsToPlay(options, file);
  options.simulator.quiet = options.quiet;
  MotionLog log(options.simulator.motion_log);
  Pace pace(options.simulator);
  const std::vector<PlayedAgent> agents = Choose(options, file, pace.start_ns());
  Print(options, agents);
  const bool screens = options.player.hypothetical && !options.quiet;
  int printed = 0;
  if (screens) PrintScreening(&pace, &printed);
  Play(agents, options.player, &pace, &log);
  log.Close();
  if (screens && printed == 0) {
    std::printf(
        "nothing was told of these plans: they meet nothing, or they ended before the world's time "
        "came to them\n");
  }
  pace.ReportTraffic(options.quiet);
  pace.CheckRefusals();
  return kExitOk;
}

void AddTimeOptions(CLI::App* app, Options* options) {
  app->add_option("--rate", options->player.rate_hz,
                  "States per second on the curve; default: at the rows")
      ->check(Finite(1e9, false));
  app->add_option("--begin-at", options->begin_s,
                  "The file's time [s] at which the run begins: that of the first row, say, where "
                  "times are since 1970")
      ->check(Between(kBeginMin, kBeginMax))
      ->capture_default_str();
  app->add_option("--seconds", options->simulator.seconds,
                  "Length of the run; default: to the last row")
      ->check(Finite(kRunSecondsMax, false));
}

// Returns --radius.
const CLI::Option* AddPlayerOptions(CLI::App* app, Options* options) {
  app->add_option("file", options->file,
                  "CSV: time_s, agent_id, x_m, y_m [, z_m] [, vx_m_s, ...] [, jump: 1 where the "
                  "agent is set to this place, 0 where it moves there]")
      ->required();
  app->add_option("--agents", options->agents,
                  "Agents to play, ID or ID=NAME, separated by commas; default: all")
      ->delimiter(',');
  options->player.radius_m = -1;
  CLI::Option* radius =
      app->add_option("--radius", options->player.radius_m,
                      "Bounding radius of every agent [m]; default: that of its shape")
          ->check(Finite(kRadiusMax, true));
  app->add_option("--margin", options->player.margin_m,
                  "Whatever is this near to an agent counts as touching it [m]")
      ->check(Finite(kRadiusMax, true));
  app->add_option("--acceleration-max", options->player.acceleration_max_m_s2,
                  "Of every agent [m/s2]; default: derived from the data, per agent")
      ->check(Finite(kAccelerationMax, true));
  app->add_option("--known-acceleration", options->player.known_acceleration,
                  "Whether states tell the acceleration that their curve has: auto (where this "
                  "makes the bound smaller), always or never; never with --acceleration-max")
      ->transform(ValueOf(kKnownUses))
      ->default_str("auto");
  app->add_option("--look-ahead", options->player.look_ahead_s,
                  "For auto: compare the bounds after so many seconds, such as announce_within_s")
      ->check(Finite(kLookAheadMax, false))
      ->capture_default_str();
  app->add_option("--position-error", options->player.position_error_m, "Of every state [m]")
      ->check(Finite(kRadiusMax, true));
  app->add_option("--half-space", options->planes,
                  "A floor or a wall: NX,NY,NZ,OFFSET, all x with n·x <= OFFSET [m], n of length "
                  "1; may be given several times")
      ->delimiter(',');
  app->add_flag("--hypothetical", options->player.hypothetical,
                "Add the agents as plans to be screened, and print what they would meet");
  app->add_flag("--quiet", options->quiet, "Print nothing but what goes wrong");
  return radius;
}

// Throws BadInput for what is no half-space.
void TakeHalfSpaces(Options* options) {
  const std::vector<double>& planes = options->planes;
  if (planes.size() % 4 != 0) {
    throw BadInput("--half-space: " + std::to_string(planes.size()) +
                   " numbers, allowed: 4 of each, NX,NY,NZ,OFFSET");
  }
  for (std::size_t i = 0; i < planes.size(); i += 4) {
    const HalfSpace half_space{{planes[i], planes[i + 1], planes[i + 2]}, planes[i + 3]};
    try {
      Validate(AgentDescription{.name = "half-space", .half_space = half_space});
    } catch (const std::invalid_argument& error) {
      throw BadInput("--half-space: " + std::string(error.what()));
    }
    options->player.half_spaces.push_back(half_space);
  }
}

}  // namespace
}  // namespace collision::client

int main(int argc, char** argv) {
  using namespace collision::client;
  Options options;
  CLI::App app("Plays agents' positions from a CSV file into a world of the collision service.",
               "trajectory-player");
  const CLI::Option* radius = AddPlayerOptions(&app, &options);
  AddTimeOptions(&app, &options);
  AddMeshOptions(&app, &options.mesh);
  AddSimulatorOptions(&app, &options.simulator);
  if (const auto code = ParseCommandLine(&app, argc, argv)) return *code;
  if (radius->empty() && options.mesh.file.empty() && options.mesh.solids.empty()) {
    std::fprintf(stderr, "trajectory-player: --radius is required without --mesh or --solids\n");
    return kExitUsage;
  }
  if (options.player.known_acceleration == KnownUse::kTold &&
      options.player.acceleration_max_m_s2 >= 0) {
    std::fprintf(stderr,
                 "trajectory-player: --known-acceleration: always, allowed: auto or never beside "
                 "--acceleration-max\n");
    return kExitUsage;
  }
  CatchStopSignals();
  return RunProgram("trajectory-player", [&options]() -> int {
    TakeHalfSpaces(&options);
    CheckPlans(options);
    try {
      return Run(options);
    } catch (const CsvError& error) {
      throw BadInput(error.what());
    } catch (const std::invalid_argument& error) {  // A state between two rows is out of range.
      throw BadInput(options.file + ": " + error.what());
    }
  });
}
