// Checks the crossings of levels against the distances of the bodies.
#include <cmath>
#include <cstdio>
#include <limits>

#include "client/checker/check.h"
#include "client/checker/instants.h"
#include "client/checker/motion/advancement.h"

namespace collision::checker {
namespace {

constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

/// Two bodies, and the distance that an event claims them to have on one side of.
class Crossing {
 public:
  Crossing(const Evidence& evidence, const v1::CollisionEvent& event, std::size_t a, std::size_t b)
      : evidence_(evidence), event_(event), a_(a), b_(b) {}

  /// Empty if the event holds.
  std::string Complaint() const {
    const v1::TimeBracket &begin = event_.begin(), &end = event_.end();
    std::string complaint = event_.began_before() ? "" : At(begin.earliest_ns(), Side::kOutside);
    if (complaint.empty()) complaint = At(begin.latest_ns(), Side::kInside);
    if (complaint.empty() && end.earliest_ns() != kNever) {
      complaint = At(end.earliest_ns(), Side::kInside);
    }
    if (complaint.empty()) complaint = At(end.latest_ns(), Side::kOutside);
    return complaint;
  }

 private:
  enum class Side { kInside, kOutside };

  std::string At(std::int64_t t_ns, Side side) const {
    if (t_ns == kNever || evidence_.Changed(a_, b_, event_.now_ns(), t_ns)) return "";
    const AgentMotion &a = evidence_.motions()[a_], &b = evidence_.motions()[b_];
    std::string complaint;
    for (const Piece* piece_a : PiecesAt(a, t_ns)) {
      for (const Piece* piece_b : PiecesAt(b, t_ns)) {
        complaint = At(PairMotion(*piece_a, *piece_b, t_ns), t_ns, side);
        if (complaint.empty()) return "";
      }
    }
    return complaint;
  }

  std::string At(const PairMotion& motion, std::int64_t t_ns, Side side) const {
    const Body a = evidence_.motions()[a_].body(), b = evidence_.motions()[b_].body();
    // Instants are rounded to a nanosecond.
    const double tolerance =
        kLengthTolerance +
        static_cast<double>(motion.SpeedMax(0, 0, a.reach(), b.reach()) * 1e-9L * kRootTolerance);
    const Pose pose = motion.At(0);
    const double distance = a.IsBall() && b.IsBall() ? Length(pose.p_AB) - a.radius_m - b.radius_m
                                                     : DistanceOf(a, b, pose);
    const double beyond = distance - event_.margin_m();
    if (side == Side::kInside ? beyond <= tolerance : beyond >= -tolerance) return "";
    char text[160];
    std::snprintf(text, sizeof text, ": the two are %.9g m apart, with a margin of %.9g m",
                  distance, event_.margin_m());
    return "at " + evidence_.Time(t_ns) + text;
  }

  const Evidence& evidence_;
  const v1::CollisionEvent& event_;
  const std::size_t a_, b_;
};

}  // namespace

Violations CheckLevels(const Evidence& evidence) {
  Violations violations;
  for (const v1::CollisionEvent& event : evidence.observations().events) {
    if (event.level().empty() || !IsConfirmed(event)) continue;
    if (violations.size() >= kRepeatsMax) return violations;
    const auto a = evidence.MotionOf(event.lower()), b = evidence.MotionOf(event.higher());
    if (!a || !b) continue;
    const std::string complaint = Crossing(evidence, event, *a, *b).Complaint();
    if (complaint.empty()) continue;
    violations.push_back(evidence.PairName(*a, *b) + ", level " + event.level() + ", " + complaint);
  }
  return violations;
}

}  // namespace collision::checker
