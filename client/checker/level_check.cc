// Checks the crossings of levels against the distances of the bodies.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>

#include "client/checker/check.h"
#include "client/checker/instants.h"
#include "client/checker/motion/advancement.h"

namespace collision::checker {
namespace {

constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

/// Two bodies, and on which side of the margin an event claims them to be.
class Crossing {
 public:
  /// `level`: the evidence about the event's level.
  Crossing(const Evidence& level, const EventHistory& history, const v1::CollisionEvent& event)
      : level_(level), event_(event), a_(history.a), b_(history.b) {}

  /// Empty if the event holds.
  std::string Complaint() const {
    const v1::TimeBracket &begin = event_.begin(), &end = event_.end();
    std::string complaint = OfMargin();
    if (complaint.empty() && !event_.began_before()) {
      complaint = At(begin.earliest_ns(), Side::kOutside);
    }
    if (complaint.empty()) complaint = At(begin.latest_ns(), Side::kInside);
    if (complaint.empty() && end.earliest_ns() != kNever) {
      complaint = At(end.earliest_ns(), Side::kInside);
    }
    // Who has left need not have parted.
    if (complaint.empty() && !level_.MayHaveLeft(a_, b_, end.latest_ns())) {
      complaint = At(end.latest_ns(), Side::kOutside);
    }
    return complaint;
  }

 private:
  enum class Side { kInside, kOutside };

  double margin() const { return level_.motions()[a_].margin_m + level_.motions()[b_].margin_m; }

  std::string OfMargin() const {
    if (std::fabs(event_.margin_m() - margin()) <= kLengthTolerance) return "";
    char text[120];
    std::snprintf(text, sizeof text, "told with a margin of %.9g m, but it is %.9g m",
                  event_.margin_m(), margin());
    return text;
  }

  std::string At(std::int64_t t_ns, Side side) const {
    if (t_ns == kNever || level_.Changed(a_, b_, event_.now_ns(), t_ns)) return "";
    const AgentMotion &a = level_.motions()[a_], &b = level_.motions()[b_];
    std::string complaint;
    for (const Piece* piece_a : PiecesAt(a, t_ns)) {
      for (const Piece* piece_b : PiecesAt(b, t_ns)) {
        complaint = At(PairMotion(*piece_a, *piece_b, t_ns), t_ns, side);
        if (complaint.empty()) return "";
      }
    }
    return complaint;
  }

  // The distance of the bodies without their margins: grown ones have none inside each other.
  std::string At(const PairMotion& motion, std::int64_t t_ns, Side side) const {
    Body a = level_.motions()[a_].body(), b = level_.motions()[b_].body();
    a.grown_m = b.grown_m = 0;
    // Instants are rounded to a nanosecond.
    const double tolerance =
        kLengthTolerance +
        static_cast<double>(motion.SpeedMax(0, 0, a.reach(), b.reach()) * 1e-9L * kRootTolerance);
    const Pose pose = motion.At(0);
    const double distance = a.IsBall() && b.IsBall() ? Length(pose.p_AB) - a.radius_m - b.radius_m
                                                     : DistanceOf(a, b, pose);
    const double beyond = distance - margin();
    if (side == Side::kInside ? beyond <= tolerance : beyond >= -tolerance) return "";
    char text[160];
    std::snprintf(text, sizeof text, ": the two are %.9g m apart, with a margin of %.9g m",
                  distance, margin());
    return "at " + level_.Time(t_ns) + text;
  }

  const Evidence& level_;
  const v1::CollisionEvent& event_;
  const std::size_t a_, b_;
};

Violations CheckBrackets(const Evidence& level) {
  Violations violations;
  for (const EventHistory& history : level.histories()) {
    for (const v1::CollisionEvent& event : history.revisions) {
      if (violations.size() >= kRepeatsMax) return violations;
      if (!IsConfirmed(event)) continue;
      const std::string complaint = Crossing(level, history, event).Complaint();
      if (complaint.empty()) continue;
      violations.push_back(level.PairName(history.a, history.b) + ", " + complaint);
      break;
    }
  }
  return violations;
}

// The visits (level_visits.h) in which the crossing that is told may have begun.
std::set<std::size_t> VisitsOf(const Evidence& level, const EventHistory& history) {
  std::set<std::size_t> visits;
  const v1::TimeBracket& begin = history.last().begin();
  for (const TrueContact* crossing : level.ContactsOf(history.a)) {
    if (crossing->a == history.a && crossing->b == history.b &&
        begin.earliest_ns() <= crossing->begin_ns + crossing->begin_tolerance_ns &&
        crossing->begin_ns - crossing->begin_tolerance_ns <= begin.latest_ns()) {
      visits.insert(crossing->visit);
    }
  }
  return visits;
}

// Whether both are of the same two agents and of one service: another one knows nothing of what
// this one told.
bool OfOnePair(const v1::CollisionEvent& event, const v1::CollisionEvent& other) {
  const auto same = [](const v1::AgentId& a, const v1::AgentId& b) {
    return a.simulator_id() == b.simulator_id() && a.run() == b.run() && a.slot() == b.slot() &&
           a.generation() == b.generation();
  };
  return same(event.lower(), other.lower()) && same(event.higher(), other.higher()) &&
         event.stamp().service_id() == other.stamp().service_id();
}

// Of each visit one crossing is told; and those that began before the pair was known, or jumped.
Violations CheckHysteresis(const Evidence& level) {
  Violations violations;
  if (!(level.level()->hysteresis_m() > 0)) return violations;
  for (const EventHistory& history : level.histories()) {
    const v1::CollisionEvent& event = history.last();
    if (!IsConfirmed(event) || event.began_before()) continue;
    const std::set<std::size_t> visits = VisitsOf(level, history);
    for (const EventHistory* other : level.HistoriesOf(history.a, history.b)) {
      const v1::CollisionEvent& before = other->last();
      if (violations.size() >= kRepeatsMax) return violations;
      if (!IsConfirmed(before) || !OfOnePair(event, before) ||
          before.begin().latest_ns() >= event.begin().latest_ns() || visits.size() != 1 ||
          VisitsOf(level, *other) != visits) {
        continue;
      }
      violations.push_back(level.PairName(history.a, history.b) + ": the crossing that began by " +
                           level.Time(event.begin().latest_ns()) +
                           " was told, but the two stayed within margin and hysteresis since " +
                           level.Time(before.begin().latest_ns()));
      break;
    }
  }
  return violations;
}

// Events of levels that the configuration does not have.
Violations CheckNames(const Evidence& evidence) {
  std::set<std::string> unknown;
  for (const v1::CollisionEvent& event : evidence.observations().events) {
    if (!event.level().empty()) unknown.insert(event.level());
  }
  for (const Evidence& level : evidence.levels()) unknown.erase(level.level()->name());
  Violations violations;
  for (const std::string& name : unknown) {
    violations.push_back("events of level " + name + ", which is not configured");
  }
  return violations;
}

}  // namespace

Violations CheckLevels(const Evidence& evidence) {
  Violations violations = CheckNames(evidence);
  for (const Evidence& level : evidence.levels()) {
    for (const Violations& more :
         {CheckEvents(level), CheckGeometry(level), CheckBrackets(level), CheckHysteresis(level)}) {
      violations.insert(violations.end(), more.begin(), more.end());
    }
  }
  return violations;
}

}  // namespace collision::checker
