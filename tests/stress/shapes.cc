// Bodies with shapes at the extremes: when they touch, where the answer is closed.
#include <cmath>

#include "collision_core/numeric/rotation.h"
#include "tests/stress/shape_judge.h"
#include "tests/support/meshes.h"
#include "tests/support/truth/true_distance.h"

namespace collision::stress {
namespace {

using Eigen::Vector3d;

constexpr double kLight = 299792458;

std::shared_ptr<const shape::Shape> CubeOf(double half, bool solid) {
  return BoxShape(Vector3d::Constant(half), solid);
}

/// Two cubes head on along x: 8 halves apart, at 16 halves a second.
void JudgeHeadOn(double half, const Vector3d& at, bool solid, Outcome* outcome) {
  const auto cube = CubeOf(half, solid);
  const Body a{cube, 0, at}, b{cube, 0, at + Vector3d(10 * half, 0, 0), {-16 * half, 0, 0}};
  JudgeTimes({a, b, 1, 0.5L, 0.75L, 16 * half}, Show(half) + " m at " + Show(at.norm()) + " m",
             outcome);
}

// From the smallest mesh that the edge lets pass to the largest, alone and the two together.
void Sizes(const Setting&, Outcome* outcome) {
  for (const bool solid : {false, true}) {
    for (int exponent = -20; exponent <= 21; ++exponent) {
      JudgeHeadOn(std::ldexp(1, exponent), {0, 0, 0}, solid, outcome);
    }
    for (int exponent = -20; exponent <= 20; exponent += 4) {
      const double small = std::ldexp(1, exponent), large = 0x1p21;
      const Body a{CubeOf(large, solid)};
      const Body b{CubeOf(small, solid), 0, {large + small + 4, 0, 0}, {-8, 0, 0}};
      JudgeTimes(
          {a, b, 0x1p20, 0.5L, 0.5L + (2 * (large + static_cast<long double>(small))) / 8, 8},
          "mixed with " + Show(small) + " m", outcome);
    }
  }
  SayTimes(outcome);
}

void Offsets(const Setting&, Outcome* outcome) {
  for (const bool solid : {false, true}) {
    for (int exponent = 0; exponent <= 49; ++exponent) {
      const double off = std::ldexp(1, exponent);
      JudgeHeadOn(1, {off, -off, off}, solid, outcome);
    }
  }
  SayTimes(outcome);
}

// Orientations that are a hair, and more, off unit length name the same rotation.
void Quaternions(const Setting&, Outcome* outcome) {
  for (const bool solid : {false, true}) {
    const auto cube = CubeOf(1, solid);
    for (const double off : {-1e-3, -1e-9, -0x1p-52, 0.0, 0x1p-52, 1e-9, 1e-3}) {
      // A quarter of a turn about z, and none: both leave the cube as it is.
      Body a{cube}, b{cube, 0, {10, 0, 0}, {-16, 0, 0}};
      a.q = Eigen::Quaterniond(1 + off, 0, 0, 1 + off);
      b.q = Eigen::Quaterniond(1 - off, 0, 0, 0);
      JudgeTimes({a, b, 1, 0.5L, 0.75L, 16}, "off by " + Show(off), outcome);
    }
  }
  SayTimes(outcome);
}

void Speeds(const Setting&, Outcome* outcome) {
  for (const bool solid : {false, true}) {
    for (int exponent = -40; exponent <= 29; ++exponent) {
      const double speed = std::min(std::ldexp(1, exponent), kLight);
      const Body a{CubeOf(1, solid)}, b{CubeOf(1, solid), 0, {10, 0, 0}, {-speed, 0, 0}};
      const long double v = speed;
      JudgeTimes({a, b, 16 / speed, 8 / v, 12 / v, speed}, Show(speed) + " m/s", outcome);
    }
  }
  SayTimes(outcome);
}

// A needle of 1 : 2^20 through a plate of 1 : 2^21; crosswise; plates face to face.
void NeedlesAndPlates(const Setting&, Outcome* outcome) {
  constexpr double kLong = 0x1p10, kThin = 0x1p-10, kFlat = 0x1p-12;
  for (const bool solid : {false, true}) {
    const auto needle_x = BoxShape({kLong, kThin, kThin}, solid);
    const auto needle_y = BoxShape({kThin, kLong, kThin}, solid);
    const auto plate = BoxShape({kFlat, kLong, kLong}, solid);
    const Body through{needle_x, 0, {kLong + kFlat + 4, 3, 5}, {-8, 0, 0}};
    JudgeTimes({{plate}, through, 300, 0.5L, 0.5L + (2 * (kLong + kFlat)) / 8, 8},
               "needle through plate", outcome);
    const Body across{needle_y, 0, {7, 9, 4 + 2 * kThin}, {0, 0, -8}};
    JudgeTimes({{needle_x}, across, 2, 0.5L, 0.5L + 4 * kThin / 8, 8}, "needles crosswise",
               outcome);
    const Body facing{plate, 0, {4 + 2 * kFlat, 11, -13}, {-8, 0, 0}};
    JudgeTimes({{plate}, facing, 2, 0.5L, 0.5L + 4 * kFlat / 8, 8}, "plates", outcome);
  }
  SayTimes(outcome);
}

// Surfaces of one triangle: through each other, and a ball, and a point, through one.
void OneTriangle(const Setting&, Outcome* outcome) {
  for (const double size : {0x1p-19, 1.0, 0x1p19}) {
    geometry::TriangleMesh flat, upright;
    flat.vertices = {{-size, -size, 0}, {size, -size, 0}, {0, size, 0}};
    upright.vertices = {{0, -size / 4, size}, {0, size / 4, size}, {0, 0, -size}};
    flat.triangles = upright.triangles = {{0, 1, 2}};
    const Body a{shape::Shape::Build(flat)};
    const Vector3d above(0, 0, 3 * size), down(0, 0, -4 * size);
    const std::string of = " of " + Show(size) + " m";
    JudgeTimes({a, {shape::Shape::Build(upright), 0, above, down}, 2, 0.5L, 1, 4 * size},
               "triangles" + of, outcome);
    JudgeTimes({a, {nullptr, size / 2, above, down}, 2, 0.625L, 0.875L, 4 * size},
               "triangle and ball" + of, outcome);
    const narrow_phase::TimeOfContactResult point =
        FindContact(a, {nullptr, 0, above, down}, 2, kPlenty);
    JudgeForm(point, 2, kPlenty, "triangle and point", outcome);
    outcome->Expect(point.status != narrow_phase::ContactStatus::kFree,
                    "a point that passes through a triangle is missed");
    JudgeStay(point, {0.75, 0.75, 0x1p-52 * 4 * size / (4 * size)}, "triangle and point" + of,
              outcome);
  }
  SayTimes(outcome);
}

// A sheet of a million triangles: a ball falls through it, and a cube.
void MillionTriangles(const Setting& setting, Outcome* outcome) {
  const auto cells = static_cast<std::uint32_t>(setting.Many(64, 708));
  sphere_tree::ShapeOptions options;
  options.builder = sphere_tree::TreeBuilder::kMedianSplit;
  const Body sheet{shape::Shape::Build(Sheet(64, cells), options)};
  const auto triangles = static_cast<double>(sheet.shape->mesh().triangles.size());
  outcome->Set("triangles", triangles);
  const Vector3d above(5.25, -7.125, 3), down(0, 0, -4);
  JudgeTimes({sheet, {nullptr, 0.5, above, down}, 2, 0.625L, 0.875L, 4}, "a ball", outcome);
  JudgeTimes({sheet, {CubeOf(0.5, false), 0, above, down}, 2, 0.625L, 0.875L, 4}, "a cube",
             outcome);
  JudgeTimes({sheet, {CubeOf(0.5, true), 0, above, down}, 2, 0.625L, 0.875L, 4}, "a solid",
             outcome);
  const narrow_phase::TimeOfContactResult beside =
      FindContact(sheet, {nullptr, 0.5, {66, 0, 3}, down}, 2, kPlenty);
  JudgeForm(beside, 2, kPlenty, "beside it", outcome);
  outcome->Expect(beside.status == narrow_phase::ContactStatus::kFree,
                  "what falls beside it is not free");
  SayTimes(outcome);
}

// Cubes that slide past each other: a unit in the last place apart, touching, and as deep.
void Grazing(const Setting&, Outcome* outcome) {
  for (const bool solid : {false, true}) {
    for (const double size : {0x1p-19, 0.5, 0x1p20}) {
      for (const double aside : {2 - 0x1p-52, 2.0, 2 + 0x1p-51}) {
        const auto cube = CubeOf(size, solid);
        const Body b{cube, 0, {-10 * size, aside * size, 0}, {16 * size, 0, 0}};
        const narrow_phase::TimeOfContactResult found = FindContact({cube}, b, 2, kPlenty);
        const std::string what = "aside by " + Show((aside - 2) / 0x1p-52) + " units";
        JudgeForm(found, 2, kPlenty, what, outcome);
        if (aside <= 2) {
          outcome->Expect(found.status != narrow_phase::ContactStatus::kFree, what + ": missed");
        } else {
          outcome->Expect(found.status != narrow_phase::ContactStatus::kContact,
                          what + ": a contact that is none");
        }
        if (found.status != narrow_phase::ContactStatus::kFree) {
          JudgeStay(found, {0.5, 0.75, 0x1p-52 * 12 * size / (16 * size)}, what, outcome);
        }
        if (found.status != narrow_phase::ContactStatus::kUndecided) continue;
        outcome->Greatest("width_units", found.within / (0x1p-52 * 12 * size));
        outcome->Expect(found.within <= kShapeUnits * 0x1p-52 * 12 * size,
                        what + ": undecided within " + Show(found.within) + " m");
      }
    }
  }
  SayTimes(outcome);
}

/// A bar about the origin, of these halves, that turns about z with kSpin.
constexpr double kSpin = 1e6;
const Vector3d kBar(2, 0.125, 0.125);

TrueMotion MotionOf(const Body& body) {
  return {{body.p.cast<Real>(), body.v.cast<Real>(), body.w.cast<Real>(), body.q.cast<Real>()}, {}};
}

/// Whether the bar touches a ball at t. Angles are exact to 2^-45 rad in long double.
bool TouchesBar(const Body& bar, const Body& ball, Real t) {
  const TrueBody at_bar(bar.shape.get(), 0, MotionOf(bar).At(t));
  const TrueBody at_ball(nullptr, ball.radius, MotionOf(ball).At(t));
  return SolidDistance(at_bar, at_ball) == 0;
}

/// When they first touch within half a turn after `from`, or last before it (a `step` below 0).
Real TouchOfBar(const Body& bar, const Body& ball, Real from, Real step) {
  Real apart = from, touching = from;
  while (!TouchesBar(bar, ball, touching)) {
    apart = touching;
    touching += step;
  }
  for (int i = 0; i < 80 && apart != touching; ++i) {
    const Real middle = (apart + touching) / 2;
    (TouchesBar(bar, ball, middle) ? touching : apart) = middle;
  }
  return touching;
}

// Where the turn is beyond measure the bar may be turned any way: what flies past is not free while
// it is within the bar's reach, and no longer.
void JudgeUnknownTurn(Body bar, Outcome* outcome) {
  constexpr double kDuration = 1, kNearest = 0.5, kAside = 1.5, kSpeed = 8;
  bar.w = {0, 0, 4 * numeric::kRotationAngleMax};
  const Body ball{nullptr, 0.25, {-kSpeed * kNearest, kAside, 0}, {kSpeed, 0, 0}};
  const double reach = kBar.norm() + ball.radius;
  const long double half = std::sqrt(reach * reach - kAside * static_cast<long double>(kAside)) / 8;
  const narrow_phase::TimeOfContactResult found = FindContact(bar, ball, kDuration, kPlenty);
  JudgeForm(found, kDuration, kPlenty, "turned beyond measure", outcome);
  outcome->Expect(found.status == narrow_phase::ContactStatus::kUndecided,
                  "turned beyond measure, and decided");
  JudgeStay(found, {kNearest - half, kNearest + half, 0x1p-52 * 6.25 / kSpeed},
            "turned beyond measure", outcome);
}

// What stays beyond the reach of the bar is free; what comes down on it touches it within half a
// turn; beyond a million radians its orientation is not known.
void Spinning(const Setting&, Outcome* outcome) {
  for (const bool solid : {false, true}) {
    Body bar{BoxShape(kBar, solid)};
    bar.w = {0, 0, kSpin};
    const Body beyond{nullptr, 0.25, {-4, 2.3, 0}, {8, 0, 0}};
    const narrow_phase::TimeOfContactResult free = FindContact(bar, beyond, 0.9, kPlenty);
    JudgeForm(free, 0.9, kPlenty, "beyond its reach", outcome);
    outcome->Expect(free.status == narrow_phase::ContactStatus::kFree,
                    "what is beyond its reach is not free");
    // The ball is as low as the bar's face at 0.3125 s, and has passed the other one at 0.6875 s;
    // the bar is below it once in half a turn.
    const Body falling{nullptr, 0.25, {0.75, 0.5, 1}, {0, 0, -2}};
    Body surface = bar;
    surface.shape = BoxShape(kBar, false);
    const Real begin = TouchOfBar(surface, falling, 0.3125L, 1e-9L);
    const Real end = TouchOfBar(surface, falling, 0.6875L, -1e-9L);
    outcome->Set("half_turns_waited", static_cast<double>(begin - 0.3125L) * kSpin / 3.14159265);
    JudgeTimes({bar, falling, 0.9, begin, end, 2}, "what falls on it", outcome);
    JudgeUnknownTurn(bar, outcome);
  }
  SayTimes(outcome);
}

const char* const kTimes =
    "the brackets contain the closed answer, finite and ordered; at most 1e-12 of the time wide, "
    "and 128 units in the last place of place and size over the speed; work within what is allowed";

}  // namespace

std::vector<Case> ShapeCases() {
  return {{"extreme", "shape-sizes", kTimes, Sizes},
          {"extreme", "shape-offsets", kTimes, Offsets},
          {"extreme", "shape-speeds", kTimes, Speeds},
          {"extreme", "shape-quaternions", kTimes, Quaternions},
          {"extreme", "needles-plates", kTimes, NeedlesAndPlates},
          {"extreme", "one-triangle", kTimes, OneTriangle},
          {"extreme", "million-triangles", kTimes, MillionTriangles},
          {"extreme", "shape-grazing",
           "a pair that overlaps by a unit in the last place is not free, one apart is no contact; "
           "undecided within 128 units at most, and not free for 1e-12 of the time and 128 units "
           "over the speed longer than they graze",
           Grazing},
          {"extreme", "spinning",
           "at 1e6 rad/s: free beyond the reach; within it the brackets contain the closed answer, "
           "at most 1e-12 of the time and 128 units in the last place of place and size over the "
           "falling speed wide; where the turn is beyond measure not free while within the reach, "
           "and by as little longer; work within what is allowed",
           Spinning}};
}

}  // namespace collision::stress
