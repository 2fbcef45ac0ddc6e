#include "collision_core/detection/pairs/contact_rest.h"

#include <algorithm>

#include "collision_core/numeric/seconds.h"

namespace collision::detection {
namespace {

/// More than the rounding of the thirty operations below takes of their terms.
constexpr double kMargin = 0x1p-40;

/// Whether two balls whose newest states lie in the past are in a contact that has not ended.
bool MayRest(const RestingPair& pair) {
  const ContactTracker &settled = pair.settled, &preview = pair.preview;
  const bool begun = settled.in_contact() ||
                     (preview.in_contact() && preview.episode().begin.latest <= settled.at());
  if (!begun || !preview.in_contact() || !preview.finished().empty()) return false;
  for (const History::Sample* newest : {&pair.a, &pair.b}) {
    if (newest->has_shape() || newest->bound.state.stamp > preview.at()) return false;
    if (HasKnownAcceleration(newest->bound.state)) return false;
  }
  return true;
}

/// r − |Δc| at an instant, rounded down.
double OverlapAt(const motion::SpaceTimeBound& a, const motion::SpaceTimeBound& b, Instant at) {
  const double tau_A = numeric::SecondsBetween(a.state.stamp, at).middle();
  const double tau_B = numeric::SecondsBetween(b.state.stamp, at).middle();
  const Eigen::Vector3d d =
      (b.state.p_WA - a.state.p_WA) + tau_B * b.state.v_WA - tau_A * a.state.v_WA;
  const double sum = a.state.p_WA.norm() + b.state.p_WA.norm() + tau_A * a.state.v_WA.norm() +
                     tau_B * b.state.v_WA.norm() + a.limits.radius + b.limits.radius;
  return a.limits.radius + b.limits.radius - d.norm() - kMargin * sum;
}

}  // namespace

Instant ContactRestsUntil(const RestingPair& pair, Instant now, double longest) {
  if (!MayRest(pair)) return Instant::Always();
  const motion::SpaceTimeBound &a = pair.a.bound, &b = pair.b.bound;
  const Eigen::Vector3d w = b.state.v_WA - a.state.v_WA;
  double left = numeric::kInfinity;
  for (const Instant at : {pair.preview.at(), now}) {
    left = OverlapAt(a, b, at);
    if (!(left > 0)) return Instant::Always();
  }
  const double speed = w.norm();
  const double apart = speed > 0 ? (1 - kMargin) * left / speed : numeric::kInfinity;
  return numeric::AddRoundedDown(now, std::min(longest, apart));
}

}  // namespace collision::detection
