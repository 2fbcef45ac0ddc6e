// Checks distance, depth, point and normal of events against the bodies' true positions.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "client/checker/check.h"
#include "client/checker/instants.h"
#include "client/checker/motion/advancement.h"

namespace collision::checker {
namespace {

constexpr double kUnitTolerance = 1e-9;
constexpr double kNoDirection = 3.1415926;  // [rad] a normal with this error says nothing

std::string Format(const char* format, double x, double y = 0, double z = 0) {
  char text[160];
  std::snprintf(text, sizeof text, format, x, y, z);
  return text;
}

// Checks what is published about two bodies at one instant.
class Claim {
 public:
  Claim(const v1::CollisionEvent& event, const AgentMotion& a, const AgentMotion& b)
      : event_(event), a_(a.body()), b_(b.body()), balls_(a_.IsBall() && b_.IsBall()) {}

  // Returns the violation; empty if everything holds.
  std::string Complaint(const Piece& piece_a, const Piece& piece_b) const {
    const PairMotion motion(piece_a, piece_b, event_.evaluated_at_ns());
    const Pose pose = motion.At(0);
    // Instants are rounded to a nanosecond.
    const double tolerance =
        kLengthTolerance +
        static_cast<double>(motion.SpeedMax(0, 0, a_.reach(), b_.reach()) * 1e-9L * kRootTolerance);
    const std::string of_distance = OfDistance(pose, tolerance);
    return of_distance.empty() ? OfPoint(piece_a, piece_b, DistanceOf(a_, b_, pose), tolerance)
                               : of_distance;
  }

  std::string OfNormal() const {
    if (event_.normal_error_rad() >= kNoDirection) return "";
    const auto& n = event_.normal();
    const double length = std::hypot(n.x(), n.y(), n.z());
    if (std::fabs(length - 1) <= kUnitTolerance) return "";
    return Format("its normal has the length %.9g with an error of %.3g rad", length,
                  event_.normal_error_rad());
  }

 private:
  std::string OfDistance(const Pose& pose, double tolerance) const {
    const double lower = event_.separation_m().lower(), upper = event_.separation_m().upper();
    const double distance =
        balls_ ? Length(pose.p_AB) - a_.radius_m - b_.radius_m : DistanceOf(a_, b_, pose);
    const double most = balls_ ? upper : std::max(0.0, upper);
    if (!(lower - tolerance <= distance && distance <= most + tolerance))
      return Format("its separation is [%.9g, %.9g] m, but the true one %.9g m", lower, upper,
                    distance);
    const double claimed = std::max(event_.depth_lower_m(), -upper);
    if (!(claimed > tolerance)) return "";
    if (distance > tolerance)
      return Format("it is at least %.9g m deep, but the two are %.9g m apart", claimed, distance);
    const double depth = DepthAtMost(a_, b_, pose, pose.p_AB);
    if (claimed <= depth + tolerance) return "";
    return Format("it is at least %.9g m deep, but %.9g m part the two", claimed, depth);
  }

  // In contact a common point lies within the error; apart, the point half-way between the
  // surfaces.
  std::string OfPoint(const Piece& piece_a, const Piece& piece_b, double distance,
                      double tolerance) const {
    if (!std::isfinite(event_.point_error_m())) return "";
    const auto& p = event_.point_m();
    Piece point{event_.evaluated_at_ns(), event_.evaluated_at_ns(), {}};
    point.p_WA = {{{p.x()}, {p.y()}, {p.z()}}};
    const double allowed = event_.point_error_m() + distance / 2 + tolerance;
    for (const auto& [piece, body] : {std::pair{&piece_a, &a_}, std::pair{&piece_b, &b_}}) {
      const Pose seen = PairMotion(*piece, point, event_.evaluated_at_ns()).At(0);
      const double away = DistanceTo(*body, seen.p_AB);
      if (away <= allowed) continue;
      return Format("its point is %.9g m away from one of them, with an error of %.3g m", away,
                    event_.point_error_m());
    }
    return "";
  }

  const v1::CollisionEvent& event_;
  Body a_;
  Body b_;
  bool balls_;
};

bool SameClaim(const v1::CollisionEvent& x, const v1::CollisionEvent& y) {
  return x.evaluated_at_ns() == y.evaluated_at_ns() &&
         x.separation_m().lower() == y.separation_m().lower() &&
         x.separation_m().upper() == y.separation_m().upper() &&
         x.point_m().x() == y.point_m().x() && x.point_error_m() == y.point_error_m();
}

// Empty if the event holds for one of the pieces that it may refer to.
std::string ComplaintOf(const Evidence& evidence, const EventHistory& history,
                        const v1::CollisionEvent& event) {
  const std::int64_t at = event.evaluated_at_ns();
  const AgentMotion& a = evidence.motions()[history.a];
  const AgentMotion& b = evidence.motions()[history.b];
  if (at == std::numeric_limits<std::int64_t>::max()) return "";
  if (evidence.Changed(history.a, history.b, event.now_ns(), at)) return "";
  const Claim claim(event, a, b);
  std::string complaint = claim.OfNormal();
  if (!complaint.empty()) return complaint;
  for (const Piece* piece_a : PiecesAt(a, at)) {
    for (const Piece* piece_b : PiecesAt(b, at)) {
      complaint = claim.Complaint(*piece_a, *piece_b);
      if (complaint.empty()) return "";
    }
  }
  return complaint;
}

}  // namespace

Violations CheckGeometry(const Evidence& evidence) {
  Violations violations;
  for (const EventHistory& history : evidence.histories()) {
    const v1::CollisionEvent* before = nullptr;
    for (const v1::CollisionEvent& event : history.revisions) {
      if (violations.size() >= kRepeatsMax) return violations;
      const bool same = before != nullptr && SameClaim(event, *before);
      before = &event;
      if (same) continue;
      const std::string complaint = ComplaintOf(evidence, history, event);
      if (complaint.empty()) continue;
      violations.push_back(evidence.PairName(history.a, history.b) + ", evaluated at " +
                           evidence.Time(event.evaluated_at_ns()) + ": " + complaint);
      break;
    }
  }
  return violations;
}

}  // namespace collision::checker
