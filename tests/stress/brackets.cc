// How far apart two bodies are, at the extremes of size and form: brackets against exact arithmetic.
#include <cmath>

#include "collision_core/narrow_phase/separation.h"
#include "tests/stress/shape_judge.h"
#include "tests/support/exact_convex.h"
#include "tests/support/exact_triangle.h"
#include "tests/support/random.h"

namespace collision::stress {
namespace {

using Eigen::Vector3d;

/// K: a bracket is at most so many units in the last place of place and size wide.
constexpr double kBracketUnits = 1024;
constexpr std::uint64_t kUnits = 200'000;

std::shared_ptr<const Shape> FormOf(int kind, double size) {
  if (kind == 0) return BoxShape(Vector3d::Constant(size), false);
  if (kind == 1) return BoxShape({size, size * 0x1p-12, size * 0x1p-12}, false);
  if (kind == 2) return BoxShape({size * 0x1p-12, size, size}, false);
  TriangleMesh triangle;
  triangle.vertices = {{-size, -size, 0}, {size, -size / 2, 0}, {0, size, size / 4}};
  triangle.triangles = {{0, 1, 2}};
  return Shape::Build(triangle);
}

std::vector<ExactTriangle> TrianglesOf(const Shape& shape, const ExactPlacement& placement) {
  std::vector<ExactTriangle> triangles;
  for (const Triangle& t : shape.mesh().triangles) {
    ExactTriangle corners;
    for (int i = 0; i < 3; ++i) {
      corners[i] = placement(ExactVector(shape.mesh().vertices[t[i]]));
    }
    triangles.push_back(corners);
  }
  return triangles;
}

Exact SquareOfSurfaces(const Shape& a, const Shape& b, const RelativePose& pose) {
  const auto of_a = TrianglesOf(a, {}),
             of_b = TrianglesOf(b, PlacementOf(pose.matrix, pose.offset));
  Exact least = -1;
  for (const ExactTriangle& s : of_a) {
    for (const ExactTriangle& t : of_b) {
      const Exact square = SquareOfTriangles(s, t);
      if (least < 0 || square < least) least = square;
      if (least == 0) return least;
    }
  }
  return least;
}

/// Whether a solid holds a point of the other one: then they touch, whatever their surfaces do.
bool Nested(const Surface& a, const Surface& b, const RelativePose& pose) {
  const auto inside = [](const Shape& shape, const Vector3d& x) {
    return shape.closed() && (x.array() >= shape.facts().lower.array()).all() &&
           (x.array() <= shape.facts().upper.array()).all();
  };
  return inside(*a.shape(), pose.ToA(b.shape()->mesh().vertices[0])) ||
         inside(*b.shape(), pose.ToB(a.shape()->mesh().vertices[0]));
}

BodySegment At(std::shared_ptr<const Shape> shape) {
  BodySegment body;
  body.ball.radius = shape->facts().radius;
  body.shape = std::move(shape);
  return body;
}

void JudgeBracket(const BodySegment& first, const BodySegment& second, const RelativePose& pose,
                  Outcome* outcome) {
  const Surface a(first), b(second);
  Work work(kUnits), again(kUnits);
  const Look look = BracketAt(a, b, pose, 0, 0, &work);
  const Decision decision = DecideAt(a, b, pose, &again);
  const Exact square = SquareOfSurfaces(*first.shape, *second.shape, pose);
  outcome->Add("poses", 1);
  outcome->Expect(!std::isnan(look.lower) && !std::isnan(look.upper), "not a number");
  outcome->Expect(work.spent() <= kUnits + kBatchUnits && again.spent() <= kUnits + kBatchUnits,
                  "more work than allowed");
  outcome->Greatest("work_max", static_cast<double>(work.spent()));
  outcome->Expect(IsAtMost(look.lower, square, 0), "the distance's lower end is above the truth");
  const bool nested = Nested(a, b, pose);
  if (square == 0 || nested) {
    outcome->Add("touching", 1);
    outcome->Expect(decision.verdict != Verdict::kApart, "contact is told as apart");
    return;
  }
  outcome->Expect(decision.verdict != Verdict::kTouching, "apart is told as contact");
  outcome->Expect(IsAtLeast(look.upper, square, 0), "the distance's upper end is below the truth");
  const double unit = 0x1p-52 * (pose.offset.norm() + a.reach() + b.reach());
  const double width = (look.upper - std::max(0.0, look.lower)) / unit;
  outcome->Greatest("width_units", width);
  outcome->Expect(width <= kBracketUnits, "a bracket of " + Show(width) + " units");
}

void Brackets(const Setting& setting, Outcome* outcome) {
  Random random(501);
  for (int i = 0; i < setting.Many(400, 4000); ++i) {
    const double size = std::ldexp(1, static_cast<int>(random.Below(38)) - 18);
    const double other =
        random.Chance(0.5) ? size : std::ldexp(1, static_cast<int>(random.Below(38)) - 18);
    const BodySegment a = At(FormOf(static_cast<int>(random.Below(4)), size));
    const BodySegment b = At(FormOf(static_cast<int>(random.Below(4)), other));
    Eigen::Quaterniond turn(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1),
                            random.Uniform(-1, 1));
    if (random.Chance(0.3)) turn = Eigen::Quaterniond::Identity();
    const double reach = a.ball.radius + b.ball.radius;
    const Vector3d offset = reach * random.LogUniform(1e-3, 3) * random.UnitVector();
    JudgeBracket(a, b, PoseOf(turn.normalized().toRotationMatrix(), offset), outcome);
  }
  outcome->Say(Show(outcome->Get("poses")) + " poses (" + Show(outcome->Get("touching")) +
               " in contact), the widest bracket " + Show(outcome->Get("width_units")) +
               " units, " + Show(outcome->Get("work_max")) + " units of work at most");
}

// Boxes of which a face is a unit in the last place before, at, and behind the other's.
void BracketGrazing(const Setting& setting, Outcome* outcome) {
  Random random(502);
  for (int i = 0; i < setting.Many(80, 800); ++i) {
    const double size = std::ldexp(1, static_cast<int>(random.Below(38)) - 18);
    const BodySegment a = At(FormOf(static_cast<int>(random.Below(3)), size));
    const BodySegment b = At(FormOf(static_cast<int>(random.Below(3)), size));
    const double touching = a.shape->facts().upper.x() + b.shape->facts().upper.x();
    const double y = random.Uniform(-0.5, 0.5) * size * 0x1p-12;
    for (const double x :
         {std::nextafter(touching, 0), touching, std::nextafter(touching, 1e300)}) {
      JudgeBracket(a, b, PoseOf(Eigen::Matrix3d::Identity(), {x, y, 0}), outcome);
    }
  }
  outcome->Say(Show(outcome->Get("poses")) + " poses (" + Show(outcome->Get("touching")) +
               " in contact), the widest bracket " + Show(outcome->Get("width_units")) + " units");
}

const char* const kPromise =
    "brackets of the distance contain the exact one, decisions are never wrong; at most 1024 units "
    "in the last place of place and size wide; work within what is allowed";

}  // namespace

std::vector<Case> BracketCases() {
  return {{"extreme", "brackets", kPromise, Brackets},
          {"extreme", "bracket-grazing", kPromise, BracketGrazing}};
}

}  // namespace collision::stress
