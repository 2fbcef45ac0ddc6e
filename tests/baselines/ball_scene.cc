#include "tests/baselines/ball_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace collision::baselines {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Steps at most; a simple root takes about five.
constexpr int kStepsMax = 100;

/// |d + w t| against the reach c0 + c1 t + c2 t², t >= 0.
struct Approaching {
  Eigen::Vector3d d, w;
  double c0, c1, c2;

  double Reach(double t) const { return c0 + t * (c1 + t * c2); }
};

Approaching Between(const BallAgent& a, const BallAgent& b, double base) {
  const double since_a = base - a.stamp, since_b = base - b.stamp;
  const double half_a = 0.5 * a.acceleration_max, half_b = 0.5 * b.acceleration_max;
  return {b.p_WA - a.p_WA + (b.v_WA * since_b - a.v_WA * since_a), b.v_WA - a.v_WA,
          a.radius + b.radius + half_a * since_a * since_a + half_b * since_b * since_b,
          2 * (half_a * since_a + half_b * since_b), half_a + half_b};
}

/// True only if they cannot meet by `limit`, shown without a root. Either along the first direction
/// between them the gap, concave in time, is open at both ends; or the way passes farther from the
/// other than the greatest reach.
bool CannotMeet(const Approaching& pair, double limit) {
  const double distance_squared = pair.d.squaredNorm();
  if (distance_squared <= pair.c0 * pair.c0) return false;
  const double along_way = pair.d.dot(pair.w);
  const double along = distance_squared + along_way * limit;
  const double reach = pair.Reach(limit), reach_squared = reach * reach;
  if (along > 0 && along * along > distance_squared * reach_squared) return true;
  const double way_squared = pair.w.squaredNorm() * limit;
  const double nearest = along_way >= 0             ? 0
                         : way_squared > -along_way ? -along_way / way_squared
                                                    : 1;
  return (pair.d + pair.w * (nearest * limit)).squaredNorm() > reach_squared;
}

/// Where nothing accelerates: the root of a quadratic.
double LinearRoot(const Approaching& pair, double limit) {
  const double gap = pair.d.squaredNorm() - pair.c0 * pair.c0;
  if (gap <= 0) return 0;
  const double closing = -pair.d.dot(pair.w);
  if (closing <= 0) return kNever;
  const double discriminant = closing * closing - pair.w.squaredNorm() * gap;
  if (discriminant < 0) return kNever;
  const double time = gap / (closing + std::sqrt(discriminant));
  return time <= limit ? time : kNever;
}

/// Newton's method on the tangent of the distance, from below: it never passes the first root.
double FirstRoot(const Approaching& pair, double limit) {
  double time = 0;
  for (int step_count = 0; step_count < kStepsMax; ++step_count) {
    const Eigen::Vector3d apart = pair.d + pair.w * time;
    const double distance = apart.norm();
    const double gap = distance - pair.Reach(time);
    if (gap <= 0) return time;
    const double closing = pair.c1 + 2 * pair.c2 * time - apart.dot(pair.w) / distance;
    const double root = std::sqrt(closing * closing + 4 * pair.c2 * gap);
    const double step = closing > 0 ? 2 * gap / (closing + root) : (root - closing) / (2 * pair.c2);
    time += step;
    if (time > limit) return kNever;
    if (step <= 1e-15 * time) return time;
  }
  return time;
}

}  // namespace

double ReferenceIntersectionTime(const BallAgent& a, const BallAgent& b, double limit) {
  const double base = std::max(a.stamp, b.stamp), left = limit - base;
  const Approaching pair = Between(a, b, base);
  if (CannotMeet(pair, left)) return kNever;
  return base + (pair.c2 == 0 ? LinearRoot(pair, left) : FirstRoot(pair, left));
}

SweptBox SweptBoxOf(const BallAgent& agent, double end) {
  SweptBox box;
  const double window = end - agent.stamp;
  const double end_radius = agent.radius + 0.5 * agent.acceleration_max * window * window;
  for (int axis = 0; axis < 3; ++axis) {
    const double first = agent.p_WA[axis], last = first + agent.v_WA[axis] * window;
    box.lower[axis] = std::min(first - agent.radius, last - end_radius);
    box.upper[axis] = std::max(first + agent.radius, last + end_radius);
  }
  return box;
}

}  // namespace collision::baselines
