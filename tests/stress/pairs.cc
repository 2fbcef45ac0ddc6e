// Two balls at every extreme: the earliest possible intersection and the contact, against exact
// arithmetic.
#include <cmath>

#include "collision_core/numeric/rounding.h"
#include "tests/stress/pair_judge.h"
#include "tests/support/random.h"

namespace collision::stress {
namespace {

using Eigen::Vector3d;

constexpr double kLight = 299792458;
constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kYear = 31'557'600 * kSecond;
constexpr std::int64_t kCentury = 100 * kYear;

struct Draw {
  double size = 1, speed = 1, acceleration_max = 0;
  Vector3d offset{0, 0, 0};
  Instant stamp = Instant();
};

/// A passage: B comes from some way off, past A at some share of the radii or through it.
struct Passage {
  motion::SpaceTimeBound a, b;
  double duration = 0;  ///< Longer than the way takes.
};

Passage PassageOf(const Draw& draw, Random& random) {
  const Vector3d along = random.UnitVector();
  Vector3d across = along.cross(random.UnitVector());
  if (across.norm() > 0) across /= across.norm();
  const double away = draw.size * random.LogUniform(2, 100);
  const double aside = draw.size * (random.Chance(0.3) ? 0 : random.Uniform(0, 3));
  Passage passage;
  passage.a =
      Ball(draw.offset, Vector3d::Zero(), draw.size * random.Uniform(0, 1), draw.acceleration_max);
  passage.b = Ball(draw.offset + aside * across - away * along, draw.speed * along,
                   draw.size * random.Uniform(0.5, 1), draw.acceleration_max);
  passage.a.state.stamp = passage.b.state.stamp = draw.stamp;
  passage.duration = 2 * away / draw.speed;
  return passage;
}

void JudgeBoth(const Passage& passage, Outcome* outcome, double units_max = kPairUnits) {
  JudgePair(passage.a, passage.b, passage.a.state.stamp, outcome, units_max);
  if (std::isfinite(passage.duration)) {
    JudgeContact(passage.a, passage.b, passage.duration, outcome);
  }
}

/// `per_decade` passages for each power of ten of what `set` sets.
template <typename Set>
void ForDecades(int lowest, int highest, int per_decade, std::uint64_t seed, Outcome* outcome,
                Set set) {
  Random random(seed);
  for (int decade = lowest; decade <= highest; ++decade) {
    for (int i = 0; i < per_decade; ++i) {
      Draw draw;
      set(std::pow(10.0, decade), random, &draw);
      JudgeBoth(PassageOf(draw, random), outcome);
    }
  }
  SayJudged(outcome);
}

// M Δt² is so many radii, for steps Δt from a microsecond to an hour.
void AccelerationStep(const Setting& setting, Outcome* outcome) {
  ForDecades(-12, 12, setting.Many(80, 4000), 201, outcome,
             [](double ratio, Random& random, Draw* draw) {
               const double step = random.LogUniform(1e-6, 3600);
               draw->size = random.LogUniform(1e-3, 1e3);
               draw->speed = draw->size / step * random.LogUniform(1e-2, 1e2);
               draw->acceleration_max = ratio * draw->size / (step * step);
             });
}

void Sizes(const Setting& setting, Outcome* outcome) {
  ForDecades(-12, 12, setting.Many(80, 4000), 202, outcome,
             [](double size, Random& random, Draw* draw) {
               draw->size = size;
               draw->speed = random.LogUniform(1e-6, 1e6);
               draw->acceleration_max = random.Chance(0.5) ? 0 : random.LogUniform(1e-6, 1e6);
             });
}

void MixedSizes(const Setting& setting, Outcome* outcome) {
  Random random(203);
  for (int i = 0; i < setting.Many(2000, 100000); ++i) {
    const auto any = [&random] { return random.LogUniform(1e-12, 1e12); };
    Passage passage = PassageOf({any(), any(), random.Chance(0.5) ? 0 : any()}, random);
    passage.a.limits.radius = random.Chance(0.5) ? any() : passage.b.limits.radius;
    passage.b.limits.radius = any();
    JudgeBoth(passage, outcome);
  }
  SayJudged(outcome);
}

void Offsets(const Setting& setting, Outcome* outcome) {
  ForDecades(0, 15, setting.Many(120, 6000), 204, outcome,
             [](double offset, Random& random, Draw* draw) {
               draw->offset = offset * random.UnitVector();
               draw->size = random.LogUniform(1e-3, 1e3);
               draw->speed = random.LogUniform(0.1, 1e4);
               draw->acceleration_max = random.Chance(0.5) ? 0 : random.LogUniform(0.01, 100);
             });
}

void Speeds(const Setting& setting, Outcome* outcome) {
  ForDecades(-12, 9, setting.Many(80, 4000), 205, outcome,
             [](double speed, Random& random, Draw* draw) {
               draw->size = random.LogUniform(1e-3, 1e6);
               draw->speed = std::min(speed, kLight);
               draw->acceleration_max = random.Chance(0.5) ? 0 : random.LogUniform(1e-3, 1e3);
             });
}

void Accelerations(const Setting& setting, Outcome* outcome) {
  ForDecades(-18, 18, setting.Many(56, 3000), 206, outcome,
             [](double M, Random& random, Draw* draw) {
               draw->size = random.LogUniform(1e-3, 1e3);
               draw->speed = random.LogUniform(1e-3, 1e3);
               draw->acceleration_max = random.Chance(0.1) ? 0 : M;
             });
}

// A century before and after the epoch; queries 1 ns to years after the states.
void Stamps(const Setting& setting, Outcome* outcome) {
  Random random(207);
  for (int i = 0; i < setting.Many(1600, 80000); ++i) {
    const auto step = [&random](double most) {
      return static_cast<std::int64_t>(random.LogUniform(1, most));
    };
    Draw draw{random.LogUniform(1e-3, 1e3), random.LogUniform(1e-3, 1e3),
              random.Chance(0.5) ? 0 : random.LogUniform(1e-9, 10)};
    const std::int64_t epoch = random.Chance(0.5) ? kCentury : -kCentury;
    draw.stamp = Instant::FromNanoseconds(epoch + step(1e9));
    Passage passage = PassageOf(draw, random);
    JudgeContact(passage.a, passage.b, passage.duration, outcome);
    const double steps[] = {1, 1e3, 1e9, static_cast<double>(10 * kYear)};
    const auto later = [&](Instant stamp) {
      return Instant::FromNanoseconds(stamp.nanoseconds() + step(steps[random.Below(4)]));
    };
    passage.b.state.stamp = later(passage.b.state.stamp);
    JudgePair(passage.a, passage.b, later(passage.b.state.stamp), outcome);
  }
  SayJudged(outcome);
}

// A point that hits a point, misses it by a unit in the last place, or any ball.
void ZeroRadius(const Setting& setting, Outcome* outcome) {
  Random random(208);
  for (int i = 0; i < setting.Many(2000, 100000); ++i) {
    const double speed = std::ldexp(1, static_cast<int>(random.Below(60)) - 30);
    const double away = std::ldexp(1, static_cast<int>(random.Below(40)) - 20);
    const double aside = random.Chance(0.4) ? 0 : away * random.LogUniform(0x1p-60, 1);
    Passage passage{Ball({0, 0, 0}, {0, 0, 0}, random.Chance(0.5) ? 0 : aside),
                    Ball({-away, aside, 0}, {speed, 0, 0}, 0), 2 * away / speed};
    if (random.Chance(0.3)) passage.b.limits.acceleration_max = speed * speed / away;
    JudgeBoth(passage, outcome);
  }
  SayJudged(outcome);
}

// Lengths, speeds and accelerations among the denormals, alone and beside others.
void Denormals(const Setting& setting, Outcome* outcome) {
  Random random(209);
  const auto small = [&random] { return random.LogUniform(0x1p-1074, 0x1p-1000); };
  for (int i = 0; i < setting.Many(2000, 100000); ++i) {
    const double unit = random.Chance(0.5) ? 1 : small();
    const Vector3d along = random.UnitVector();
    Passage passage{Ball({0, 0, 0}, small() * random.UnitVector(), small()),
                    Ball(-unit * along, unit * along, small()), 2};
    if (random.Chance(0.3)) passage.a.limits.acceleration_max = small();
    if (random.Chance(0.3)) passage.a.limits.radius = unit;
    JudgeBoth(passage, outcome, kDenormalUnits);
  }
  SayJudged(outcome);
}

// A passage at a right angle at the distance of the radii: exactly, and by single units in the last
// place more or less.
void Grazing(const Setting& setting, Outcome* outcome) {
  Random random(210);
  for (int i = 0; i < setting.Many(800, 40000); ++i) {
    const double miss = random.LogUniform(1e-12, 1e12), speed = random.LogUniform(1e-6, kLight);
    const double away = miss * random.LogUniform(1e-3, 1e3);
    for (const double radius : {numeric::NextDown(miss), miss, numeric::NextUp(miss)}) {
      const Passage passage{Ball({0, 0, 0}, {0, 0, 0}, radius),
                            Ball({-away, miss, 0}, {speed, 0, 0}, 0), 2 * away / speed};
      JudgeBoth(passage, outcome);
    }
  }
  SayJudged(outcome);
}

// The same place, the same speed, the same state.
void OnePlace(const Setting& setting, Outcome* outcome) {
  Random random(211);
  const auto any = [&random] { return random.Chance(0.3) ? 0 : random.LogUniform(1e-12, 1e12); };
  for (int i = 0; i < setting.Many(2000, 100000); ++i) {
    Passage passage{Ball(any() * random.UnitVector(), any() * random.UnitVector(), any(), any()),
                    {},
                    random.LogUniform(1e-9, 1e9)};
    passage.b = passage.a;
    if (random.Chance(0.5)) passage.b.state.v_WA = any() * random.UnitVector();
    if (random.Chance(0.5)) passage.b.limits.radius = any();
    if (random.Chance(0.5)) passage.b.limits.acceleration_max = 0;
    JudgeBoth(passage, outcome);
  }
  SayJudged(outcome);
}

const char* const kPromise =
    "never late against exact arithmetic; finite, ordered; as narrow as inputs 4 (meeting) and 21 "
    "(contact, where it begins and ends) units in the last place off would force, beyond 1e-9 of "
    "the time (meeting) and 1e-13 of the segment (contact)";

}  // namespace

std::vector<Case> PairCases() {
  return {
      {"stiff", "acceleration-step", kPromise, AccelerationStep},
      {"extreme", "sizes", kPromise, Sizes},
      {"extreme", "mixed-sizes", kPromise, MixedSizes},
      {"extreme", "offsets", kPromise, Offsets},
      {"extreme", "speeds", kPromise, Speeds},
      {"extreme", "accelerations", kPromise, Accelerations},
      {"extreme", "stamps", kPromise, Stamps},
      {"extreme", "zero-radius", kPromise, ZeroRadius},
      {"extreme", "denormals",
       "never late against exact arithmetic; finite, ordered; as narrow as inputs 18 (meeting) and "
       "21 (contact) of the smallest numbers off would force",
       Denormals},
      {"extreme", "grazing", kPromise, Grazing},
      {"extreme", "one-place", kPromise, OnePlace}};
}

}  // namespace collision::stress
