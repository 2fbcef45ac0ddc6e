// A violent agent among calm ones: the queries about pairs of calm agents, and their times, do not
// depend on it.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <tuple>

#include "tests/stress/query_log.h"
#include "tests/stress/scene.h"
#include "tests/support/random.h"

namespace collision::stress {
namespace {

using Eigen::Vector3d;

constexpr std::int64_t kStep = 1'000'000'000 / 64;
constexpr std::uint32_t kCalm = 40;

/// The radii of the first violent and the first calm agent. Each agent has a radius of its own;
/// calm agents have greater ones than violent agents.
constexpr double kViolentRadius = 0.25, kCalmRadius = 0.5, kRadiusStep = 0x1p-20;

/// Scenes that differ in how the violent agents reach the calm ones.
struct Wild {
  const char* name;
  double spread;           ///< How far the calm agents are spread [m].
  double announce_within;  ///< [s]
  std::uint32_t violent;   ///< The number of violent agents.
  int jumps_every;         ///< The violent agents jump every so many steps; 0: never.
  /// What the calm agents declare, in turns [m/s²].
  std::array<double, 3> accelerations = {0.5, 0.5, 0.5};
};

constexpr Wild kWild[] = {
    // The violent agent may reach all others within announce_within: all its pairs are tracked.
    {"within reach of all", 24, 2, 1, 0},
    {"within reach of all, jumping", 24, 2, 1, 7},
    // The violent agent is the next partner of most others, over and over, but not tracked yet.
    {"the next of many", 200, 0.125, 1, 0},
    {"the next of many, jumping", 200, 0.125, 1, 7},
    {"three of them", 200, 0.125, 3, 5},
    {"calm ones that declare none", 200, 0.125, 1, 7, {0, 0, 0}},
    {"none, within reach of all", 24, 2, 1, 7, {0, 0, 0}},
    {"some that declare none, some a hundred times others", 200, 0.125, 2, 7, {0, 0.5, 50}},
    {"likewise, within reach of all", 24, 2, 2, 7, {0, 0.5, 50}},
};

/// All events of pairs of calm agents, and all queries about them.
struct CalmLog {
  std::vector<detection::CollisionEvent> events;
  QueryLog::Queries of[kQueries];
  std::uint64_t queries = 0;
};

// Circles among the calm agents at 200 m/s and 4000 m/s², half of the declared acceleration.
Motion Round(std::uint32_t which, int jumps_every) {
  return [=, steps = 0](Seconds t) mutable {
    motion::MotionState state;
    const double angle = static_cast<double>(20 * t) + which;
    state.p_WA = {10 * std::cos(angle), 10 * std::sin(angle), 4.0 * which};
    state.v_WA = {-200 * std::sin(angle), 200 * std::cos(angle), 0};
    state.position_error = state.velocity_error = 1e-9;
    state.discontinuity = jumps_every > 0 && ++steps % jumps_every == 0;
    return state;
  };
}

detection::AgentDeclaration Ball(double radius, double acceleration_max) {
  detection::AgentDeclaration declaration;
  declaration.limits.radius = radius;
  declaration.limits.acceleration_max = acceleration_max;
  return declaration;
}

CalmLog RunAmong(const Wild& wild, bool violent, broad_phase::BroadPhaseMethod method, int steps,
                 Outcome* outcome) {
  detection::DetectorOptions options;
  options.announce_within = wild.announce_within;
  options.broad_phase = method;
  QueryLog log;
  Scene scene(options, Instant(), outcome);
  Random random(301);
  // Most agents send states in every second to fifth step only: in between, the detector evaluates
  // and queries their pairs when they are due.
  for (std::uint32_t k = 0; k < kCalm; ++k) {
    const Vector3d p = wild.spread * random.Uniform(0.1, 1) * random.UnitVector();
    scene.Add(Ball(kCalmRadius + k * kRadiusStep, wild.accelerations[k % 3]),
              Straight(p, random.Uniform(0, 4) * random.UnitVector()), 1 + static_cast<int>(k) % 5);
  }
  for (std::uint32_t k = 0; violent && k < wild.violent; ++k) {
    scene.Add(Ball(kViolentRadius + k * kRadiusStep, 8000), Round(k, wild.jumps_every));
  }
  for (int i = 1; i <= steps; ++i) {
    const Instant now = Instant::FromNanoseconds(i * kStep);
    log.SetNow(now);
    scene.StepTo(now);
  }
  CalmLog log_of_calm;
  for (const detection::CollisionEvent& event : scene.events()) {
    if (event.higher.slot < kCalm) log_of_calm.events.push_back(event);
  }
  for (int q = 0; q < kQueries; ++q) {
    for (const auto& [pair, asked] : log.of(static_cast<Query>(q))) {
      if (pair.first >= kCalmRadius) log_of_calm.of[q][pair] = asked;
    }
  }
  log_of_calm.queries = scene.detector().counters().queries;
  return log_of_calm;
}

auto BitsOf(const detection::CollisionEvent& e) {
  return std::tuple(e.lower, e.higher, e.contact, e.revision, e.now, e.status, e.begin.earliest,
                    e.begin.latest, e.end.earliest, e.end.latest, e.separation_lower,
                    e.separation_upper, e.depth_lower, e.work, e.limited_by);
}

const QueryLog::Queries& Of(const CalmLog& log_of_calm, Query query) {
  return log_of_calm.of[static_cast<int>(query)];
}

std::size_t CountOf(const QueryLog::Queries& queries) {
  std::size_t count = 0;
  for (const auto& [pair, asked] : queries) count += asked.size();
  return count;
}

/// The pairs of the queries, and the steps in which these were put.
std::set<std::tuple<double, double, std::int64_t>> TimesOf(const QueryLog::Queries& queries) {
  std::set<std::tuple<double, double, std::int64_t>> times;
  for (const auto& [pair, asked] : queries) {
    for (const LoggedQuery& one : asked) times.insert({pair.first, pair.second, one.now});
  }
  return times;
}

void JudgeSame(const CalmLog& alone, const CalmLog& among, const std::string& where,
               Outcome* outcome) {
  const bool same_events =
      std::equal(alone.events.begin(), alone.events.end(), among.events.begin(), among.events.end(),
                 [](const detection::CollisionEvent& a, const detection::CollisionEvent& b) {
                   return BitsOf(a) == BitsOf(b);
                 });
  outcome->Expect(same_events, where + "other events of calm ones");
  outcome->Expect(Of(alone, Query::kJudged) == Of(among, Query::kJudged),
                  where + "calm pairs are judged more often, or at other times");
  outcome->Expect(Of(alone, Query::kAsked) == Of(among, Query::kAsked),
                  where + "calm pairs are asked again more often, at other times, or otherwise");
}

// The reference is exhaustive: it has no filter, so it queries the canonical routine for every
// possible partner of an agent. How many of these queries other methods spare depends on where all
// agents are, the violent one included: with and without it they may query a pair less often, but
// never at a time at which the reference does not.
void JudgeMet(const Wild& wild, broad_phase::BroadPhaseMethod method, const CalmLog& alone,
              const CalmLog& among, const CalmLog& swept, Outcome* outcome) {
  const std::string where = std::string(Name(method)) + ", " + wild.name + ": ";
  JudgeSame(alone, among, where, outcome);
  const auto all = TimesOf(Of(swept, Query::kMet));
  const auto times = TimesOf(Of(among, Query::kMet));
  const auto without = TimesOf(Of(alone, Query::kMet));
  if (method == broad_phase::BroadPhaseMethod::kExhaustive) {
    outcome->Expect(times == all && without == all,
                    where + "calm ones are asked about each other at other times");
  }
  for (const auto& of : {times, without}) {
    outcome->Expect(std::includes(all.begin(), all.end(), of.begin(), of.end()),
                    where + "calm ones are asked about each other at a time of its own");
  }
  outcome->Add("calm_revisions", static_cast<double>(among.events.size()));
  outcome->Add("judged", static_cast<double>(CountOf(Of(among, Query::kJudged))));
  outcome->Add("asked", static_cast<double>(CountOf(Of(among, Query::kAsked))));
  outcome->Add("met", static_cast<double>(times.size()));
  outcome->Add("queries_without", static_cast<double>(alone.queries));
  outcome->Add("queries_with", static_cast<double>(among.queries));
}

void Violent(const Setting& setting, Outcome* outcome) {
  const int steps = setting.Many(640, 6400);
  for (const Wild& wild : kWild) {
    const CalmLog swept =
        RunAmong(wild, false, broad_phase::BroadPhaseMethod::kExhaustive, steps, outcome);
    outcome->Expect(CountOf(Of(swept, Query::kMet)) > kCalm * kCalm, "no query was taken down");
    for (const auto method :
         {broad_phase::BroadPhaseMethod::kExhaustive, broad_phase::BroadPhaseMethod::kAllPairs,
          broad_phase::BroadPhaseMethod::kSpatialIndex, broad_phase::BroadPhaseMethod::kAuto}) {
      const CalmLog alone = RunAmong(wild, false, method, steps, outcome);
      const CalmLog among = RunAmong(wild, true, method, steps, outcome);
      JudgeMet(wild, method, alone, among, swept, outcome);
    }
  }
  outcome->Expect(outcome->Get("calm_revisions") > 100, "the calm ones hardly meet");
  outcome->Expect(outcome->Get("judged") > 1000 && outcome->Get("asked") > 1000,
                  "tracked pairs are hardly asked");
  const auto show = [outcome](const char* name) { return Show(outcome->Get(name)); };
  outcome->Say(show("calm_revisions") + " revisions between calm ones; tracked ones judged " +
               show("judged") + " and asked again " + show("asked") +
               " times, the others asked about each other in " + show("met") +
               " steps, counted by pairs; queries of all agents " + show("queries_without") +
               " without and " + show("queries_with") + " with the violent ones");
}

}  // namespace

std::vector<Case> ViolentCases() {
  return {
      {"stiff", "violent-agent",
       "with and without violent agents the same bits of each calm pair (M 0, 0.5 and 50 beside "
       "8000 m/s2), with every broad phase: its events, how often it is judged and asked again, "
       "when, and what is answered; in which steps calm ones are asked about each other, with a "
       "broad phase without filters, and in no others with any",
       Violent}};
}

}  // namespace collision::stress
