// Very many at once: at one point, at one instant.
#include <cmath>
#include <map>

#include "tests/stress/scene.h"

namespace collision::stress {
namespace {

using Eigen::Vector3d;

constexpr std::int64_t kStep = 1'000'000'000 / 64;

detection::AgentDeclaration BallOf(double radius, double acceleration_max = 0) {
  detection::AgentDeclaration declaration;
  declaration.limits.radius = radius;
  declaration.limits.acceleration_max = acceleration_max;
  return declaration;
}

detection::DetectorOptions OptionsFor(std::uint32_t agents) {
  detection::DetectorOptions options;
  options.agents_max = agents;
  return options;
}

double RadiusOf(std::uint32_t agent) { return agent % 3 == 0 ? 0 : 1; }

// All are admitted at once at exactly known places: so their contacts are known exactly.
void JudgePairs(const Scene& scene, Outcome* outcome) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, const detection::CollisionEvent*> newest;
  for (const detection::CollisionEvent& event : scene.events()) {
    newest[{event.lower.slot, event.higher.slot}] = &event;
  }
  outcome->Expect(newest.size() == scene.detector().pairs_tracked(),
                  "a tracked pair is not reported");
  for (const auto& [pair, event] : newest) {
    const double truth = -RadiusOf(pair.first) - RadiusOf(pair.second);
    outcome->Expect(event->status == detection::EventStatus::kConfirmed,
                    "a contact is not confirmed");
    outcome->Expect(event->separation_lower <= truth && truth <= event->separation_upper,
                    "the distance is not in its bracket");
    const std::int64_t begin[] = {event->begin.earliest.nanoseconds(),
                                  event->begin.latest.nanoseconds()};
    outcome->Expect(begin[0] <= 0 && begin[1] >= 0, "the begin is not in its bracket");
    const double width = static_cast<double>(begin[1]) - static_cast<double>(begin[0]);
    outcome->Greatest("begin_width_ns", width);
    outcome->Expect(width <= 2, "a wide begin");
  }
}

// All at the same point: in contact or saturated, and never silent.
void OnePoint(const Setting& setting, Outcome* outcome) {
  const auto agents = static_cast<std::uint32_t>(setting.Many(400, 6000));
  const int steps = setting.Many(32, 128);
  const detection::DetectorOptions options = OptionsFor(agents);
  Scene scene(options, Instant(), outcome);
  for (std::uint32_t k = 0; k < agents; ++k) {
    scene.Add(BallOf(RadiusOf(k), 0.1), Straight({0, 0, 0}, {0, 0, 0}), 8);
  }
  scene.Run(kStep, 1);
  detection::Detector& detector = scene.detector();
  const std::uint64_t admission = detector.counters().pair_queries;
  scene.Run(kStep, steps);
  JudgePairs(scene, outcome);
  int silent = 0;
  for (std::uint32_t k = 0; k < agents; ++k) {
    const auto clearance = detector.ClearanceOf({1, k, 1, 1});
    const bool told = clearance && (clearance->saturated || clearance->in_contact ||
                                    clearance->clear_until <= scene.now());
    silent += told ? 0 : 1;
  }
  outcome->Expect(silent == 0, "agents at one point are reported clear");
  outcome->Expect(detector.pairs_tracked() <= options.pairs_max, "too many pairs");
  // Each may fill its own room once, and is queried some times a second after that.
  const double admission_max = 2.0 * agents * options.pairs_per_agent_max;
  outcome->Expect(static_cast<double>(admission) <= admission_max, "work at the admission");
  const double later = static_cast<double>(detector.counters().pair_queries - admission);
  outcome->Expect(later <= 8.0 * agents * steps, "work in each step");
  outcome->Set("agents", agents);
  outcome->Set("pairs_tracked", static_cast<double>(detector.pairs_tracked()));
  outcome->Set("pair_queries_at_admission", static_cast<double>(admission));
  outcome->Set("pair_queries_a_step", later / steps);
  outcome->Say(Show(agents) + " agents: " + Show(static_cast<double>(detector.pairs_tracked())) +
               " pairs tracked, begins within " + Show(outcome->Get("begin_width_ns")) +
               " ns and distances within " + Show(outcome->Get("distance_width_m")) +
               " m at most, " + Show(static_cast<double>(admission)) +
               " pair queries at the admission, " + Show(later / steps) + " a step");
}

/// Contacts of a crowd of pairs, all in the same instant.
void Simultaneous(const Setting& setting, Outcome* outcome) {
  const int side = setting.Many(10, 22), pairs = side * side * side;
  Scene scene(OptionsFor(2 * pairs), Instant(), outcome);
  scene.ForbidIdle();
  const Vector3d x(1, 0, 0);
  for (int k = 0; k < pairs; ++k) {
    const Vector3d at = 64.0 * Vector3d(k % side, k / side % side, k / side / side);
    const auto a = scene.Add(BallOf(1, 0.01), Straight(at - 5.125 * x, 4 * x), 4);
    const auto b = scene.Add(BallOf(1, 0.01), Straight(at + 5.125 * x, -4 * x), 4);
    scene.Touch(a, b, 1.03125, 1.53125);  // Half-way between two states.
  }
  scene.Run(kStep, 128);
  // Between states 1/16 s apart each is known to M T²/8; they close at 8 m/s.
  constexpr double kBetween = 4 * 0x1p-6;
  scene.Judge(0.01 * kBetween * kBetween / 2 / 8 + 3e-9, true);
  outcome->Expect(scene.events_per_step_max() <= static_cast<std::size_t>(4 * pairs),
                  "more events in a step than 4 a pair");
  SayScene(scene, outcome);
}

}  // namespace

std::vector<Case> CrowdCases() {
  return {{"extreme", "one-point",
           "an agent at one point with all is in contact, saturated or not clear; each tracked "
           "pair's contact is confirmed, its begin known within 2 ns (all is known when they are "
           "admitted), its distance within 32 units in the last place of the radii and what the "
           "bounds leave open in a nanosecond; at most 65536 pairs, 512 pair queries an agent at "
           "the admission and 8 a step",
           OnePoint},
          {"extreme", "simultaneous",
           "of a thousand and more contacts in one instant each is announced before and "
           "confirmed; begins and ends within 3 ns and M T2/2 over the speed; an agent "
           "that could touch none within 1/60 s is clear for as long, and else until it could with "
           "lengths 4 "
           "units in the last place off; at most 4 events a pair in a step",
           Simultaneous}};
}

}  // namespace collision::stress
