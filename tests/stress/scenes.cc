// Whole scenes at the extremes: many agents, one detector.
#include <cmath>

#include "tests/stress/scene.h"

namespace collision::stress {
namespace {

using Eigen::Vector3d;

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kYear = 31'557'600 * kSecond;
constexpr std::int64_t kStep = kSecond / 64;  // exact as a double: 2^-6 s
constexpr double kStepSeconds = 0x1p-6;
constexpr double kHalfStep = kStepSeconds / 2;  ///< What begins then lies between two states.
constexpr double kLight = 299792458;

/// Agents of one group meet only those of that group.
detection::AgentDeclaration Declared(double radius, double acceleration_max = 0, int group = 0) {
  detection::AgentDeclaration declaration;
  declaration.limits.radius = radius;
  declaration.limits.acceleration_max = acceleration_max;
  declaration.filter.group = declaration.filter.mask = 1u << group;
  return declaration;
}

/// Two balls of `radius` about `at`, head on along x: they begin to touch after `begin` seconds.
void AddHeadOn(Scene* scene, const Vector3d& at, double radius, double speed, double begin,
               int group = 0) {
  const double half = radius + speed * begin;
  const Vector3d x(1, 0, 0);
  const std::uint32_t a =
      scene->Add(Declared(radius, 0, group), Straight(at - half * x, speed * x));
  const std::uint32_t b =
      scene->Add(Declared(radius, 0, group), Straight(at + half * x, -speed * x));
  const Seconds lasts = 2 * Seconds(radius) / speed;
  scene->Touch(a, b, begin, begin + lasts);
}

// Both accelerate towards each other with all of M: they begin to touch after 20½ steps.
void AccelerationScenes(const Setting&, Outcome* outcome) {
  for (int exponent = -40; exponent <= 40; ++exponent) {
    Scene scene({}, Instant(), outcome);
    scene.ForbidIdle();
    const double M = std::ldexp(1, exponent) / (kStepSeconds * kStepSeconds);
    const double begin = 20.5 * kStepSeconds, gap = M * begin * begin;
    const Vector3d x(1 + gap / 2, 0, 0), towards(-M, 0, 0);
    const auto a = scene.Add(Declared(1, M), Falling(-x, {0, 0, 0}, -towards));
    const auto b = scene.Add(Declared(1, M), Falling(x, {0, 0, 0}, towards));
    scene.Touch(a, b, begin, std::sqrt((4 + Seconds(gap)) / M));
    scene.Run(kStep, 40);
    // Half-way between two states each is known to M T²/8, ahead and behind; they close at 2 M t.
    scene.Judge(kStepSeconds * kStepSeconds / (4 * begin) + 3e-9, exponent <= 0);
    SayScene(scene, outcome);
  }
}

// Ten pairs that meet after 0.75 µs, 7.5 µs, ... 750 s, while steps grow from 1/2 µs on.
void TimeScales(const Setting&, Outcome* outcome) {
  detection::DetectorOptions options;
  options.announce_within = 0.5;
  options.temporal_resolution = 1e-6;
  Scene scene(options, Instant(), outcome);
  scene.ForbidIdle();
  double scale = 1;
  for (int k = 0; k < 10; ++k, scale *= 10) {
    const double begin = 0.75e-6 * scale;
    AddHeadOn(&scene, {0, 0, 0}, begin * 0.5, 1, begin, k);
  }
  for (double ns = 500; ns < 1100e9; ns *= 1.25) {
    scene.StepTo(Instant::FromNanoseconds(static_cast<std::int64_t>(ns)));
  }
  // Positions are sent to a unit in the last place, times to the nanosecond.
  scene.Judge(3e-9, true);
  SayScene(scene, outcome);
}

void SizesAlone(const Setting&, Outcome* outcome) {
  for (int exponent = -40; exponent <= 40; ++exponent) {
    Scene scene({}, Instant(), outcome);
    scene.ForbidIdle();
    const double size = std::ldexp(1, exponent);
    AddHeadOn(&scene, {0, 0, 0}, size, size, 0.75 + kHalfStep);
    scene.Run(kStep, 200);
    scene.Judge(3e-9, true);
    SayScene(scene, outcome);
  }
}

// All sizes at one place, and a giant on which a speck falls.
void SizesMixed(const Setting&, Outcome* outcome) {
  Scene scene({}, Instant(), outcome);
  scene.ForbidIdle();
  for (int k = 0; k < 27; ++k) {
    const double size = std::ldexp(1, 3 * k - 40);
    AddHeadOn(&scene, {0, 0, 0}, size, size, 0.75 + kHalfStep + 0.0625 * k, k);
  }
  const double giant = 0x1p40;
  const auto a = scene.Add(Declared(giant, 0, 30), Straight({0, 0, 0}, {0, 0, 0}));
  const auto b = scene.Add(Declared(0x1p-40, 0, 30), Straight({giant + 16, 0, 0}, {-16, 0, 0}));
  // A unit in the last place of the giant's radius is 2^-12 m: at 16 m/s 2^-16 s.
  scene.Touch(a, b, 1 - Seconds(0x1p-44), 1e12L, 4 * 0x1p-16);
  scene.Run(kStep, 300);
  scene.Judge(3e-9, true);
  SayScene(scene, outcome);
}

void OffsetScene(const Setting&, Outcome* outcome) {
  for (const double far : {0x1p20, 0x1p30, 0x1p40, 0x1p49}) {
    Scene scene({}, Instant(), outcome);
    scene.ForbidIdle();
    const Vector3d at(far, -far / 2, far / 4);
    // States are on the lattice of doubles there; between two of them the sum of place and way is
    // rounded outward by a unit for either ball at either end, and they close at 128 m/s.
    for (int k = 0; k < 6; ++k) {
      AddHeadOn(&scene, at + Vector3d(0, 64.0 * k, 0), 8, 64, 0.5625 + 0.25 * k, k);
    }
    scene.Run(kSecond / 8 * 2, 12);
    scene.Judge(4 * 0x1p-52 * at.norm() / 128 + 3e-9, true);
    SayScene(scene, outcome);
  }
}

// Two of a metre at the speed of light, and one that passes the other by.
void LightSpeed(const Setting&, Outcome* outcome) {
  Scene scene({}, Instant(), outcome);
  scene.ForbidIdle();
  AddHeadOn(&scene, {0, 0, 0}, 1, kLight, 1.5 + kHalfStep);
  scene.Add(Declared(1, 0, 1), Straight({-kLight, 2.5, 0}, {kLight, 0, 0}));
  scene.Add(Declared(1, 0, 1), Straight({0, 0, 0}, {0, 0, 0}));
  scene.Run(kStep, 200);
  // Contact lasts 7 ns; a nanosecond is 0.3 m.
  scene.Judge(3e-9, true);
  SayScene(scene, outcome);
}

// M from 0 to 1e18: a ball that may be anywhere soon is announced, and none is reported clear.
void AccelerationBounds(const Setting&, Outcome* outcome) {
  for (int decade = -1; decade <= 18; ++decade) {
    const double M = decade < 0 ? 0 : std::pow(10.0, decade);
    Scene scene({}, Instant(), outcome);
    scene.ForbidIdle();
    const auto a = scene.Add(Declared(1, M), Straight({-66.5, 0, 0}, {64, 0, 0}));
    const auto b = scene.Add(Declared(1, M), Straight({0, 0, 0}, {0, 0, 0}));
    scene.Touch(a, b, 1 + kHalfStep, 1 + kHalfStep + Seconds(4) / 64);
    scene.Run(kStep, 160);
    // As narrow as M T²/8 each over 64 m/s, both sides; within a step at most, since at each state
    // the place is known.
    const double uncertain = M * kStepSeconds * kStepSeconds / 2 / 64;
    const double width = std::min(uncertain, kStepSeconds);
    // Beyond half a step contact is not certain between two states, and may be over at once.
    const double broken = uncertain > kStepSeconds / 2 ? 0x1p-4 + kStepSeconds : 0;
    scene.Judge(width + 3e-9, true, broken);
    SayScene(scene, outcome);
  }
}

// A century before and after the epoch; by nanoseconds, and by years.
void StampScenes(const Setting&, Outcome* outcome) {
  for (const std::int64_t epoch : {-100 * kYear, 100 * kYear}) {
    const Instant start = Instant::FromNanoseconds(epoch);
    Scene brief({}, start, outcome);
    brief.ForbidIdle();
    AddHeadOn(&brief, {0, 0, 0}, 0x1p-30, 1, 0x1p-22);
    brief.Run(1, 400);
    brief.Judge(3e-9, true);
    Scene slow({}, start, outcome);
    slow.ForbidIdle();
    const double speed = 0x1p-20, begin = 0x1p28;
    AddHeadOn(&slow, {0, 0, 0}, 64, speed, begin);
    slow.Run(kYear, 20);
    // 2^28 s lie between two states a year apart: positions of 256 m at 2^-20 m/s.
    slow.Judge(32 * 0x1p-52 * 512 / speed + 3e-9, true);
    SayScene(slow, outcome);
  }
}

const char* const kPromise =
    "no contact is missed, none is clear before it, brackets contain the truth; finite, "
    "ordered; the queue holds no more than 2 an agent and 1 a pair; distances known within what "
    "the "
    "bounds leave open since the last states and 32 units in the last place; an agent "
    "that could touch no other "
    "within 1/60 s (announce_within where none accelerates) is clear for as long, and else until "
    "it could with lengths 4 units off; what is not free is longer than the contact by twice the "
    "width that begins and ends have at most: ";

}  // namespace

std::vector<Case> SceneCases() {
  const std::string promise = kPromise;
  return {
      {"stiff", "acceleration-scene",
       promise + "3 ns and M T2/2 over the closing speed, at M T2 = 2^-40 to 2^40 radii",
       AccelerationScenes},
      {"stiff", "time-scales", promise + "3 ns, from 0.75 us to 750 s in one scene", TimeScales},
      {"extreme", "size-scenes", promise + "3 ns, from 2^-40 to 2^40 m", SizesAlone},
      {"extreme", "mixed-size-scene",
       promise + "3 ns; of a speck of 2^-40 m on a ball of 2^40 m within 4 units in the last "
                 "place of its radius over the speed",
       SizesMixed},
      {"extreme", "offset-scene",
       promise +
           "3 ns and 4 units in the last place of the places over the speed, up to 6e14 m off",
       OffsetScene},
      {"extreme", "light-speed-scene", promise + "3 ns", LightSpeed},
      {"extreme", "acceleration-bounds",
       promise + "3 ns and M T2/2 over the speed, and no more than a step; where that is half a "
                 "step and more ends within the contact and a step",
       AccelerationBounds},
      {"extreme", "stamp-scenes",
       promise + "3 ns by steps of 1 ns, 32 units in the last place of the "
                 "positions over the speed by steps of a year, a century from the epoch",
       StampScenes}};
}

}  // namespace collision::stress
