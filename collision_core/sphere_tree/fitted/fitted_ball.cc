#include "collision_core/sphere_tree/fitted/fitted_ball.h"

#include <algorithm>
#include <cmath>

namespace collision::sphere_tree {
namespace {

using Eigen::Vector3d;

/// The shrinking ball ends here at the latest; it is a start for a search.
constexpr int kShrinkings = 12;

/// A first step as a share of the ball's radius, and where steps are too small to matter, as a
/// share of its overshoot.
constexpr double kFirstStep = 0.25, kLastStep = 0.01;

/// A ball this large beside the way to the opposite side is nearly the one half-way.
constexpr double kMuchOfHalfWay = 0.7;

/// How exact the distance of the ball half-way is, as a share of the way.
constexpr double kHalfWaySlack = 0.005;

/// How exact distances are in the search, as a share of the overshoot.
constexpr double kSlack = 0.01;

/// The shrinking ball ends where this share of it is free, and shrinks by this factor at least;
/// distances are looked for to kShrinkingSlack of its radius.
constexpr double kShrinking = 0.98, kShrinkingSlack = 0.01;

Vector3d Direction(const Vector3d& v) {
  const double length = v.norm();
  return length > 0 ? Vector3d(v / length) : Vector3d::Zero();
}

/// The largest ball that touches the surface at `from`, lies towards `inward` and contains no other
/// surface, nearly (Ma, Bae and Choi, "3D medial axis point approximation using nearest neighbors
/// and the normal field", 2012): each point found inside makes it smaller.
FittedBall ShrinkingBall(const TriangleBoxTree& boxes, const Vector3d& from, const Vector3d& inward,
                         double radius, ElementIndex triangle) {
  FittedBall ball;
  ball.inside = true;
  ball.triangle = triangle;
  for (int i = 0; i < kShrinkings; ++i) {
    ball.centre = from + radius * inward;
    const NearPoint near = boxes.Nearest(ball.centre, ball.triangle, 0, kShrinkingSlack * radius);
    ball.signed_distance = -near.distance;
    ball.nearest = near.point;
    ball.triangle = near.triangle;
    const Vector3d chord = ball.nearest - from;
    const double along = chord.dot(inward);
    if (near.distance >= kShrinking * radius || !(along > 0)) break;
    radius = std::min(0.5 * chord.squaredNorm() / along, kShrinking * radius);
  }
  return ball;
}

}  // namespace

FarPoint FarthestFrom(const Vector3d& centre, std::span<const Vector3d> points) {
  FarPoint far;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const double square = (points[i] - centre).squaredNorm();
    if (square > far.distance) far = {square, i};
  }
  far.distance = std::sqrt(far.distance);
  return far;
}

bool BallPolish::Try(std::span<const Vector3d> points, const Vector3d& centre, double step,
                     FittedBall* ball) {
  // What is known rules most trials out: no ball about them is smaller, no surface is farther.
  const double most = ball->overshoot();
  double radius2 = 0, near2 = std::numeric_limits<double>::infinity();
  for (const Vector3d& p : far_) radius2 = std::max(radius2, (p - centre).squaredNorm());
  for (const Vector3d& p : near_) near2 = std::min(near2, (p - centre).squaredNorm());
  // Within the ball that holds no surface it stays inside.
  const bool inside = ball->inside && step < -ball->signed_distance;
  if (std::sqrt(radius2) - (inside ? std::sqrt(near2) : 0) >= most) return false;
  const FarPoint far = FarthestFrom(centre, points);
  if (far.distance > std::sqrt(radius2)) far_.push_back(points[far.index]);
  const double enough = inside ? far.distance - most : 0;
  if (inside ? enough >= std::sqrt(near2) : far.distance >= most) return false;
  --queries_;
  const NearPoint near = boxes_.Nearest(centre, ball->triangle, enough, kSlack * most);
  near_.push_back(near.point);
  const double signed_distance = inside ? -near.distance : near.distance;
  if (far.distance + signed_distance >= most) return false;
  ball->centre = centre;
  ball->nearest = near.point;
  ball->triangle = near.triangle;
  ball->signed_distance = signed_distance;
  ball->radius = far.distance;
  ball->inside = inside;
  farthest_ = points[far.index];
  return true;
}

void BallPolish::Run(std::span<const Vector3d> points, int queries, FittedBall* ball) {
  const FarPoint far = FarthestFrom(ball->centre, points);
  ball->radius = far.distance;
  farthest_ = points[far.index];
  near_.assign(1, ball->nearest);
  far_.assign(1, farthest_);
  queries_ = queries;
  double step = kFirstStep * ball->radius;
  while (queries_ > 0 && step > kLastStep * std::max(ball->overshoot(), kLastStep * ball->radius)) {
    // Down the steeper of both slopes, down both, or across.
    const Vector3d to_far = Direction(farthest_ - ball->centre);
    const Vector3d from_near = ball->inside ? Direction(ball->centre - ball->nearest)
                                            : Direction(ball->nearest - ball->centre);
    const Vector3d both = Direction(to_far + from_near);
    bool moved = false;
    for (const Vector3d& direction : {both, to_far, from_near}) {
      moved = Try(points, ball->centre + step * direction, step, ball);
      if (moved) break;
    }
    step *= moved ? 1.2 : 0.5;
  }
}

void AppendCandidates(const TriangleBoxTree& boxes, const SurfacePoint& at, SurfaceKind kind,
                      std::vector<FittedBall>* candidates) {
  const auto& [from, normal, triangle] = at;
  FittedBall on_surface;
  on_surface.centre = on_surface.nearest = from;
  on_surface.triangle = triangle;
  candidates->push_back(on_surface);
  if (kind == SurfaceKind::kOpen) return;
  for (const double side : {-1.0, 1.0}) {
    const Vector3d inward = side * normal;
    const RayCast walk = boxes.Walk(from, inward, triangle);
    if (walk.winding == 0) continue;
    candidates->push_back(ShrinkingBall(boxes, from, inward, 0.5 * walk.first, triangle));
    if (-candidates->back().signed_distance > kMuchOfHalfWay * 0.5 * walk.first) continue;
    FittedBall half_way;
    half_way.inside = true;
    half_way.triangle = triangle;
    half_way.centre = from + 0.5 * walk.first * inward;
    const NearPoint near = boxes.Nearest(half_way.centre, triangle, 0, kHalfWaySlack * walk.first);
    half_way.signed_distance = -near.distance;
    half_way.nearest = near.point;
    half_way.triangle = near.triangle;
    candidates->push_back(half_way);
  }
}

}  // namespace collision::sphere_tree
