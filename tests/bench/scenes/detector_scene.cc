#include "tests/bench/scenes/detector_scene.h"

#include <algorithm>
#include <cmath>

#include "collision_core/numeric/seconds.h"
#include "tests/baselines/ball_bound.h"
#include "tests/baselines/scenes.h"
#include "tests/bench/harness/allocation_counter.h"
#include "tests/bench/harness/measure.h"
#include "tests/bench/harness/number_hash.h"
#include "tests/support/random.h"

namespace collision::bench {
namespace {

/// The share of the greatest acceleration in use, so that rounding cannot pass it.
constexpr double kForce = 0.99;

detection::AgentId IdOf(std::size_t agent) { return {1, static_cast<std::uint32_t>(agent), 1, 1}; }

DetectorScene SceneOf(const std::string& name, const baselines::BallScene& balls, int steps) {
  DetectorScene scene;
  scene.name = name;
  scene.steps = steps;
  for (const baselines::BallAgent& ball : balls) {
    const motion::SpaceTimeBound bound = baselines::BoundOf(ball);
    scene.agents.push_back({bound.state, {.limits = bound.limits}});
    scene.agents.back().state.stamp = Instant();
  }
  return scene;
}

/// The motion goes on for one step under a constant acceleration.
void Move(double step, const Eigen::Vector3d& acceleration, motion::MotionState* state) {
  state->p_WA += step * state->v_WA + (0.5 * step * step) * acceleration;
  state->v_WA += step * acceleration;
  state->stamp = numeric::AddRoundedDown(state->stamp, step);
}

void Take(detection::Detector* detector, NumberHash* hash, DetectorCost* cost) {
  for (const detection::CollisionEvent& event : detector->events()) {
    hash->Add(static_cast<double>(event.lower.slot)),
        hash->Add(static_cast<double>(event.higher.slot));
    hash->Add(static_cast<double>(event.status));
    hash->Add(static_cast<double>(event.begin.earliest.nanoseconds()));
    hash->Add(static_cast<double>(event.begin.latest.nanoseconds()));
    ++cost->messages;
  }
  for (const detection::AgentClearance& clearance : detector->TakeChangedClearances()) {
    hash->Add(static_cast<double>(clearance.agent.slot));
    hash->Add(static_cast<double>(clearance.clear_until.nanoseconds()));
    ++cost->messages;
  }
}

}  // namespace

std::vector<DetectorScene> DetectorScenes(bool few, int steps) {
  std::vector<DetectorScene> scenes;
  for (const std::uint32_t count : {100u, 300u, 600u, 1500u, 4000u}) {
    if (few && count > 600) continue;
    scenes.push_back(SceneOf("uniform-" + std::to_string(count),
                             baselines::FirstHitScene(count, baselines::FirstHit::kAtOnce), steps));
  }
  struct Special {
    const char* name;
    std::uint32_t count;
  };
  for (const Special& special :
       {Special{"clustered", 200}, Special{"clustered", 500}, Special{"clustered", 2000},
        Special{"mixed-sizes", 600}, Special{"mixed-acceleration", 600}, Special{"lattice", 512},
        Special{"falling-pile", 400}, Special{"convoy", 500}, Special{"one-cell", 200},
        Special{"one-fast", 600}}) {
    if (few && special.count > 600) continue;
    scenes.push_back(SceneOf(special.name + ("-" + std::to_string(special.count)),
                             baselines::MakeScene(special.name, special.count, 1), steps));
  }
  return scenes;
}

DetectorCost Cost(const DetectorScene& scene, const Variation& variation) {
  KeepMemory();
  std::vector<SceneAgent> agents = scene.agents;
  Random random(scene.seed);
  DetectorCost cost;
  NumberHash hash;
  const auto bytes_before = LiveBytes();
  detection::DetectorOptions options = variation.options;
  options.agents_max = static_cast<std::uint32_t>(agents.size());
  detection::Detector detector(options);
  double start = CpuNow();
  for (std::size_t i = 0; i < agents.size(); ++i) {
    if (variation.change) variation.change(&agents[i]);
    detector.Admit(IdOf(i), agents[i].declaration, agents[i].state, Instant());
  }
  detector.Advance(Instant());
  Take(&detector, &hash, &cost);
  cost.seconds += CpuNow() - start;
  for (int step = 1; step <= scene.steps; ++step) {
    for (SceneAgent& agent : agents) {
      const double force =
          variation.forces ? kForce * agent.declaration.limits.acceleration_max : 0;
      Move(scene.step, random.Uniform(0, force) * random.UnitVector(), &agent.state);
      if (variation.change) variation.change(&agent);
    }
    const Instant now = agents.front().state.stamp;
    start = CpuNow();
    for (std::size_t i = 0; i < agents.size(); ++i) {
      detector.Update(IdOf(i), agents[i].state, now);
      detector.SetHeardUntil(OwnerOf(IdOf(i)), now);
    }
    detector.Advance(now);
    Take(&detector, &hash, &cost);
    cost.seconds += CpuNow() - start;
  }
  cost.bytes = static_cast<double>(LiveBytes() - bytes_before);
  cost.broad_units = static_cast<double>(detector.counters().broad_units);
  cost.narrow_units = static_cast<double>(detector.counters().work_units);
  cost.hash = hash.text();
  cost.profile = detector.profile();
  return cost;
}

}  // namespace collision::bench
