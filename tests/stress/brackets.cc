// How far apart two bodies are, at the extremes of size and form: brackets against exact
// arithmetic.
#include <cmath>

#include "collision_core/narrow_phase/separation/separation.h"
#include "tests/stress/shape_judge.h"
#include "tests/support/random.h"
#include "tests/support/truth/exact_surfaces.h"

namespace collision::stress {
namespace {

using Eigen::Vector3d;

/// K of a bracket: so many units in the last place of L, which is how far the two are from each
/// other and how large; plus what directions lose (UnitsOf()). With ε = 2^-53 a unit is 2ε L.
///
/// What the core takes off both ends for the pose's rounding (SlackOf): 2 · 16ε (R_a + R_b + |o|₁),
/// at most √3 · 32ε L, which is 28 units. A bracket of two triangles is left as it is where it is
/// narrower than 64ε (S_a + S_b) (triangle_distance.cc), with all coordinates seen from one of the
/// corners: S_a + S_b <= 2 R_a + L < 3 L, so that is 96 units. 20ε and 11.1√3 ε of S_a + S_b on
/// top, that is what both its ends are taken out by, have room in it.
constexpr double kBracketUnits = 28 + 96;

/// Else it is told along a direction n = e × f of two edges. Their components are off by ε each,
/// the products' by two, their difference's by one more: less than 4√2 ε |e| |f| in all, so that n
/// is turned by 6ε / sin(e, f) at most. What lies across it, 2 R_a + 2 R_b <= 2 L long, sticks out
/// by as much: 12ε L / sin, or 6 units.
constexpr double kUnitsTurned = 6;
/// Edges are parallel below this sine: then corners are as near as they are, or a face.
constexpr double kParallel = 0x1p-40;
constexpr std::uint64_t kUnits = 200'000;

std::shared_ptr<const shape::Shape> FormOf(int kind, double size) {
  if (kind == 0) return BoxShape(Vector3d::Constant(size), false);
  if (kind == 1) return BoxShape({size, size * 0x1p-12, size * 0x1p-12}, false);
  if (kind == 2) return BoxShape({size * 0x1p-12, size, size}, false);
  geometry::TriangleMesh triangle;
  triangle.vertices = {{-size, -size, 0}, {size, -size / 2, 0}, {0, size, size / 4}};
  triangle.triangles = {{0, 1, 2}};
  return shape::Shape::Build(triangle);
}

/// Whether a solid holds a point of the other one: then they touch, whatever their surfaces do.
bool Nested(const narrow_phase::BodyTree& a, const narrow_phase::BodyTree& b,
            const narrow_phase::RelativePose& pose) {
  const auto inside = [](const shape::Shape& shape, const Vector3d& x) {
    return shape.closed() && (x.array() >= shape.facts().lower.array()).all() &&
           (x.array() <= shape.facts().upper.array()).all();
  };
  return inside(*a.shape(), pose.ToA(b.shape()->mesh().vertices[0])) ||
         inside(*b.shape(), pose.ToB(a.shape()->mesh().vertices[0]));
}

double SineOf(const Vector3d& e, const Vector3d& f) {
  return e.cross(f).norm() / (e.norm() * f.norm());
}

/// The edges of all triangles, and the least sine of two that make a normal.
double EdgesOf(const shape::Shape& shape, const Eigen::Matrix3d& turn,
               std::vector<Vector3d>* edges) {
  double least = 1;
  for (const geometry::Triangle& t : shape.mesh().triangles) {
    const auto& x = shape.mesh().vertices;
    const std::size_t first = edges->size();
    for (int i = 0; i < 3; ++i) edges->push_back(turn * (x[t[(i + 1) % 3]] - x[t[i]]));
    least = std::min(least, SineOf((*edges)[first], (*edges)[first + 1]));
  }
  return least;
}

/// K of the bracket of two bodies.
double UnitsOf(const shape::Shape& a, const shape::Shape& b,
               const narrow_phase::RelativePose& pose) {
  std::vector<Vector3d> of_a, of_b;
  double least =
      std::min(EdgesOf(a, Eigen::Matrix3d::Identity(), &of_a), EdgesOf(b, pose.R_AB, &of_b));
  for (const Vector3d& e : of_a) {
    for (const Vector3d& f : of_b) {
      const double sine = SineOf(e, f);
      if (sine > kParallel) least = std::min(least, sine);
    }
  }
  return kBracketUnits + kUnitsTurned / least;
}

narrow_phase::BodySegment At(std::shared_ptr<const shape::Shape> shape) {
  narrow_phase::BodySegment body;
  body.ball.radius = shape->facts().radius;
  body.shape = std::move(shape);
  return body;
}

void JudgeBracket(const narrow_phase::BodySegment& first, const narrow_phase::BodySegment& second,
                  const narrow_phase::RelativePose& pose, Outcome* outcome) {
  const narrow_phase::BodyTree a(first), b(second);
  WorkBudget work(kUnits), again(kUnits);
  const narrow_phase::SeparationBracket look =
      narrow_phase::BracketSeparation({a, b, pose}, {0, 0}, &work);
  const narrow_phase::Decision decision = narrow_phase::DecideAt({a, b, pose}, &again);
  const Exact square = SquareOfSurfaces(first.shape->mesh(), second.shape->mesh(),
                                        PlacementOf(pose.R_AB, pose.p_AB));
  outcome->Add("poses", 1);
  outcome->Expect(!std::isnan(look.lower) && !std::isnan(look.upper), "not a number");
  outcome->Expect(work.spent() <= kUnits + kBatchUnits && again.spent() <= kUnits + kBatchUnits,
                  "more work than allowed");
  outcome->Greatest("work_max", static_cast<double>(work.spent()));
  outcome->Expect(IsAtMost(look.lower, square, 0), "the distance's lower end is above the truth");
  const bool nested = Nested(a, b, pose);
  if (square == 0 || nested) {
    outcome->Add("touching", 1);
    outcome->Expect(decision.verdict != narrow_phase::Verdict::kApart,
                    "contact is reported as apart");
    return;
  }
  outcome->Expect(decision.verdict != narrow_phase::Verdict::kTouching,
                  "apart is reported as contact");
  outcome->Expect(IsAtLeast(look.upper, square, 0), "the distance's upper end is below the truth");
  const double unit = 0x1p-52 * (pose.p_AB.norm() + a.reach() + b.reach());
  const double width = (look.upper - std::max(0.0, look.lower)) / unit;
  const double allowed = UnitsOf(*first.shape, *second.shape, pose);
  outcome->Greatest("width_units", width);
  outcome->Greatest("width_share", width / allowed);
  outcome->Expect(width <= allowed,
                  "a bracket of " + Show(width) + " units, of " + Show(allowed) + " allowed");
}

void Brackets(const Setting& setting, Outcome* outcome) {
  Random random(501);
  for (int i = 0; i < setting.Many(400, 4000); ++i) {
    const double size = std::ldexp(1, static_cast<int>(random.Below(38)) - 18);
    const double other =
        random.Chance(0.5) ? size : std::ldexp(1, static_cast<int>(random.Below(38)) - 18);
    const narrow_phase::BodySegment a = At(FormOf(static_cast<int>(random.Below(4)), size));
    const narrow_phase::BodySegment b = At(FormOf(static_cast<int>(random.Below(4)), other));
    Eigen::Quaterniond turn(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1),
                            random.Uniform(-1, 1));
    if (random.Chance(0.3)) turn = Eigen::Quaterniond::Identity();
    const double reach = a.ball.radius + b.ball.radius;
    const Vector3d offset = reach * random.LogUniform(1e-3, 3) * random.UnitVector();
    JudgeBracket(a, b, narrow_phase::PoseOf(turn.normalized().toRotationMatrix(), offset), outcome);
  }
  outcome->Say(Show(outcome->Get("poses")) + " poses (" + Show(outcome->Get("touching")) +
               " in contact), the widest bracket " + Show(outcome->Get("width_units")) +
               " units, " + Show(outcome->Get("width_share")) + " of what is allowed at most; " +
               Show(outcome->Get("work_max")) + " units of work at most");
}

// Boxes of which a face is a unit in the last place before, at, and behind the other's.
void BracketGrazing(const Setting& setting, Outcome* outcome) {
  Random random(502);
  for (int i = 0; i < setting.Many(80, 800); ++i) {
    const double size = std::ldexp(1, static_cast<int>(random.Below(38)) - 18);
    const narrow_phase::BodySegment a = At(FormOf(static_cast<int>(random.Below(3)), size));
    const narrow_phase::BodySegment b = At(FormOf(static_cast<int>(random.Below(3)), size));
    const double touching = a.shape->facts().upper.x() + b.shape->facts().upper.x();
    const double y = random.Uniform(-0.5, 0.5) * size * 0x1p-12;
    for (const double x :
         {std::nextafter(touching, 0), touching, std::nextafter(touching, 1e300)}) {
      JudgeBracket(a, b, narrow_phase::PoseOf(Eigen::Matrix3d::Identity(), {x, y, 0}), outcome);
    }
  }
  outcome->Say(Show(outcome->Get("poses")) + " poses (" + Show(outcome->Get("touching")) +
               " in contact), the widest bracket " + Show(outcome->Get("width_units")) +
               " units, " + Show(outcome->Get("width_share")) + " of what is allowed at most");
}

const char* const kPromise =
    "brackets of the distance contain the exact one, decisions are never wrong; at most 124 + 6/s "
    "units in the last place of place and size wide, s the least sine of edges that make a "
    "direction "
    "(derived, brackets.cc); work within what is allowed";

}  // namespace

std::vector<Case> BracketCases() {
  return {{"extreme", "brackets", kPromise, Brackets},
          {"extreme", "bracket-grazing", kPromise, BracketGrazing}};
}

}  // namespace collision::stress
