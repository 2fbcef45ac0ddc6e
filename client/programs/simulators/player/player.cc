#include "client/programs/simulators/player/player.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>

#include "client/library/validation.h"
#include "client/programs/shared/exit_code.h"
#include "idl/limits.h"

namespace collision::client {
namespace {

State StateAt(const PlayedAgent& agent, std::int64_t stamp_ns, const PlayerOptions& options) {
  const PositionAndVelocity at = agent.trajectory.At(stamp_ns);
  State state;
  state.stamp_ns = stamp_ns;
  state.position_m = at.position_m;
  state.velocity_m_s = at.velocity_m_s;
  if (agent.known) state.acceleration_m_s2 = agent.known->At(stamp_ns);
  state.position_error_m = options.position_error_m;
  return state;
}

AgentDescription Description(const PlayedAgent& agent, const PlayerOptions& options) {
  AgentDescription description;
  description.name = agent.name;
  description.radius_m = options.radius_m;
  description.margin_m = options.margin_m;
  if (agent.known) {
    description.acceleration_max_m_s2 = agent.known->deviation_max_m_s2();
    description.jerk_max_m_s3 = agent.known->jerk_max_m_s3();
  } else if (options.acceleration_max_m_s2 >= 0) {
    description.acceleration_max_m_s2 = options.acceleration_max_m_s2;
  } else {
    description.acceleration_max_m_s2 = agent.trajectory.AccelerationMax();
  }
  description.hypothetical = options.hypothetical;
  description.shape = options.shape;
  if (options.shape) description.angular_acceleration_max_rad_s2 = 0;
  return description;
}

// One agent between its first row and its last.
class Part {
 public:
  Part(const PlayedAgent& agent, const PlayerOptions& options) : agent_(agent), options_(options) {}

  // Sets the agent's next state; the first one adds it to the world.
  void Stage(std::int64_t stamp_ns, World* world, MotionLog* log) {
    State state = StateAt(agent_, stamp_ns, options_);
    if (handle_) {
      state.discontinuity = agent_.trajectory.JumpsAt(stamp_ns);
      handle_->SetState(state);
      if (state.discontinuity) log->Jump(agent_.name, stamp_ns);
      return;
    }
    handle_.emplace(world->AddAgent(Description(agent_, options_), state));
    log->Agent(agent_.name, options_.radius_m, options_.shape);
    log->Margin(agent_.name, options_.margin_m);
  }

  // The clock has reached `clock_ns`: logs the motion played, and removes the agent if its last row
  // has been reached. At the end of the run all that are there stay.
  void Passed(std::int64_t clock_ns, std::int64_t end_ns, MotionLog* log) {
    const auto& pieces = agent_.trajectory.pieces();
    for (; logged_ < pieces.size() && pieces[logged_].t1_ns <= clock_ns; ++logged_) {
      log->Piece(agent_.name, pieces[logged_]);
    }
    if (agent_.trajectory.end_ns() <= clock_ns && clock_ns < end_ns) handle_.reset();
  }

  // The run is over: the current piece ends here.
  void Finish(std::int64_t clock_ns, MotionLog* log) {
    const auto& pieces = agent_.trajectory.pieces();
    if (logged_ == pieces.size() || pieces[logged_].t0_ns >= clock_ns) return;
    MotionPiece piece = pieces[logged_];
    piece.t1_ns = clock_ns;
    log->Piece(agent_.name, piece);
  }

 private:
  const PlayedAgent& agent_;
  const PlayerOptions& options_;
  std::optional<Agent> handle_;
  std::size_t logged_ = 0;
};

std::string HalfSpaceName(std::size_t index) { return "half-space-" + std::to_string(index + 1); }

std::vector<Agent> AddHalfSpaces(const PlayerOptions& options, const Pace& pace, World* world,
                                 MotionLog* log) {
  std::vector<Agent> added;
  for (const HalfSpace& half_space : options.half_spaces) {
    const std::string name = HalfSpaceName(added.size());
    added.push_back(
        world->AddAgent({.name = name, .half_space = half_space}, {.stamp_ns = pace.start_ns()}));
    log->Agent(name, half_space);
  }
  return added;
}

}  // namespace

std::optional<KnownAcceleration> KnownOf(const Trajectory& trajectory,
                                         const PlayerOptions& options) {
  if (options.known_acceleration == KnownUse::kUntold || options.acceleration_max_m_s2 >= 0) {
    return std::nullopt;
  }
  KnownAcceleration known(trajectory);
  if (options.known_acceleration == KnownUse::kTold) return known;
  const double unknown = ReachAfter(options.look_ahead_s, trajectory.AccelerationMax(), 0);
  const bool narrower =
      ReachAfter(options.look_ahead_s, known.deviation_max_m_s2(), known.jerk_max_m_s3()) < unknown;
  return narrower && known.jerk_max_m_s3() <= wire::kJerkMax ? std::optional(known) : std::nullopt;
}

void RequirePlayable(const PlayedAgent& agent, const PlayerOptions& options,
                     const std::string& file) {
  std::size_t line = 0;
  try {
    for (const CsvRow& row : agent.trajectory.rows()) {
      line = row.line;
      Validate(StateAt(agent, row.time_ns, options));
    }
    line = agent.trajectory.rows().front().line;
    Validate(Description(agent, options));
  } catch (const std::invalid_argument& error) {
    throw CsvError(file + ":" + std::to_string(line) + ": agent " + agent.name + ": " +
                   error.what());
  }
}

void RequireNamesOfTheirOwn(const std::vector<PlayedAgent>& agents, const PlayerOptions& options) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < options.half_spaces.size(); ++i) names.insert(HalfSpaceName(i));
  for (const PlayedAgent& agent : agents) {
    if (names.insert(agent.name).second) continue;
    throw BadInput("--agents: \"" + agent.name +
                   "\" names two agents, allowed: another name for each");
  }
}

std::string LateStartText(const std::vector<PlayedAgent>& agents, std::int64_t begin_ns) {
  std::int64_t first_ns = std::numeric_limits<std::int64_t>::max();
  for (const PlayedAgent& agent : agents) {
    first_ns = std::min(first_ns, agent.trajectory.begin_ns());
  }
  if (agents.empty() || first_ns <= kQuietStartMax) return "";
  constexpr std::int64_t kSecond = 1'000'000'000;
  const std::string first = std::to_string((begin_ns + first_ns) / kSecond);
  return "the first row is at t = " + first +
         " s, but the run begins at t = " + std::to_string(begin_ns / kSecond) +
         " s of the file, and nothing moves until then; " + "--begin-at " + first +
         " begins the run there";
}

std::vector<std::int64_t> StateInstants(const Trajectory& trajectory, double rate_hz,
                                        std::int64_t start_ns) {
  std::vector<std::int64_t> instants;
  if (rate_hz <= 0) {
    for (const CsvRow& row : trajectory.rows()) instants.push_back(row.time_ns);
    return instants;
  }
  const double period_ns = 1e9 / rate_hz;
  instants.push_back(trajectory.begin_ns());
  auto k = static_cast<std::int64_t>(
      std::floor(static_cast<double>(trajectory.begin_ns() - start_ns) / period_ns));
  for (;; ++k) {
    const std::int64_t stamp = start_ns + std::llround(static_cast<double>(k) * period_ns);
    if (stamp >= trajectory.end_ns()) break;
    if (stamp > instants.back()) instants.push_back(stamp);
  }
  if (trajectory.end_ns() > instants.back()) instants.push_back(trajectory.end_ns());
  std::vector<std::int64_t> jumps, all;
  for (const CsvRow& row : trajectory.rows()) {
    if (row.jump) jumps.push_back(row.time_ns);
  }
  std::ranges::set_union(instants, jumps, std::back_inserter(all));
  return all;
}

void Play(const std::vector<PlayedAgent>& agents, const PlayerOptions& options, Pace* pace,
          MotionLog* log) {
  const std::vector<Agent> half_spaces = AddHalfSpaces(options, *pace, &pace->world(), log);
  std::vector<Part> parts;
  std::map<std::int64_t, std::vector<std::size_t>> due;  // agents with a state at an instant
  for (const PlayedAgent& agent : agents) {
    for (const std::int64_t stamp :
         StateInstants(agent.trajectory, options.rate_hz, pace->start_ns())) {
      if (pace->start_ns() <= stamp && stamp <= pace->end_ns()) due[stamp].push_back(parts.size());
    }
    parts.emplace_back(agent, options);
  }
  // The run may end in the middle of a trajectory.
  std::vector<std::size_t>& last = due[pace->end_ns()];
  for (std::size_t i = 0; i < agents.size(); ++i) {
    const Trajectory& trajectory = agents[i].trajectory;
    const bool is_within =
        trajectory.begin_ns() < pace->end_ns() && pace->end_ns() < trajectory.end_ns();
    if (is_within && std::ranges::count(last, i) == 0) last.push_back(i);
  }
  for (const auto& [stamp, indices] : due) {
    for (const std::size_t i : indices) parts[i].Stage(stamp, &pace->world(), log);
    if (!pace->AdvanceTo(stamp)) break;
    for (Part& part : parts) part.Passed(stamp, pace->end_ns(), log);
  }
  const std::int64_t clock_ns = pace->world().clock_ns();
  for (Part& part : parts) part.Finish(clock_ns, log);
  for (std::size_t i = 0; i < half_spaces.size(); ++i)
    log->Piece(HalfSpaceName(i), {pace->start_ns(), clock_ns, {}});
  pace->Linger();
}

}  // namespace collision::client
