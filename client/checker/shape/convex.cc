#include "client/checker/shape/convex.h"

#include <array>
#include <cstddef>
#include <limits>

#include "client/checker/shape/surfaces.h"

namespace collision::checker {
namespace {

constexpr int kIterationsMax = 200;
constexpr double kExact = 1e-15;    // of the coordinates' size: they cannot tell more
constexpr double kDepthMin = 1e-9;  // [m] a smaller depth counts as none
constexpr double kSqrtThree = 1.7320508075688774;

template <typename Points>
Vector FurthestOf(const Points& points, const Vector& direction) {
  return *std::max_element(points.begin(), points.end(), [&](const Vector& v, const Vector& w) {
    return Dot(direction, v) < Dot(direction, w);
  });
}

struct SupportAlong {
  const Vector& direction;

  Vector operator()(const Vector& point) const { return point; }
  Vector operator()(const Mesh* hull) const { return FurthestOf(hull->vertices(), direction); }
  Vector operator()(const Triangle& triangle) const { return FurthestOf(triangle, direction); }
  Vector operator()(const RoundCore* core) const { return core->Support(direction); }
};

// The set of all a − b, in the frame of A.
struct Difference {
  const ConvexSet& a;
  const ConvexSet& b;
  const Pose& pose;

  // Its point that is furthest along d.
  Vector Support(const Vector& d) const {
    const Vector back = pose.Back(pose.p_AB - d);
    return std::visit(SupportAlong{d}, a) - pose(std::visit(SupportAlong{back}, b));
  }
};

// Up to four points of the difference.
struct Simplex {
  std::array<Vector, 4> points;
  std::size_t size = 0;
};

double Triple(const Vector& a, const Vector& b, const Vector& c) { return Dot(a, Cross(b, c)); }

// The best of the faces looked at so far: the point of it that is nearest to the origin.
struct Nearest {
  Vector point;
  Simplex face;
  double squared = std::numeric_limits<double>::infinity();

  void Take(const Vector& candidate, std::initializer_list<Vector> corners) {
    const double length = Squared(candidate);
    if (!(length < squared)) return;
    point = candidate;
    squared = length;
    face.size = 0;
    for (const Vector& corner : corners) face.points[face.size++] = corner;
  }

  // If the nearest point of the segment's line lies on it.
  void TakeSegment(const Vector& a, const Vector& b) {
    const Vector d = b - a;
    const double along = -Dot(a, d), whole = Squared(d);
    if (along > 0 && along < whole) Take(a + along / whole * d, {a, b});
  }

  // Likewise of the triangle's plane: the weights of its corners are those of the origin's
  // projection.
  void TakeTriangle(const Vector& a, const Vector& b, const Vector& c) {
    const Vector n = Cross(b - a, c - a);
    const double whole = Squared(n);
    if (whole > 0 && Triple(n, b, c) > 0 && Triple(n, c, a) > 0 && Triple(n, a, b) > 0)
      Take(Dot(a, n) / whole * n, {a, b, c});
  }

  // If the tetrahedron contains the origin.
  void TakeTetrahedron(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
    const double whole = Triple(b - a, c - a, d - a);
    if (whole != 0 && Triple(b, c, d) / whole > 0 && -Triple(a, c, d) / whole > 0 &&
        Triple(a, b, d) / whole > 0 && -Triple(a, b, c) / whole > 0) {
      Take({}, {a, b, c, d});
    }
  }
};

Nearest NearestOf(const Simplex& simplex) {
  Nearest nearest;
  const auto& p = simplex.points;
  for (std::size_t i = 0; i < simplex.size; ++i) {
    nearest.Take(p[i], {p[i]});
    for (std::size_t j = 0; j < i; ++j) {
      nearest.TakeSegment(p[i], p[j]);
      for (std::size_t k = 0; k < j; ++k) nearest.TakeTriangle(p[i], p[j], p[k]);
    }
  }
  if (simplex.size == 4) nearest.TakeTetrahedron(p[0], p[1], p[2], p[3]);
  return nearest;
}

// The distance of the difference from the origin; 0: they touch. `enough`: no more need be known.
double DistanceOf(const Difference& difference, double enough) {
  Simplex simplex;
  simplex.points[simplex.size++] = difference.Support({1, 0, 0});
  double lower = 0, before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kIterationsMax; ++i) {
    const Nearest nearest = NearestOf(simplex);
    const double length = std::sqrt(nearest.squared);
    if (length <= kTouching || nearest.face.size == 4) return 0;
    simplex = nearest.face;
    const Vector w = difference.Support(-nearest.point);
    lower = std::max(lower, Dot(nearest.point, w) / length);
    const bool known = length - lower <= kExact * (length + Length(w));
    if (known || lower > enough || !(length < before)) break;
    before = length;
    simplex.points[simplex.size++] = w;
  }
  return lower;
}

double DepthOf(const Difference& difference) {
  const Vector axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  double shift = std::numeric_limits<double>::infinity();
  for (const Vector& axis : axes) {
    for (const double sign : {1.0, -1.0})
      shift = std::min(shift, sign * Dot(axis, difference.Support(sign * axis)));
  }
  const auto touch = [&](const Vector& by) {
    Pose moved = difference.pose;
    moved.p_AB = moved.p_AB + by;
    return DistanceOf({difference.a, difference.b, moved}, kTouching) <= kTouching;
  };
  for (; shift > kDepthMin; shift /= 2) {
    const bool all = std::all_of(std::begin(axes), std::end(axes), [&](const Vector& axis) {
      return touch(shift * axis) && touch(-(shift * axis));
    });
    if (all) return shift / kSqrtThree;
  }
  return 0;
}

}  // namespace

double ConvexGap(const ConvexSet& a, const ConvexSet& b, const Pose& pose, bool depth) {
  const Difference difference{a, b, pose};
  const double distance = DistanceOf(difference, std::numeric_limits<double>::infinity());
  return distance > kTouching || !depth ? distance : -DepthOf(difference);
}

double SurfaceGap(const Mesh& mesh, const RoundCore& core, const Pose& pose, bool outside,
                  bool depth) {
  const Vector centre = pose(core.centre());
  double best = SurfaceDistance(mesh, centre);
  double deepest = 0;
  bool touch = false;
  for (const std::uint32_t i : TrianglesNear(mesh, centre, best + core.reach())) {
    const double gap = ConvexGap(mesh.triangles()[i], &core, pose, depth);
    touch = touch || gap <= kTouching;
    deepest = std::max(deepest, -gap);
    best = std::min(best, gap);
    if (touch && !depth) return 0;
  }
  if (touch) return -deepest;
  return !outside && mesh.Contains(centre) ? -best : best;
}

}  // namespace collision::checker
