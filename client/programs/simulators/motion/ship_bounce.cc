#include "client/programs/simulators/motion/ship_bounce.h"

#include <algorithm>
#include <iterator>

namespace collision::client {
namespace {

constexpr double kOldestPoint = 0.5;  // [s] a point is not extrapolated further than this

Vector3 Unit(const Vector3& v) {
  const double length = Norm(v);
  return length > 0 ? Scaled(v, 1 / length) : Vector3{};
}

// The direction of the other ship if only the point is known; straight ahead without it.
Vector3 OutwardFromPoint(const Vector3& lever, const RigidState& own) {
  const Vector3 direction = Unit(lever);
  if (direction != Vector3{}) return direction;
  const Vector3 ahead = Unit(own.velocity_m_s);
  return ahead != Vector3{} ? ahead : Vector3{1, 0, 0};
}

}  // namespace

ShipContact ContactOf(const Event& event, bool lower, const RigidState& own, std::int64_t now_ns) {
  // Of a confirmed contact the point is known; without one nothing says where it is.
  if (!event.proximity) return {.point_m = own.position_m};
  const Proximity& proximity = *event.proximity;
  const double since = 1e-9 * static_cast<double>(now_ns - proximity.at_ns);
  const double taken = std::clamp(since, -kOldestPoint, kOldestPoint);
  ShipContact contact{.point_m = Sum(proximity.point_m, Scaled(own.velocity_m_s, taken))};
  if (proximity.normal && proximity.normal->error_rad <= kNormalErrorMax) {
    contact.outward = Scaled(Unit(proximity.normal->direction), lower ? 1 : -1);
  }
  return contact;
}

bool BounceOff(const ShipContact& contact, double radius_m, RigidState* own) {
  const Vector3 lever = AtMost(Difference(contact.point_m, own->position_m), radius_m);
  const bool known = contact.outward != Vector3{};
  const Vector3 n = known ? contact.outward : OutwardFromPoint(lever, *own);
  const Vector3 arm = Cross(lever, n);
  const double approach = Dot(own->velocity_m_s, n) + Dot(own->angular_velocity_rad_s, arm);
  if (approach <= 0 && Dot(own->velocity_m_s, n) <= -kSpeedApart) return false;
  if (approach > 0) {
    // An impulse j along −n changes v by j n / m and ω by j arm / I, with I = 2/5 m r². It reverses
    // the approach if j / m (1 + |arm|² m / I) = 2 approach.
    const double inertia = std::max(0.4 * radius_m * radius_m, 1e-12);
    const double push = 2 * approach / (1 + Dot(arm, arm) / inertia);
    own->velocity_m_s = Difference(own->velocity_m_s, Scaled(n, push));
    own->angular_velocity_rad_s =
        Difference(own->angular_velocity_rad_s, Scaled(arm, push / inertia));
  }
  const double lacking = Dot(own->velocity_m_s, n) + kSpeedApart;
  if (lacking > 0) own->velocity_m_s = Difference(own->velocity_m_s, Scaled(n, lacking));
  return true;
}

void ContactsToAnswer::Handle(const Event& event, const AgentId& own) {
  const bool lower = event.lower == own;
  if (!lower && event.higher != own) return;
  const AgentId& other = lower ? event.higher : event.lower;
  const auto found = pairs_.find(other);
  if (event.status == EventStatus::kConfirmed) {
    Pair& pair = found != pairs_.end() ? found->second : pairs_[other];
    pair.fresh = pair.fresh || found == pairs_.end() || pair.event.contact != event.contact;
    pair.event = event;
    pair.lower = lower;
    pair.lasts = true;
  } else if (found != pairs_.end() && event.contact == found->second.event.contact &&
             event.status != EventStatus::kPossible) {
    found->second.lasts = false;
  }
}

std::vector<ShipContact> ContactsToAnswer::Take(const RigidState& own, std::int64_t now_ns) {
  std::vector<ShipContact> due;
  for (auto at = pairs_.begin(); at != pairs_.end();) {
    Pair& pair = at->second;
    const bool rested = now_ns - pair.answered_ns >= kAnswerPeriod;
    if (rested && (pair.fresh || pair.lasts)) {
      due.push_back(ContactOf(pair.event, pair.lower, own, now_ns));
      // The normal of a lasting contact is that of its first touch, and does not lead out of it.
      if (!pair.fresh) due.back().outward = {};
      pair.answered_ns = now_ns;
    }
    pair.fresh = pair.fresh && !rested && pair.lasts;
    at = !pair.lasts && now_ns - pair.answered_ns >= kAnswerPeriod ? pairs_.erase(at)
                                                                   : std::next(at);
  }
  return due;
}

}  // namespace collision::client
