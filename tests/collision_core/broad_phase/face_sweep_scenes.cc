#include "tests/collision_core/broad_phase/face_sweep_scenes.h"

#include <algorithm>
#include <cmath>

namespace collision::broad_phase {
namespace {

double Whole(Random* random, int extent) {
  return static_cast<double>(random->Below(2 * extent + 1)) - extent;
}

Eigen::Vector3d WholeVector(Random* random, int extent) {
  const double x = Whole(random, extent), y = Whole(random, extent);
  return {x, y, Whole(random, extent)};
}

/// Most scenes have a modest M, some none, some an enormous one.
double RandomAcceleration(Random* random) {
  if (random->Chance(0.4)) return 0;
  return random->Chance(0.1) ? random->LogUniform(1e-6, 1e18) : random->Uniform(0, 5);
}

motion::SpaceTimeBound Grazing(Random* random) {
  const int along = static_cast<int>(random->Below(3)), across = (along + 1) % 3;
  Eigen::Vector3d p = Eigen::Vector3d::Zero(), v = Eigen::Vector3d::Zero();
  const double radius = random->Uniform(0.1, 1);
  p[across] = (random->Chance(0.5) ? 2 : -2) * radius;
  for (std::uint64_t i = random->Below(3); i > 0; --i) p[across] = std::nextafter(p[across], 1e9);
  p[along] = random->Uniform(-20, 20);
  v[along] = random->Uniform(-5, 5);
  return Agent(p, v, radius);
}

motion::SpaceTimeBound RandomAgent(SweepLayout layout, Random* random) {
  const double M = RandomAcceleration(random);
  switch (layout) {
    case SweepLayout::kUniform:
    case SweepLayout::kOutliers: {
      motion::SpaceTimeBound bound = Agent(RandomVector(random, 50), RandomVector(random, 10),
                                           random->Uniform(0, 1), std::min(M, 1e3));
      if (layout == SweepLayout::kOutliers && random->Chance(0.05)) {
        const double far = random->LogUniform(1e6, 1e300);
        const int what = static_cast<int>(random->Below(4));
        if (what == 0) bound.state.p_WA *= far;
        if (what == 1) bound.state.v_WA *= far;
        if (what == 2) bound.limits.radius = far;
        if (what == 3) bound.limits.acceleration_max = far;
      }
      return bound;
    }
    case SweepLayout::kLattice:
      return Agent(4 * WholeVector(random, 4), WholeVector(random, 2), 1,
                   static_cast<double>(random->Below(2)));
    case SweepLayout::kOnePoint:
      return Agent({1, 2, 3},
                   random->Chance(0.5) ? Eigen::Vector3d::Zero() : WholeVector(random, 3),
                   random->Chance(0.5) ? 0 : 1, M);
    case SweepLayout::kConvoy:
      return Agent(RandomVector(random, 20), {1000, 2, 0}, 0.5,
                   static_cast<double>(random->Below(2)));
    case SweepLayout::kToOnePoint: {
      const Eigen::Vector3d p = RandomVector(random, 50);
      return Agent(p, -p, 0.01);
    }
    case SweepLayout::kScales:
      return Agent(random->LogUniform(1e-12, 1e12) * random->UnitVector(),
                   random->LogUniform(1e-12, 1e12) * random->UnitVector(),
                   random->LogUniform(1e-12, 1e12), M);
    case SweepLayout::kFarAway: {
      const Eigen::Vector3d p = RandomVector(random, 50) + Eigen::Vector3d(1e12, -1e12, 1e12);
      return Agent(p, RandomVector(random, 10), 0.5, std::min(M, 5.0));
    }
    case SweepLayout::kGrazing:
      return Grazing(random);
    case SweepLayout::kTwoClusters: {
      const Eigen::Vector3d p = RandomVector(random, 50);
      return Agent(random->Chance(0.5) ? p : p + Eigen::Vector3d(1e9, 1e9, 0),
                   RandomVector(random, 5), 0.5, std::min(M, 1.0));
    }
    case SweepLayout::kStill:
      return random->Chance(0.9) ? Agent(RandomVector(random, 50), {0, 0, 0}, 1)
                                 : Agent(RandomVector(random, 50), RandomVector(random, 10), 1);
  }
  return {};
}

Instant RandomUntil(intersection::BoundKind kind, Instant from, Random* random) {
  switch (random->Below(kind == intersection::BoundKind::kHorn ? 7 : 6)) {
    case 0:
      return from;
    case 1:
      return At(from.nanoseconds() + 1 + random->Below(1000));
    case 2:
      return At(from.nanoseconds() + kSecond);
    case 3:
    case 4:
      return At(from.nanoseconds() + 1 + random->Below(30 * kSecond));
    case 5:
      return At(from.nanoseconds() + kCentury / 10);
    default:
      return Instant::Never();
  }
}

/// What a scene's agents have beside their motions, each with the chance given.
void Embellish(double chance, Instant from, bool late, AgentBound* agent, Random* random) {
  motion::SpaceTimeBound* bound = &agent->bound;
  motion::MotionState& state = bound->state;
  if (random->Chance(chance)) {
    const std::int64_t ago = random->Chance(0.1) ? kCentury / 10 : 10 * kSecond;
    const auto by = static_cast<std::int64_t>(random->Below(ago));
    state.stamp = At(from.nanoseconds() + (late && random->Chance(0.5) ? by : -by));
  }
  if (random->Chance(chance)) {
    state.expiry = At(state.stamp.nanoseconds() + random->Below(20 * kSecond));
  }
  if (random->Chance(chance)) state.position_error = random->Uniform(0, 0.1);
  if (random->Chance(chance)) state.velocity_error = random->Uniform(0, 0.1);
  if (random->Chance(chance)) bound->skew = random->Uniform(0, 0.01);
  if (random->Chance(chance)) bound->limits.time_step = random->Uniform(0, 0.1);
  if (random->Chance(chance)) {
    state.direction = random->UnitVector();
    if (random->Chance(0.5)) {
      state.direction_until = At(state.stamp.nanoseconds() + random->Below(5 * kSecond));
    }
  }
  if (random->Chance(chance)) bound->limits.speed_max = random->Uniform(0, 30);
  if (random->Chance(chance)) {
    agent->filter.group = 1u << random->Below(4);
    agent->filter.mask = static_cast<std::uint32_t>(random->Below(16));
  }
}

/// Else nearly every scene's first meeting is at once.
void RemoveOverlapsAtStart(SweepScene* scene) {
  std::vector<AgentBound> kept;
  for (const AgentBound& bound : scene->agents) {
    const bool is_apart = std::none_of(kept.begin(), kept.end(), [&](const AgentBound& other) {
      return EarliestIntersectionOf(scene->query, bound, other).instant() <= scene->query.from;
    });
    if (is_apart) kept.push_back(bound);
  }
  scene->agents = kept;
}

}  // namespace

std::vector<motion::SpaceTimeBound> LayOut(SweepLayout layout, int count, Random* random) {
  std::vector<motion::SpaceTimeBound> agents;
  while (static_cast<int>(agents.size()) < count) {
    const bool is_again = !agents.empty() && random->Chance(0.02);
    agents.push_back(is_again ? agents[random->Below(agents.size())] : RandomAgent(layout, random));
  }
  return agents;
}

SweepScene RandomScene(SweepLayout layout, intersection::BoundKind kind, int count,
                       Random* random) {
  SweepScene scene;
  for (const motion::SpaceTimeBound& bound : LayOut(layout, count, random)) {
    scene.agents.emplace_back(bound);
  }
  // The clock of 1970 as well as one that starts at zero.
  const Instant from =
      At(random->Chance(0.5) ? 0 : 1'700'000'000 * kSecond + random->Below(kSecond));
  const double chance = random->Chance(0.5) ? 0 : 0.2;
  for (AgentBound& agent : scene.agents) {
    agent.bound.state.stamp = from;
    Embellish(chance, from, kind == intersection::BoundKind::kHorn, &agent, random);
  }
  scene.query = {kind, from, RandomUntil(kind, from, random)};
  if (random->Chance(0.7)) RemoveOverlapsAtStart(&scene);
  return scene;
}

std::optional<intersection::IntersectingPair> PlainEarliest(const SweepScene& scene) {
  std::optional<intersection::IntersectingPair> best;
  for (std::uint32_t a = 0; a < scene.agents.size(); ++a) {
    for (std::uint32_t b = a + 1; b < scene.agents.size(); ++b) {
      const intersection::IntersectingPair meeting{
          a, b, EarliestIntersectionOf(scene.query, scene.agents[a], scene.agents[b])};
      if (meeting.time.instant().is_never()) continue;
      if (!best || meeting < *best) best = meeting;
    }
  }
  return best;
}

std::unique_ptr<FaceSweep> Filled(const SweepScene& scene) {
  auto sweep = std::make_unique<FaceSweep>();
  for (std::uint32_t i = 0; i < scene.agents.size(); ++i) sweep->Set(i, scene.agents[i]);
  return sweep;
}

}  // namespace collision::broad_phase
