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

std::string Format(const char* format, double x, double y = 0, double z = 0) {
  char text[160];
  std::snprintf(text, sizeof text, format, x, y, z);
  return text;
}

// Checks what is published about two bodies at one instant.
class Claim {
 public:
  Claim(const v1::CollisionEvent& event, const AgentMotion& a, const AgentMotion& b)
      : proximity_(event.proximity()),
        a_(a.body()),
        b_(b.body()),
        balls_(a_.IsBall() && b_.IsBall()) {}

  // Returns the violation; empty if everything holds.
  std::string Complaint(const Piece& piece_a, const Piece& piece_b) const {
    const PairMotion motion(piece_a, piece_b, proximity_.at_ns());
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
    if (!proximity_.has_normal()) return "";
    const auto& n = proximity_.normal().direction();
    const double length = std::hypot(n.x(), n.y(), n.z());
    if (std::fabs(length - 1) <= kUnitTolerance) return "";
    return Format("its normal has the length %.9g with an error of %.3g rad", length,
                  proximity_.normal().error_rad());
  }

 private:
  std::string OfDistance(const Pose& pose, double tolerance) const {
    const double lower = proximity_.separation_m().lower();
    const double upper = proximity_.separation_m().upper();
    const double distance =
        balls_ ? Length(pose.p_AB) - a_.reach() - b_.reach() : DistanceOf(a_, b_, pose);
    const double most = balls_ ? upper : std::max(0.0, upper);
    if (!(lower - tolerance <= distance && distance <= most + tolerance))
      return Format("its separation is [%.9g, %.9g] m, but the true one %.9g m", lower, upper,
                    distance);
    const double claimed = std::max(proximity_.depth_lower_m(), -upper);
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
    if (!std::isfinite(proximity_.point_error_m())) return "";
    const auto& p = proximity_.point_m();
    Piece point{proximity_.at_ns(), proximity_.at_ns(), {}};
    point.p_WA = {{{p.x()}, {p.y()}, {p.z()}}};
    const double allowed = proximity_.point_error_m() + distance / 2 + tolerance;
    for (const auto& [piece, body] : {std::pair{&piece_a, &a_}, std::pair{&piece_b, &b_}}) {
      const Pose seen = PairMotion(*piece, point, proximity_.at_ns()).At(0);
      const double away = DistanceTo(*body, seen.p_AB);
      if (away <= allowed) continue;
      return Format("its point is %.9g m away from one of them, with an error of %.3g m", away,
                    proximity_.point_error_m());
    }
    return "";
  }

  const v1::PairProximity& proximity_;
  Body a_;
  Body b_;
  bool balls_;
};

bool SameClaim(const v1::CollisionEvent& event, const v1::CollisionEvent& other) {
  const v1::PairProximity &x = event.proximity(), &y = other.proximity();
  return x.at_ns() == y.at_ns() && x.separation_m().lower() == y.separation_m().lower() &&
         x.separation_m().upper() == y.separation_m().upper() &&
         x.point_m().x() == y.point_m().x() && x.point_error_m() == y.point_error_m();
}

// Empty if the event holds for one of the pieces that it may refer to.
std::string ComplaintOf(const Evidence& evidence, const EventHistory& history,
                        const v1::CollisionEvent& event) {
  const std::int64_t at = event.proximity().at_ns();
  const AgentMotion& a = evidence.motions()[history.a];
  const AgentMotion& b = evidence.motions()[history.b];
  if (!event.has_proximity()) return "";
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
  return "evaluated at " + evidence.Time(at) + ": " + complaint;
}

// Instants of a span at which its closest approach is compared with the truth. Between two of them
// the two come nearer by no more than twice the greatest speed that they have at any.
constexpr int kInstantsOfBalls = 64, kInstantsOfShapes = 8;

// The true distances of a pair at some instants.
class Approach {
 public:
  Approach(const AgentMotion& a, const AgentMotion& b)
      : motion_a_(a), motion_b_(b), a_(a.body()), b_(b.body()) {}

  bool balls() const { return a_.IsBall() && b_.IsBall(); }
  double fastest() const { return fastest_; }

  // The least one at an instant, of a jump before and after it.
  double At(std::int64_t t_ns) {
    double least = std::numeric_limits<double>::infinity();
    for (const Piece* piece_a : PiecesAt(motion_a_, t_ns)) {
      for (const Piece* piece_b : PiecesAt(motion_b_, t_ns)) {
        const PairMotion motion(*piece_a, *piece_b, t_ns);
        fastest_ =
            std::max(fastest_, static_cast<double>(motion.SpeedMax(0, 0, a_.reach(), b_.reach())));
        const Pose pose = motion.At(0);
        least = std::min(least, balls() ? Length(pose.p_AB) - a_.reach() - b_.reach()
                                        : DistanceOf(a_, b_, pose));
      }
    }
    return least;
  }

 private:
  const AgentMotion& motion_a_;
  const AgentMotion& motion_b_;
  Body a_, b_;
  double fastest_ = 0;
};

// Empty if the closest approach of an event that is over holds.
std::string ComplaintOfClosest(const Evidence& evidence, const EventHistory& history,
                               const v1::CollisionEvent& event) {
  const bool over = event.status() == v1::EVENT_DISMISSED || event.status() == v1::EVENT_ENDED;
  if (!over || !event.has_closest()) return "";
  const v1::ClosestApproach& closest = event.closest();
  const std::int64_t from = closest.from_ns(), span = closest.until_ns() - from;
  if (evidence.Changed(history.a, history.b, from, closest.until_ns())) return "";
  Approach approach(evidence.motions()[history.a], evidence.motions()[history.b]);
  const int instants = approach.balls() ? kInstantsOfBalls : kInstantsOfShapes;
  double least = std::numeric_limits<double>::infinity(), least_in_time = least;
  const auto look = [&](std::int64_t t_ns) {
    const double distance = approach.At(t_ns);
    least = std::min(least, distance);
    const bool in_time = closest.at().earliest_ns() <= t_ns && t_ns <= closest.at().latest_ns();
    if (in_time) least_in_time = std::min(least_in_time, distance);
  };
  for (int i = 0; i <= instants; ++i) {
    look(from + static_cast<std::int64_t>(static_cast<long double>(span) * i / instants));
  }
  look(closest.at().earliest_ns());
  look(closest.at().latest_ns());
  const double tolerance = kLengthTolerance + approach.fastest() * 1e-9;
  const double between = 2 * approach.fastest() * static_cast<double>(span) * 1e-9 / instants;
  const double lower = closest.distance_m().lower(), upper = closest.distance_m().upper();
  if (least < lower - tolerance) {
    return Format("its closest approach is at least %.9g m, but once it is %.9g m", lower, least);
  }
  const double most = approach.balls() ? upper : std::max(0.0, upper);
  if (least - between > most + tolerance) {
    return Format("its closest approach is at most %.9g m, but they stay %.9g m apart", most,
                  least - between);
  }
  if (least_in_time - between <= least + tolerance) return "";
  return Format("they are %.9g m apart, nearer than while they are said to be nearest (%.9g m)",
                least, least_in_time);
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
      std::string complaint = same ? "" : ComplaintOf(evidence, history, event);
      if (complaint.empty()) complaint = ComplaintOfClosest(evidence, history, event);
      if (complaint.empty()) continue;
      violations.push_back(evidence.PairName(history.a, history.b) + ", " + complaint);
      break;
    }
  }
  return violations;
}

}  // namespace collision::checker
