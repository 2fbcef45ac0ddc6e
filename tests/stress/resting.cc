// Bodies that rest, roll, chatter and are stacked.
#include <algorithm>
#include <cmath>

#include "collision_core/narrow_phase/work.h"
#include "collision_core/shape/shape.h"
#include "tests/stress/scene.h"
#include "tests/support/meshes.h"
#include "tests/support/solids.h"

namespace collision::stress {
namespace {

using Eigen::Vector3d;

constexpr std::int64_t kStep = 1'000'000'000 / 64;
constexpr double kStepSeconds = 0x1p-6;

/// Revisions of events in a step at most, for each pair that is tracked.
constexpr double kEventsPerPair = 4;

std::shared_ptr<const Shape> CubeShape() {
  static const auto cube = Shape::Build(Cube(0.5));
  return cube;
}

std::shared_ptr<const Shape> SlabShape() {
  static const auto slab = Shape::Build(Box({-16, -16, -1}, {16, 16, 0}));
  return slab;
}

AgentDeclaration Of(std::shared_ptr<const Shape> shape, double acceleration_max) {
  AgentDeclaration declaration;
  declaration.radius = shape->facts().radius;
  declaration.acceleration_max = acceleration_max;
  declaration.angular_acceleration_max = acceleration_max;
  declaration.shape = std::move(shape);
  return declaration;
}

AgentDeclaration BallOf(double radius, double acceleration_max) {
  AgentDeclaration declaration;
  declaration.radius = radius;
  declaration.acceleration_max = acceleration_max;
  return declaration;
}

/// What the work of a step is limited to here.
DetectorOptions Limited() {
  DetectorOptions options;
  options.work_units_per_turn = 20'000;
  options.work_units_per_step = 60'000;
  return options;
}

/// A pair far from everything else, which meets after `begin` seconds: nobody may starve it.
void AddBystanders(Scene* scene, double begin) {
  const Vector3d far(4096, 0, 0), x(1, 0, 0);
  const double half = 0.5 + begin;
  const auto a = scene->Add(BallOf(0.5, 0.01), Straight(far - half * x, x));
  const auto b = scene->Add(BallOf(0.5, 0.01), Straight(far + half * x, -x));
  scene->Touch(a, b, begin, begin + 1);
}

/// The second half of a run needs no more room than the first one, and a step is bounded.
void RunSteadily(Scene* scene, int steps, Outcome* outcome, Seconds width = 1e-3) {
  scene->Run(kStep, steps / 2);
  const std::size_t before = scene->queued_max();
  scene->Run(kStep, steps - steps / 2);
  outcome->Expect(scene->queued_max() <= before, "the queue grows");
  const double pairs = static_cast<double>(scene->detector().agents());
  outcome->Expect(static_cast<double>(scene->events_per_step_max()) <= kEventsPerPair * pairs,
                  "more events in a step than 4 an agent");
  const double units = static_cast<double>(Limited().work_units_per_step) + kBatchUnits * pairs;
  outcome->Expect(static_cast<double>(scene->work_per_step_max()) <= 2 * units,
                  "a step spends more than twice what is allowed");
  scene->Judge(width, false);
  outcome->Set("revisions_per_step",
               static_cast<double>(scene->events().size()) / static_cast<double>(steps));
  SayScene(*scene, outcome);
}

// A cube, and a ball, on a slab, with no gap at all and no overlap.
void Resting(const Setting& setting, Outcome* outcome) {
  Scene scene(Limited(), Instant(), outcome);
  scene.Add(Of(SlabShape(), 0), Straight({0, 0, 0}, {0, 0, 0}));
  const auto cube = scene.Add(Of(CubeShape(), 0.01), Straight({0, 0, 0.5}, {0, 0, 0}));
  const auto ball = scene.Add(BallOf(0.5, 0.01), Straight({4, 0, 0.5}, {0, 0, 0}));
  scene.Touch(0, cube, 0, INFINITY);
  scene.Touch(0, ball, 0, INFINITY);
  AddBystanders(&scene, 1.5);
  RunSteadily(&scene, setting.Many(640, 6400), outcome);
}

// Cubes head on, of the smallest size that the edge lets pass to nearly the largest.
void ShapeScenes(const Setting&, Outcome* outcome) {
  for (int exponent = -20; exponent <= 20; exponent += 5) {
    const double half = std::ldexp(1, exponent);
    const auto cube = Shape::Build(Cube(half));
    Scene scene(Limited(), Instant(), outcome);
    const Vector3d x(1, 0, 0);
    const auto a = scene.Add(Of(cube, 0), Straight(-7 * half * x, 4 * half * x));
    const auto b = scene.Add(Of(cube, 0), Straight(7 * half * x, -4 * half * x));
    scene.Touch(a, b, 1.5, 2);
    scene.Run(kStep, 192);
    scene.Judge(kStepSeconds, true);
    SayScene(scene, outcome);
  }
}

void Stack(const Setting& setting, Outcome* outcome) {
  Scene scene(Limited(), Instant(), outcome);
  scene.Add(Of(SlabShape(), 0), Straight({0, 0, 0}, {0, 0, 0}));
  for (std::uint32_t k = 0; k < 10; ++k) {
    const double aside = k % 2 == 0 ? 0 : 0.125;
    scene.Add(Of(CubeShape(), 0.01), Straight({aside, 0, 0.5 + k}, {0, 0, 0}));
    scene.Touch(k, k + 1, 0, INFINITY);
  }
  AddBystanders(&scene, 1.5);
  RunSteadily(&scene, setting.Many(320, 3200), outcome);
}

// A ball of triangles and a smooth one roll over a slab: v = ω r.
void Rolling(const Setting& setting, Outcome* outcome) {
  Scene scene(Limited(), Instant(), outcome);
  scene.Add(Of(SlabShape(), 0), Straight({0, 0, 0}, {0, 0, 0}));
  const auto round = Shape::Build(Sphere(2));
  const double speed = 1;
  const auto roll = [speed](Seconds t) {
    MotionState state;
    const double s = static_cast<double>(t);
    state.p_WA = {-8 + speed * s, 0, 1};
    state.v_WA = {speed, 0, 0};
    state.w_WB = {0, speed, 0};
    state.q_WB = Eigen::Quaterniond(std::cos(s * speed / 2), 0, std::sin(s * speed / 2), 0);
    state.rotation_error = 1e-12;
    return state;
  };
  // Of triangles it touches the slab with its corners only, if at all.
  const auto ball = scene.Add(Of(round, 0.01), roll);
  const auto smooth = scene.Add(BallOf(1, 0.01), Straight({-8, 4, 1}, {speed, 0, 0}));
  scene.Touch(0, ball, 0, INFINITY);
  scene.Touch(0, smooth, 0, INFINITY);
  AddBystanders(&scene, 1.5);
  RunSteadily(&scene, setting.Many(640, 1000), outcome);
}

// A ball that bounces off a slab and loses half of its speed each time: infinitely many contacts in
// a finite time (Zeno). Its bound allows for the impacts.
struct Bouncing {
  double speed = 4, gravity = 8, restitution = 0.5;

  MotionState At(Seconds t) const {
    Seconds u = speed, from = 0;
    while (u > 1e-9L && t > from + 2 * u / gravity) {
      from += 2 * u / gravity;
      u *= restitution;
    }
    MotionState state;
    const Seconds s = t - from;
    if (u <= 1e-9L) u = 0;
    const Seconds z = u > 0 ? u * s - gravity * s * s / 2 : 0;
    state.p_WA = {0, 0, static_cast<double>(std::max<Seconds>(0, z)) + 0.5};
    state.v_WA = {0, 0, u > 0 ? static_cast<double>(u - gravity * s) : 0};
    state.position_error = 1e-9;
    state.velocity_error = 1e-9;
    return state;
  }
};

void TouchAtBounces(const Bouncing& bouncing, std::uint32_t ball, Scene* scene) {
  Seconds at = 0;
  for (Seconds u = bouncing.speed; u > 0.01; u *= bouncing.restitution) {
    scene->Touch(0, ball, at, at);
    at += 2 * u / bouncing.gravity;
  }
}

void Chattering(const Setting& setting, Outcome* outcome) {
  Scene scene(Limited(), Instant(), outcome);
  const Bouncing bouncing;
  // Up to twice the speed within a step, and the way that follows from it.
  const double M = 4 * bouncing.speed / kStepSeconds;
  scene.Add(Of(SlabShape(), 0), Straight({0, 0, 0}, {0, 0, 0}));
  const auto ball = scene.Add(BallOf(0.5, M), [bouncing](Seconds t) { return bouncing.At(t); });
  TouchAtBounces(bouncing, ball, &scene);
  AddBystanders(&scene, 1.5);
  // What happens between two states, and how soon it is over, is not known any closer.
  RunSteadily(&scene, setting.Many(640, 6400), outcome, 2 * kStepSeconds);
}

// The same with each impact declared as a discontinuity, under a bound of gravity alone.
void ChatteringJumps(const Setting& setting, Outcome* outcome) {
  Scene scene(Limited(), Instant(), outcome);
  const Bouncing bouncing;
  scene.Add(Of(SlabShape(), 0), Straight({0, 0, 0}, {0, 0, 0}));
  double last = 0;
  scene.Add(BallOf(0.5, bouncing.gravity), [bouncing, last](Seconds t) mutable {
    MotionState state = bouncing.At(t);
    const double fell = last - bouncing.gravity * kStepSeconds;
    state.discontinuity = std::abs(state.v_WA.z() - fell) > 1e-6 && t > 0;
    last = state.v_WA.z();
    return state;
  });
  TouchAtBounces(bouncing, 1, &scene);
  AddBystanders(&scene, 1.5);
  RunSteadily(&scene, setting.Many(640, 6400), outcome, 2 * kStepSeconds);
}

const char* const kSteady =
    "no contact is missed or told late, another pair is not starved; at most 4 events an agent and "
    "twice the work allowed in a step, the queue does not grow";

}  // namespace

std::vector<Case> RestingCases() {
  return {{"extreme", "shape-scenes",
           "cubes of 2^-20 to 2^20 m: contact is never missed or told late, and confirmed; begins "
           "within a step",
           ShapeScenes},
          {"stiff", "resting", kSteady, Resting},
          {"stiff", "stack", kSteady, Stack},
          {"stiff", "rolling", kSteady, Rolling},
          {"stiff", "chattering", kSteady, Chattering},
          {"stiff", "chattering-jumps", kSteady, ChatteringJumps}};
}

}  // namespace collision::stress
