#include "client/checker/shape/bodies.h"

#include <algorithm>
#include <array>
#include <span>

#include "client/checker/shape/convex.h"

namespace collision::checker {
namespace {

// A body is the union of these: all points within `rounding_m` of a core, which is a surface of
// triangles, with what it encloses if it is closed, or (null) the reference point, or `round`.
struct Part {
  const Mesh* core = nullptr;
  double rounding_m = 0;
  const RoundCore* round = nullptr;
  bool convex = true;  // the core

  Vector centre() const { return core != nullptr ? core->nodes()[0].centre : Vector{}; }
  double reach() const {  // About the centre.
    if (round != nullptr) return rounding_m + round->reach();
    return rounding_m + (core != nullptr ? Length(core->nodes()[0].half) : 0);
  }
  ConvexSet set() const {
    if (round != nullptr) return round;
    return core != nullptr ? ConvexSet(core) : ConvexSet(Vector{});
  }
};

// The parts of a body, without an allocation if there is only one: it is requested often.
class BodyParts {
 public:
  explicit BodyParts(const Body& body)
      : one_{{{body.mesh, body.grown_m, nullptr, body.mesh == nullptr}}} {
    if (body.IsBall()) one_[0].rounding_m = body.reach();
    if (body.solids == nullptr || body.solids->empty()) return;
    if (body.mesh != nullptr) many_.push_back(one_[0]);
    for (const Solid& solid : *body.solids)
      many_.push_back(
          {&solid.core, solid.rounding_m + body.grown_m, solid.round ? &*solid.round : nullptr});
  }

  std::span<const Part> all() const {
    return many_.empty() ? std::span<const Part>(one_) : std::span<const Part>(many_);
  }

 private:
  std::array<Part, 1> one_;
  std::vector<Part> many_;
};

// One part of each of two bodies, the pose of B in A's axes, and where the last search ended.
struct PosedParts {
  const Part& a;
  const Part& b;
  const Pose& pose;
  Hint* hint;
};

// The distance [m] of the cores if it is less than `limit`, else `limit`. Negative where they
// touch, cross or contain each other: minus the distance by which they may be moved and still do
// (with `depth`; else 0 where they touch or cross). `outside`: neither lies inside the other.
double CoreGap(const PosedParts& parts, double limit, bool outside, bool depth) {
  const auto& [a, b, pose, hint] = parts;
  if (a.round != nullptr && !b.convex)
    return SurfaceGap(*b.core, *a.round, pose.Inverse(), outside, depth);
  if (b.round != nullptr && !a.convex) return SurfaceGap(*a.core, *b.round, pose, outside, depth);
  if (a.round != nullptr || b.round != nullptr) return ConvexGap(a.set(), b.set(), pose, depth);
  if (a.core == nullptr && b.core == nullptr) return Length(pose.p_AB);
  if (a.core == nullptr || b.core == nullptr) {
    const Mesh& mesh = a.core == nullptr ? *b.core : *a.core;
    const Vector point = a.core == nullptr ? pose.Back({}) : pose.p_AB;
    const double distance = SurfaceDistance(mesh, point);
    return mesh.Contains(point) ? -distance : distance;
  }
  const double distance = SurfaceDistance(*a.core, *b.core, pose, limit, hint);
  if (distance <= kTouching) return depth ? -BestCrossing(*a.core, *b.core, pose) : 0;
  const bool inside = !outside && Contained(*a.core, *b.core, pose);
  return inside ? -distance : distance;
}

// `apart_least`: a larger distance [m] need not be exact.
Standing StandingOf(const PosedParts& parts, double apart_least, bool outside) {
  const double reach = parts.a.rounding_m + parts.b.rounding_m;
  const double limit = std::max(apart_least, 2 * kTouching) + reach;
  const double gap = CoreGap(parts, limit, outside, true);
  if (gap <= reach + kTouching) return {true, std::max(0.0, reach - gap)};
  return {false, gap - reach};
}

// A lower bound of the distance; negative where it says nothing.
double ApartAtLeast(const Part& a, const Part& b, const Pose& pose) {
  return Length(pose(b.centre()) - a.centre()) - a.reach() - b.reach();
}

// The least d·x of the points x of a body, for a d of length 1.
double LeastAlong(const Body& body, const Vector& d) {
  double least = INFINITY;
  const BodyParts parts(body);
  for (const Part& part : parts.all()) {
    const double of_core = part.round != nullptr  ? Dot(d, part.round->Support(-d))
                           : part.core != nullptr ? LeastAlong(*part.core, d)
                                                  : 0;
    least = std::min(least, of_core - part.rounding_m);
  }
  return least;
}

// The signed distance of a body and a half-space, one of the two: how far the body's lowest point
// is above the plane.
double HeightOf(const Body& a, const Body& b, const Pose& pose) {
  if (a.half_space == nullptr) return HeightOf(b, a, pose.Inverse());
  const Vector& n = a.half_space->normal;
  const double lowest = LeastAlong(b, pose.Back(n + pose.p_AB)) + Dot(n, pose.p_AB);
  return lowest - a.half_space->offset_m - a.grown_m;
}

bool HasHalfSpace(const Body& a, const Body& b) {
  return a.half_space != nullptr || b.half_space != nullptr;
}

// The triangles of the last call are a hint only with one part each.
Hint* HintFor(std::size_t parts_of_a, std::size_t parts_of_b, Hint* last, Hint* fresh) {
  *fresh = {};
  return parts_of_a == 1 && parts_of_b == 1 ? last : fresh;
}

}  // namespace

double Body::reach() const {
  if (half_space != nullptr) return 0;
  if (IsBall()) return radius_m + grown_m;
  double reach = mesh != nullptr ? mesh->radius_m() : 0;
  if (solids == nullptr) return reach + grown_m;
  for (const Solid& solid : *solids) reach = std::max(reach, solid.radius_m());
  return reach + grown_m;
}

// A contact of bodies lasts as long as the firmest contact of two parts; none begins before the
// nearest two parts could touch.
Standing StandingOf(const Body& body_a, const Body& body_b, const Pose& pose, Hint* hint,
                    bool outside) {
  if (HasHalfSpace(body_a, body_b)) {
    const double height = HeightOf(body_a, body_b, pose);
    return {height <= kTouching, height <= kTouching ? std::max(0.0, -height) : height};
  }
  const BodyParts of_a(body_a), of_b(body_b);
  Standing all{false, INFINITY};
  Hint fresh;
  for (const Part& a : of_a.all()) {
    for (const Part& b : of_b.all()) {
      const double least = of_a.all().size() * of_b.all().size() > 1 ? ApartAtLeast(a, b, pose) : 0;
      if (least > (all.contact ? kTouching : all.margin)) continue;
      Hint* near = HintFor(of_a.all().size(), of_b.all().size(), hint, &fresh);
      const Standing one = StandingOf({a, b, pose, near}, all.contact ? 0 : all.margin, outside);
      if (one.contact == all.contact) {
        all.margin =
            one.contact ? std::max(all.margin, one.margin) : std::min(all.margin, one.margin);
      } else if (one.contact) {
        all = one;
      }
    }
  }
  return all;
}

bool InContact(const Body& body_a, const Body& body_b, const Pose& pose, Hint* hint) {
  if (HasHalfSpace(body_a, body_b)) return HeightOf(body_a, body_b, pose) <= kTouching;
  const BodyParts of_a(body_a), of_b(body_b);
  Hint fresh;
  for (const Part& a : of_a.all()) {
    for (const Part& b : of_b.all()) {
      if (ApartAtLeast(a, b, pose) > 2 * kTouching) continue;
      const double reach = a.rounding_m + b.rounding_m;
      Hint* near = HintFor(of_a.all().size(), of_b.all().size(), hint, &fresh);
      if (CoreGap({a, b, pose, near}, reach + 2 * kTouching, false, false) <= reach + kTouching)
        return true;
    }
  }
  return false;
}

bool InContactThrough(const Body& a, const Body& b, const Pose& pose, double depth, Hint* hint) {
  constexpr double kCosine = 0.86;  // of 30 degrees, rounded down
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const Vector direction{double(x), double(y), double(z)};
        const double length = Length(direction);
        Pose moved = pose;
        if (length > 0) moved.p_AB = pose.p_AB + depth / (kCosine * length) * direction;
        if (!InContact(a, b, moved, hint)) return false;
      }
    }
  }
  return true;
}

double DistanceOf(const Body& a, const Body& b, const Pose& pose) {
  Hint hint;
  const Standing standing = StandingOf(a, b, pose, &hint);
  return standing.contact ? 0 : standing.margin;
}

double DistanceTo(const Body& body, const Vector& point) {
  if (body.half_space != nullptr) {
    const double height = Dot(body.half_space->normal, point) - body.half_space->offset_m;
    return std::max(0.0, height - body.grown_m);
  }
  double least = INFINITY;
  const BodyParts parts(body);
  for (const Part& part : parts.all()) {
    if (part.round != nullptr) {
      const double gap = ConvexGap(part.round, point, {}, false);
      least = std::min(least, std::max(0.0, gap - part.rounding_m));
      continue;
    }
    double distance = part.core != nullptr ? SurfaceDistance(*part.core, point) : Length(point);
    if (part.core != nullptr && part.core->Contains(point)) distance = 0;
    least = std::min(least, std::max(0.0, distance - part.rounding_m));
  }
  return least;
}

double DepthAtMost(const Body& a, const Body& b, const Pose& pose, const Vector& along) {
  if (HasHalfSpace(a, b)) return -HeightOf(a, b, pose);
  std::vector<Vector> directions = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, pose.p_AB, along};
  for (const Vector& axis : {Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, 0, 1}})
    directions.push_back(pose(axis) - pose.p_AB);
  double least = INFINITY;
  for (const Vector& direction : directions) {
    const double length = Length(direction);
    if (!(length > 0) || !std::isfinite(length)) continue;
    const Vector n = 1 / length * direction;
    const Vector of_b = pose.Back(n + pose.p_AB);  // the same direction in the frame of B
    const double shift = Dot(n, pose.p_AB);
    least = std::min({least, -LeastAlong(a, -n) - LeastAlong(b, of_b) - shift,
                      -LeastAlong(b, -of_b) + shift - LeastAlong(a, n)});
  }
  return least;
}

}  // namespace collision::checker
