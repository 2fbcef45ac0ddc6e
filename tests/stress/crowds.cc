// Very many at once: at one point, at one instant.
#include <cmath>

#include "tests/stress/scene.h"

namespace collision::stress {
namespace {

using Eigen::Vector3d;

constexpr std::int64_t kStep = 1'000'000'000 / 64;

AgentDeclaration BallOf(double radius, double acceleration_max = 0) {
  AgentDeclaration declaration;
  declaration.radius = radius;
  declaration.acceleration_max = acceleration_max;
  return declaration;
}

DetectorOptions OptionsFor(std::uint32_t agents) {
  DetectorOptions options;
  options.agents_max = agents;
  return options;
}

// Everybody at the same point: in contact, or told as saturated, and never silent.
void OnePoint(const Setting& setting, Outcome* outcome) {
  const auto agents = static_cast<std::uint32_t>(setting.Many(400, 6000));
  const int steps = setting.Many(32, 128);
  const DetectorOptions options = OptionsFor(agents);
  Scene scene(options, Instant(), outcome);
  for (std::uint32_t k = 0; k < agents; ++k) {
    scene.Add(BallOf(k % 3 == 0 ? 0 : 1, 0.1), Straight({0, 0, 0}, {0, 0, 0}), 8);
  }
  scene.Run(kStep, 1);
  Detector& detector = scene.detector();
  const std::uint64_t admission = detector.counters().pair_queries;
  scene.Run(kStep, steps);
  int silent = 0;
  for (std::uint32_t k = 0; k < agents; ++k) {
    const auto clearance = detector.ClearanceOf({1, k, 1, 1});
    const bool told = clearance && (clearance->saturated || clearance->in_contact ||
                                    clearance->clear_until <= scene.now());
    silent += told ? 0 : 1;
  }
  outcome->Expect(silent == 0, "agents at one point are told to be clear");
  outcome->Expect(detector.pairs_tracked() <= options.pairs_max, "too many pairs");
  // Each may fill its own room once, and is asked some times a second after that.
  const double admission_max = 2.0 * agents * options.pairs_per_agent_max;
  outcome->Expect(static_cast<double>(admission) <= admission_max, "work at the admission");
  const double later = static_cast<double>(detector.counters().pair_queries - admission);
  outcome->Expect(later <= 8.0 * agents * steps, "work in each step");
  outcome->Set("agents", agents);
  outcome->Set("pairs_tracked", static_cast<double>(detector.pairs_tracked()));
  outcome->Set("pair_queries_at_admission", static_cast<double>(admission));
  outcome->Set("pair_queries_a_step", later / steps);
  outcome->Say(Show(agents) + " agents: " + Show(static_cast<double>(detector.pairs_tracked())) +
               " pairs tracked, " + Show(static_cast<double>(admission)) +
               " pair queries at the admission, " + Show(later / steps) + " a step");
}

/// Contacts of a crowd of pairs, all in the same instant.
void Simultaneous(const Setting& setting, Outcome* outcome) {
  const int side = setting.Many(10, 22), pairs = side * side * side;
  Scene scene(OptionsFor(2 * pairs), Instant(), outcome);
  const Vector3d x(1, 0, 0);
  for (int k = 0; k < pairs; ++k) {
    const Vector3d at = 64.0 * Vector3d(k % side, k / side % side, k / side / side);
    const auto a = scene.Add(BallOf(1, 0.01), Straight(at - 5 * x, 4 * x), 4);
    const auto b = scene.Add(BallOf(1, 0.01), Straight(at + 5 * x, -4 * x), 4);
    scene.Touch(a, b, 1, 1.5);
  }
  scene.Run(kStep, 128);
  // Between states 1/16 s apart each is known to M T²/8 = 5e-6 m; they close at 8 m/s. Contact begins
  // at a state here.
  scene.Judge(1e-5, true);
  outcome->Expect(scene.events_per_step_max() <= static_cast<std::size_t>(4 * pairs),
                  "more events in a step than 4 a pair");
  SayScene(scene, outcome);
}

}  // namespace

std::vector<Case> CrowdCases() {
  return {{"extreme", "one-point",
           "who is at one point with everybody is in contact, saturated or not clear; at most "
           "65536 pairs, 512 pair queries an agent at the admission and 8 a step",
           OnePoint},
          {"extreme", "simultaneous",
           "of a thousand and more contacts in one instant each is announced before and "
           "confirmed, begins within 10 us (M T2/4 over the speed, twice); at most 4 events a pair "
           "in a step",
           Simultaneous}};
}

}  // namespace collision::stress
