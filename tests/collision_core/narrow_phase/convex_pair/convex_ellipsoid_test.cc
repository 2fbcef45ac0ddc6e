#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "collision_core/narrow_phase/convex_pair/convex_distance.h"
#include "tests/collision_core/narrow_phase/convex_cases.h"

namespace collision::narrow_phase {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

shape::ConvexDescription RandomEllipsoid(Random& random, double flatness) {
  shape::ConvexDescription d;
  d.core = geometry::ConvexCore::kEllipsoid;
  for (int axis = 0; axis < 3; ++axis) d.half[axis] = random.LogUniform(flatness, 1);
  d.q_BS = RandomQuaternion(random);
  return d;
}

/// The point seen from the ellipsoid's centre, along its axes.
ExactVector InAxes(const shape::ConvexDescription& d, const Vector3d& point) {
  const ExactPlacement placement = PlacementOf(d.q_BS, d.p_BS);
  const ExactVector seen = ExactVector(point) - placement.offset;
  ExactVector along(0, 0, 0);
  along = along + seen.x * placement.rows[0] + seen.y * placement.rows[1];
  return along + seen.z * placement.rows[2];
}

struct SquareBracket {
  Exact lower, upper;
};

/// The squared distance of a point to the surface, and whether it is inside. The foot of the point
/// p is a_i² p_i / (a_i² + t) for the root t of Σ (a_i p_i / (a_i² + t))² = 1, t > 0 outside and t
/// > −min a_i² inside; the distance grows with |t|.
SquareBracket ToSurface(const shape::ConvexDescription& d, const Vector3d& point, bool* inside) {
  const ExactVector p = InAxes(d, point);
  const Exact coordinates[3] = {p.x, p.y, p.z};
  const auto sum = [&](const Exact& t, bool distance) {
    Exact value = 0;
    for (int i = 0; i < 3; ++i) {
      const Exact a = Exact(d.half[i]), part = coordinates[i] / (a * a + t);
      value += distance ? t * t * part * part : a * a * part * part;
    }
    return value;
  };
  *inside = sum(0, false) < 1;
  const Exact least = d.half.minCoeff();
  Exact low = *inside ? Exact(-least * least) : Exact(0),
        high = *inside ? Exact(0) : Exact(1 << 20);
  for (int i = 0; i < 110; ++i) {
    const Exact middle = (low + high) / 2;
    (sum(middle, false) > 1 ? low : high) = middle;
  }
  if (*inside) std::swap(low, high);
  return {sum(low, true), sum(high, true)};
}

ConvexSeparation Ask(const shape::ConvexDescription& a, const shape::ConvexDescription& b,
                     const ConvexQuery& query) {
  const shape::ConvexSolid solid_a = shape::ConvexSolid::Build(a),
                           solid_b = shape::ConvexSolid::Build(b);
  geometry::GjkHint hint;
  WorkBudget work(1000000);
  return SeparationOf(solid_a.set(), solid_b.set(), query, &hint, &work);
}

// Goal:   the distance of a ball to an ellipsoid, and how deep it is in it, are contained and known
//         to 1e-6 of themselves where that is asked for.
// Method: the foot of the ball's centre by bisection in rational arithmetic.
TEST(ConvexEllipsoid, BallsOutsideAndInside) {
  Random random(311);
  int inside_count = 0;
  for (int i = 0; i < 120; ++i) {
    const shape::ConvexDescription a = RandomEllipsoid(random, i % 3 ? 0.2 : 0.01);
    shape::ConvexDescription b;
    b.rounding = random.Uniform(0.01, 1);
    b.p_BS = random.Uniform(0, 2) * random.UnitVector();
    ConvexQuery query;
    query.relative_tolerance = 1e-6;
    const ConvexSeparation found = Ask(a, b, query);
    bool inside = false;
    const SquareBracket square = ToSurface(a, b.p_BS, &inside);
    const Exact rounding = b.rounding;
    if (inside) {
      ++inside_count;
      EXPECT_TRUE(IsAtMost(-found.separation.upper, square.upper, -rounding)) << i;
      EXPECT_TRUE(IsAtLeast(-found.separation.lower, square.lower, -rounding)) << i;
      EXPECT_LT(found.separation.width(), 1e-3) << i;
    } else {
      EXPECT_TRUE(IsAtMost(found.separation.lower, square.upper, rounding)) << i;
      EXPECT_TRUE(IsAtLeast(found.separation.upper, square.lower, rounding)) << i;
      EXPECT_LT(found.separation.width(), 1e-6 * std::abs(found.separation.middle()) + 1e-9) << i;
    }
  }
  EXPECT_GT(inside_count, 15);
}

using Wide = boost::multiprecision::cpp_bin_float_50;
using WideVector = std::array<Wide, 3>;

/// Projections onto an ellipsoid or a box in fifty digits.
class WideSolid {
 public:
  explicit WideSolid(const shape::ConvexDescription& d) : d_(d) {
    const ExactPlacement placement = PlacementOf(d.q_BS, d.p_BS);
    for (int i = 0; i < 3; ++i) {
      const ExactVector& row = placement.rows[i];
      rows_[i] = {Wide(row.x), Wide(row.y), Wide(row.z)};
    }
  }

  WideVector Nearest(const WideVector& point) const {
    WideVector along{};
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) along[i] += rows_[k][i] * (point[k] - Wide(d_.p_BS[k]));
    }
    along = d_.core == geometry::ConvexCore::kBox ? Clamped(along) : Foot(along);
    WideVector nearest{};
    for (int k = 0; k < 3; ++k) {
      nearest[k] = d_.p_BS[k];
      for (int i = 0; i < 3; ++i) nearest[k] += rows_[k][i] * along[i];
    }
    return nearest;
  }

 private:
  WideVector Clamped(WideVector p) const {
    for (int i = 0; i < 3; ++i) {
      const Wide half = d_.half[i];
      if (p[i] > half) p[i] = half;
      if (p[i] < -half) p[i] = -half;
    }
    return p;
  }

  WideVector Foot(WideVector p) const {
    const auto excess = [&](const Wide& t) {
      Wide sum = -1;
      for (int i = 0; i < 3; ++i) {
        const Wide a = d_.half[i], part = a * p[i] / (a * a + t);
        sum += part * part;
      }
      return sum;
    };
    if (excess(0) <= 0) return p;
    Wide t =
        0;  // Newton's iteration from the left of a convex, falling function never passes its root.
    for (int step = 0; step < 200; ++step) {
      Wide slope = 0;
      for (int i = 0; i < 3; ++i) {
        const Wide a = d_.half[i], part = a * p[i] / (a * a + t);
        slope -= 2 * part * part / (a * a + t);
      }
      const Wide further = -excess(t) / slope;
      t += further;
      if (further <= t * Wide(1e-40)) break;
    }
    for (int i = 0; i < 3; ++i) {
      const Wide a = d_.half[i];
      p[i] *= a * a / (a * a + t);
    }
    return p;
  }

  shape::ConvexDescription d_;
  std::array<WideVector, 3> rows_;
};

Wide Distance(const WideVector& a, const WideVector& b) {
  Wide square = 0;
  for (int i = 0; i < 3; ++i) square += (a[i] - b[i]) * (a[i] - b[i]);
  return sqrt(square);
}

/// By projections to and fro, until they do not get shorter any more; −1: that did not happen.
Wide ByProjections(const WideSolid& a, const WideSolid& b) {
  WideVector x{}, y{};
  Wide before = 1e9;
  for (int i = 0; i < 3000; ++i) {
    x = a.Nearest(y);
    y = b.Nearest(x);
    const Wide distance = Distance(x, y);
    if (before - distance < Wide(1e-30)) return distance;
    before = distance;
  }
  return -1;
}

// Goal:   ellipsoids against ellipsoids and boxes: the distance is contained, and known to 1e-6 of
//         itself.
// Method: projections to and fro between the two, in fifty digits: another way altogether.
TEST(ConvexEllipsoid, EllipsoidsAndBoxes) {
  Random random(312);
  int compared = 0;
  for (int i = 0; i < 60; ++i) {
    const shape::ConvexDescription a = RandomEllipsoid(random, i % 2 ? 0.3 : 0.1);
    shape::ConvexDescription b = i % 3 ? RandomEllipsoid(random, 0.3) : RandomBox(random, 1);
    b.p_BS = random.Uniform(1.2, 4) * random.UnitVector();
    ConvexQuery query;
    query.relative_tolerance = 1e-6;
    const ConvexSeparation found = Ask(a, b, query);
    if (!(found.separation.lower > 0.01)) continue;
    const Wide distance = ByProjections(WideSolid(a), WideSolid(b));
    if (distance < 0) continue;
    ++compared;
    EXPECT_LE(Wide(found.separation.lower), distance + Wide(1e-25)) << i;
    EXPECT_GE(Wide(found.separation.upper), distance - Wide(1e-25)) << i;
    EXPECT_LE(found.separation.width(), 1e-6 * found.separation.lower) << i;
  }
  EXPECT_GT(compared, 20);
}

// Goal:   without a width asked for ellipsoids are known nearly as well as doubles allow.
TEST(ConvexEllipsoid, NarrowWithoutALimit) {
  Random random(313);
  int exhausted = 0;
  for (int i = 0; i < 300; ++i) {
    const shape::ConvexDescription a = RandomEllipsoid(random, 0.2);
    shape::ConvexDescription b = i % 2 ? RandomEllipsoid(random, 0.2) : RandomBox(random, 1);
    b.p_BS = random.Uniform(2.2, 6) * random.UnitVector();
    const ConvexSeparation found = Ask(a, b, {});
    exhausted += found.exhausted;
    EXPECT_LT(found.separation.width(), 1e-8) << i;
  }
  EXPECT_LT(exhausted, 30);
}

// Goal:   ellipsoids of like axes about one centre: the depth is the sum of the least semi-axes.
TEST(ConvexEllipsoid, ConcentricDepth) {
  Random random(314);
  for (int i = 0; i < 50; ++i) {
    shape::ConvexDescription a = RandomEllipsoid(random, 0.2), b = a;
    for (shape::ConvexDescription* d : {&a, &b}) d->half.z() = random.Uniform(0.05, 0.15);
    for (int axis = 0; axis < 2; ++axis) b.half[axis] = random.Uniform(0.2, 1);
    const ConvexSeparation found = Ask(a, b, {});
    const double depth = a.half.z() + b.half.z();
    EXPECT_LE(found.separation.lower, -depth + 1e-15);
    EXPECT_GE(found.separation.upper, -depth - 1e-15);
    EXPECT_LT(found.separation.width(), 0.05 * depth);
  }
}

// Goal:   however near the two are, the bracket is narrow: the corners of a simplex alone would not
//         tell.
TEST(ConvexEllipsoid, NearContactIsKnownToTheLastBits) {
  int beside[3] = {0, 0, 0};
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    shape::ConvexDescription egg = RandomBox(random, 1), other = RandomBox(random, 1);
    egg.core = geometry::ConvexCore::kEllipsoid;
    if (seed % 4 == 0) other.core = geometry::ConvexCore::kEllipsoid;
    if (seed % 4 == 1) other = RandomHull(random, 1, 20);
    ConvexCase scene(egg, other);
    scene.Turn(RandomQuaternion(random), 3 * random.UnitVector());
    const double gap = random.LogUniform(1e-12, 1e-2);
    scene.MoveTo(gap);
    const ConvexSeparation found = scene.Ask();
    EXPECT_NEAR(found.separation.middle(), gap, 1e-12 + 1e-3 * gap);
    EXPECT_LE(found.separation.width(), 1e-12);
    ++beside[seed % 4 == 0 ? 0 : seed % 4 == 1 ? 1 : 2];
  }
  EXPECT_GE(std::min({beside[0], beside[1], beside[2]}), 50);
}

}  // namespace
}  // namespace collision::narrow_phase
