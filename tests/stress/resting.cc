// Bodies that rest, roll, chatter and are stacked.
#include <algorithm>
#include <cmath>

#include "collision_core/base/work_budget.h"
#include "collision_core/numeric/seconds.h"
#include "collision_core/shape/shape.h"
#include "tests/stress/scene.h"
#include "tests/support/meshes.h"
#include "tests/support/solids.h"

namespace collision::stress {
namespace {

using Eigen::Vector3d;

constexpr std::int64_t kStep = 1'000'000'000 / 64;
constexpr double kStepSeconds = 0x1p-6;
constexpr double kHalfStep = kStepSeconds / 2;

/// What is announced [s].
constexpr double kAhead = 2;

/// What brackets lose to the nanosecond, and to rounding [s].
constexpr double kInstants = 3e-9;

/// When the bystanders meet [s].
constexpr double kBystanders = 1.5;

/// Revisions of events in a step at most, for each pair that is tracked.
constexpr double kEventsPerPair = 4;

std::shared_ptr<const shape::Shape> CubeShape() {
  static const auto cube = shape::Shape::Build(Cube(0.5));
  return cube;
}

std::shared_ptr<const shape::Shape> SlabShape() {
  static const auto slab = shape::Shape::Build(Box({-16, -16, -1}, {16, 16, 0}));
  return slab;
}

detection::AgentDeclaration Of(std::shared_ptr<const shape::Shape> shape, double acceleration_max) {
  detection::AgentDeclaration declaration;
  declaration.limits.radius = shape->facts().radius;
  declaration.limits.acceleration_max = acceleration_max;
  declaration.limits.angular_acceleration_max = acceleration_max;
  declaration.shape = std::move(shape);
  return declaration;
}

detection::AgentDeclaration BallOf(double radius, double acceleration_max) {
  detection::AgentDeclaration declaration;
  declaration.limits.radius = radius;
  declaration.limits.acceleration_max = acceleration_max;
  return declaration;
}

/// What the work of a step is limited to here.
detection::DetectorOptions Limited() {
  detection::DetectorOptions options;
  options.work_units_per_evaluation = 20'000;
  options.work_units_per_step = 60'000;
  return options;
}

/// Two far from everything else, which meet after `begin` seconds: no other pair may starve them.
/// Returns the first of them; the second comes next. Between two states each surface is known to
/// T²/8 of the greatest acceleration of its points, ahead and behind; they close at 2 m/s.
std::uint32_t AddPair(Scene* scene, const detection::AgentDeclaration& declaration,
                      const Vector3d& far, double begin) {
  const Vector3d x(1, 0, 0);
  const double half = 0.5 + begin;
  const auto a = scene->Add(declaration, Straight(far - half * x, x));
  const auto b = scene->Add(declaration, Straight(far + half * x, -x));
  const double turning =
      declaration.shape ? declaration.limits.angular_acceleration_max * declaration.limits.radius
                        : 0;
  const double open =
      2 * (declaration.limits.acceleration_max + turning) * kStepSeconds * kStepSeconds / 8;
  scene->Touch(a, b, begin, begin + 1, 2 * open / 2 + kInstants);
  return a;
}

/// Two balls and two cubes. Returns the first of the cubes.
std::uint32_t AddBystanders(Scene* scene) {
  AddPair(scene, BallOf(0.5, 0.01), {4096, 0, 0}, kBystanders);
  return AddPair(scene, Of(CubeShape(), 0.01), {8192, 0, 0}, kBystanders);
}

/// How soon and how closely cubes that meet are reported, also while others want all the work there
/// is.
struct Service {
  double after = 4 * kStepSeconds, width = 1e-3;  ///< At most [s].
};

void ExpectServed(const Scene& scene, std::uint32_t cube, double begin, const Service& service,
                  Outcome* outcome) {
  const auto confirmed = std::find_if(
      scene.events().begin(), scene.events().end(), [cube](const detection::CollisionEvent& event) {
        return event.lower.slot == cube && event.status == detection::EventStatus::kConfirmed;
      });
  if (!outcome->Expect(confirmed != scene.events().end(), "a pair of cubes is starved")) return;
  const double after = numeric::SecondsBetween(Instant(), confirmed->now).upper - begin;
  const double found =
      numeric::SecondsBetween(confirmed->begin.earliest, confirmed->begin.latest).upper;
  outcome->Greatest("cubes_told_after_s", after);
  outcome->Greatest("cubes_width_s", found);
  outcome->Expect(after <= service.after, "a pair of cubes is starved: reported late");
  outcome->Expect(found <= service.width, "a pair of cubes is starved: a wide bracket");
}

/// The second half of a run needs no more room than the first one, and a step is bounded. `cube`:
/// AddBystanders().
void RunSteadily(Scene* scene, std::uint32_t cube, int steps, Outcome* outcome) {
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
  scene->Judge(kInstants, false);
  ExpectServed(*scene, cube, kBystanders, {}, outcome);
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
  const auto cubes = AddBystanders(&scene);
  RunSteadily(&scene, cubes, setting.Many(640, 6400), outcome);
}

/// Before the contact at `begin` it is clear until then, or for as long as it is looked ahead.
void ExpectClear(Scene& scene, std::uint32_t agent, Seconds begin, Outcome* outcome) {
  if (scene.elapsed() >= begin) return;
  const auto clearance = scene.detector().ClearanceOf({1, agent, 1, 1});
  if (!outcome->Expect(clearance.has_value(), "no clearance")) return;
  const Seconds ahead = numeric::SecondsBetween(scene.now(), clearance->clear_until).upper;
  const Seconds early = std::min<Seconds>(kAhead, begin - scene.elapsed()) - ahead;
  outcome->Greatest("clear_early_s", static_cast<double>(early));
  outcome->Expect(early <= 3e-9, "idle: clear for less than it could be");
}

// Cubes head on, of the smallest size that the edge lets pass to nearly the largest.
void ShapeScenes(const Setting&, Outcome* outcome) {
  for (int exponent = -20; exponent <= 20; exponent += 5) {
    const double half = std::ldexp(1, exponent);
    const auto cube = shape::Shape::Build(Cube(half));
    Scene scene(Limited(), Instant(), outcome);
    const Vector3d x(1, 0, 0);
    const double away = 7 * half + 4 * half * kHalfStep;
    const auto a = scene.Add(Of(cube, 0), Straight(-away * x, 4 * half * x));
    const auto b = scene.Add(Of(cube, 0), Straight(away * x, -4 * half * x));
    constexpr double kBegin = 1.5 + kHalfStep;
    scene.Touch(a, b, kBegin, kBegin + 0.5);
    for (int i = 0; i < 192; ++i) {
      scene.Run(kStep, 1);
      ExpectClear(scene, a, kBegin, outcome);
    }
    scene.Judge(3e-9, true);
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
  const auto cubes = AddBystanders(&scene);
  RunSteadily(&scene, cubes, setting.Many(320, 3200), outcome);
}

/// Along x from `from`, and turning as a ball of radius 1 does that rolls: v = ω r.
Motion Roll(const Vector3d& from, double speed) {
  return [=](Seconds t) {
    motion::MotionState state;
    const double s = static_cast<double>(t);
    state.p_WA = from + speed * s * Vector3d(1, 0, 0);
    state.v_WA = {speed, 0, 0};
    state.w_WB = {0, speed, 0};
    state.q_WB = Eigen::Quaterniond(std::cos(s * speed / 2), 0, std::sin(s * speed / 2), 0);
    state.rotation_error = 1e-12;
    return state;
  };
}

// A ball of triangles and a smooth one roll over a slab.
void Rolling(const Setting& setting, Outcome* outcome) {
  Scene scene(Limited(), Instant(), outcome);
  scene.Add(Of(SlabShape(), 0), Straight({0, 0, 0}, {0, 0, 0}));
  const auto round = shape::Shape::Build(Sphere(2));
  const double speed = 1;
  // A sphere of triangles touches the slab only with its corners, if at all.
  const auto ball = scene.Add(Of(round, 0.01), Roll({-8, 0, 1}, speed));
  const auto smooth = scene.Add(BallOf(1, 0.01), Straight({-8, 4, 1}, {speed, 0, 0}));
  scene.Touch(0, ball, 0, INFINITY);
  scene.Touch(0, smooth, 0, INFINITY);
  const auto cubes = AddBystanders(&scene);
  RunSteadily(&scene, cubes, setting.Many(640, 1000), outcome);
}

constexpr double kError = 1e-9;  ///< Of place [m] and velocity [m/s].

// A ball that bounces off a slab and loses half of its speed each time: infinitely many contacts in
// a finite time (Zeno). Its bound allows for the impacts.
struct Bouncing {
  double speed = 4, gravity = 8, restitution = 0.5;

  motion::MotionState At(Seconds t) const {
    Seconds u = speed, from = 0;
    while (u > 1e-9L && t > from + 2 * u / gravity) {
      from += 2 * u / gravity;
      u *= restitution;
    }
    motion::MotionState state;
    const Seconds s = t - from;
    if (u <= 1e-9L) u = 0;
    const Seconds z = u > 0 ? u * s - gravity * s * s / 2 : 0;
    state.p_WA = {0, 0, static_cast<double>(std::max<Seconds>(0, z)) + 0.5};
    state.v_WA = {0, 0, u > 0 ? static_cast<double>(u - gravity * s) : 0};
    state.position_error = state.velocity_error = kError;
    return state;
  }
};

/// `exact`: where the states are, the bounds are those of the fall, so that an impact at a state is
/// known within the errors over the speed, and as freedom and contact of shapes are looked for: to
/// 1e-6 and 1e-5 of a segment (shape_contact.cc). Else no closer than the states are.
void TouchAtBounces(const Bouncing& bouncing, std::uint32_t ball, bool exact, Scene* scene) {
  Seconds at = 0;
  for (Seconds u = bouncing.speed; u > 0.01; u *= bouncing.restitution) {
    const bool at_state = std::fmod(at, Seconds(kStepSeconds)) == 0;
    const Seconds known = 2 * kError * (1 + kStepSeconds) / u + 1.1e-5 * kStepSeconds;
    scene->Touch(0, ball, at, at, (exact && at_state ? known : kStepSeconds) + kInstants);
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
  TouchAtBounces(bouncing, ball, false, &scene);
  const auto cubes = AddBystanders(&scene);
  RunSteadily(&scene, cubes, setting.Many(640, 6400), outcome);
}

// The same with each impact declared as a discontinuity, under a bound of gravity alone.
void ChatteringJumps(const Setting& setting, Outcome* outcome) {
  Scene scene(Limited(), Instant(), outcome);
  const Bouncing bouncing;
  scene.Add(Of(SlabShape(), 0), Straight({0, 0, 0}, {0, 0, 0}));
  double last = 0;
  scene.Add(BallOf(0.5, bouncing.gravity), [bouncing, last](Seconds t) mutable {
    motion::MotionState state = bouncing.At(t);
    const double fell = last - bouncing.gravity * kStepSeconds;
    state.discontinuity = std::abs(state.v_WA.z() - fell) > 1e-6 && t > 0;
    last = state.v_WA.z();
    return state;
  });
  TouchAtBounces(bouncing, 1, true, &scene);
  const auto cubes = AddBystanders(&scene);
  RunSteadily(&scene, cubes, setting.Many(640, 6400), outcome);
}

/// Contacts that have no end and no answer: a stack, a ball of triangles that rolls, and a cube
/// that chatters. All of them want what a turn may spend, over and over.
void AddGreedy(Scene* scene) {
  scene->Add(Of(SlabShape(), 0), Straight({0, 0, 0}, {0, 0, 0}));
  for (std::uint32_t k = 0; k < 6; ++k) {
    const double aside = k % 2 == 0 ? 0 : 0.125;
    scene->Add(Of(CubeShape(), 0.01), Straight({aside, 0, 0.5 + k}, {0, 0, 0}));
    scene->Touch(k, k + 1, 0, INFINITY);
  }
  const auto ball = scene->Add(Of(shape::Shape::Build(Sphere(2)), 0.01), Roll({-8, 8, 1}, 1));
  scene->Touch(0, ball, 0, INFINITY);
  const Bouncing bouncing;
  auto chattering = Of(CubeShape(), 4 * bouncing.speed / kStepSeconds);
  chattering.limits.angular_acceleration_max = 0.01;
  const auto cube = scene->Add(chattering, [bouncing](Seconds t) {
    motion::MotionState state = bouncing.At(t);
    state.p_WA += Vector3d(8, -8, 0);
    return state;
  });
  TouchAtBounces(bouncing, cube, false, scene);
}

/// One turn left out, to the thousandth part of a step to which a small share finds a contact.
constexpr double kTwoSteps = 2.001 * kStepSeconds;

// Cubes that meet at their own time beside all that, with smaller and smaller budgets. A fair share
// of the smallest is 240 units of work, little more than one query of two cubes: then their contact
// is reported while they touch.
void Starving(const Setting& setting, Outcome* outcome) {
  const int steps = setting.Many(256, 1024);
  for (const std::uint64_t units : {16'000, 8'000, 4'000}) {
    detection::DetectorOptions options;
    options.work_units_per_evaluation = units;
    options.work_units_per_step = units;
    Scene scene(options, Instant(), outcome);
    AddGreedy(&scene);
    constexpr double kFirst = 0.5, kNext = 0.1875;
    std::vector<std::uint32_t> cubes;
    for (int k = 0; k < 6; ++k) {
      cubes.push_back(
          AddPair(&scene, Of(CubeShape(), 0.01), {8192, 64.0 * k, 0}, kFirst + k * kNext));
    }
    scene.Run(kStep, steps);
    for (int k = 0; k < 6; ++k) {
      const Service service = units > 4'000 ? Service{4 * kStepSeconds, kTwoSteps} : Service{1, 1};
      ExpectServed(scene, cubes[k], kFirst + k * kNext, service, outcome);
    }
    outcome->Add("evaluations_cut_short",
                 static_cast<double>(scene.detector().counters().evaluations_cut_short));
  }
  outcome->Expect(outcome->Get("evaluations_cut_short") > 256, "the budgets are hardly used up");
  outcome->Say("cubes that meet are told " + Show(outcome->Get("cubes_told_after_s")) +
               " s later at most, and known within " + Show(outcome->Get("cubes_width_s")) +
               " s, while " + Show(outcome->Get("evaluations_cut_short")) +
               " evaluations were cut short");
}

const char* const kSteady =
    "no contact is missed or late; another pair of balls, and one of cubes, is not starved, "
    "its "
    "begins and ends within 3 ns and M T2/2 over the speed, M that of any point; at most 4 events "
    "an "
    "agent and twice the work allowed in a step, the queue does not grow";

}  // namespace

std::vector<Case> RestingCases() {
  const std::string steady = kSteady;
  return {{"extreme", "shape-scenes",
           "cubes of 2^-20 to 2^20 m: contact is never missed or late, and confirmed; begins, "
           "ends and clearances within 3 ns",
           ShapeScenes},
          {"stiff", "resting", steady, Resting},
          {"stiff", "stack", steady, Stack},
          {"stiff", "rolling", steady, Rolling},
          {"stiff", "chattering", steady + "; begins of bounces within a step", Chattering},
          {"stiff", "chattering-jumps",
           steady + "; begins of bounces at a state within its errors over the speed and 1.1e-5 of "
                    "a step, of the others within a step",
           ChatteringJumps},
          {"stiff", "starving",
           "beside a stack, a rolling and a chattering body, with 16000 or 8000 units of work a "
           "step for all: six pairs of cubes that meet are confirmed within four steps, and known "
           "within two; with 4000 within a second",
           Starving}};
}

}  // namespace collision::stress
