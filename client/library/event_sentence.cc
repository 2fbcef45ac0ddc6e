#include <algorithm>
#include <cmath>
#include <cstdio>

#include "collision/event_text.h"

namespace collision::client {
namespace {

constexpr int kInstantDecimals = 2;
constexpr int kInstantDecimalsMax = 9;

/// Writes about one event, as it looks at one time.
class Writer {
 public:
  Writer(const Event& event, std::int64_t now_ns, std::int64_t origin_ns)
      : event_(event), now_ns_(now_ns), origin_ns_(origin_ns) {}

  /// What follows the names of the two, without the full stop.
  std::string Text() const {
    switch (event_.status) {
      case EventStatus::kPossible:
        return Possible() + Expected();
      case EventStatus::kConfirmed:
        return Begin() + Place() + Speed() + End();
      case EventStatus::kDismissed:
        return Dismissed();
      case EventStatus::kUndecided:
        return Undecided();
      case EventStatus::kWithdrawn:
        return "could have touched" + From() + ", which is withdrawn" + Reason();
      case EventStatus::kEnded:
        return Begin() + Place() + Speed() + End() + Reason();
    }
    return "have an event of an unknown kind";
  }

 private:
  bool IsAhead(std::int64_t instant_ns) const { return instant_ns > now_ns_; }

  std::string At(std::int64_t instant_ns, int decimals, Rounding rounding) const {
    return InstantText(instant_ns, origin_ns_, decimals, rounding);
  }

  /// Not before this.
  std::string Earliest(std::int64_t instant_ns) const {
    return At(instant_ns, kInstantDecimals, Rounding::kDown);
  }
  /// Not after this.
  std::string Latest(std::int64_t instant_ns) const {
    return At(instant_ns, kInstantDecimals, Rounding::kUp);
  }

  /// "between 2.10 s and 2.11 s", with the decimals that tell its ends apart.
  std::string Between(const TimeBracket& bracket) const {
    if (bracket.earliest_ns >= bracket.latest_ns) {
      return "at " + At(bracket.latest_ns, kInstantDecimalsMax, Rounding::kUp);
    }
    int decimals = kInstantDecimals;
    for (std::int64_t unit = 10'000'000;
         unit > bracket.latest_ns - bracket.earliest_ns && decimals < kInstantDecimalsMax;
         unit /= 10) {
      ++decimals;
    }
    return "between " + At(bracket.earliest_ns, decimals, Rounding::kDown) + " and " +
           At(bracket.latest_ns, decimals, Rounding::kUp);
  }

  std::string From() const {
    if (event_.began_before) return ", perhaps since before one of them was known";
    return event_.begin.earliest_ns == kNever ? "" : " from " + Earliest(event_.begin.earliest_ns);
  }

  std::string Possible() const {
    const std::int64_t earliest_ns = event_.begin.earliest_ns;
    if (event_.began_before) return "could be touching" + From();
    if (earliest_ns == kNever) return "could touch at a time that is not known";
    if (IsAhead(earliest_ns)) return "could touch, but not before " + Earliest(earliest_ns);
    // A forecast is told anew only when it says something new: as far ahead as it was it still is.
    const std::string told = ", as last told at " + Earliest(event_.now_ns);
    if (earliest_ns <= event_.now_ns) return "could be touching" + told;
    return "could touch about " + SecondsText(earliest_ns, event_.now_ns, kInstantDecimals) +
           " s ahead" + told;
  }

  std::string Begin() const {
    const TimeBracket& begin = event_.begin;
    if (event_.began_before) {
      const std::string by =
          begin.latest_ns == kNever ? "" : "by " + Latest(begin.latest_ns) + ", ";
      return "touched " + by + "perhaps since before one of them was known";
    }
    if (begin.latest_ns == kNever) return "touch" + From() + " or later";
    const char* verb = IsAhead(begin.earliest_ns) ? "will touch " : "began to touch ";
    return verb + Between(begin);
  }

  std::string End() const {
    const TimeBracket& end = event_.end;
    if (end.latest_ns != kNever) {
      return std::string(", and ") + (IsAhead(end.earliest_ns) ? "will part " : "parted ") +
             Between(end);
    }
    if (event_.status == EventStatus::kEnded) return "; when they parted is not known";
    const bool lasts = event_.begin.latest_ns != kNever && end.earliest_ns != kNever &&
                       end.earliest_ns > event_.begin.latest_ns;
    if (!lasts) return "";
    return std::string(IsAhead(end.earliest_ns) ? ", and will still touch at "
                                                : ", and still touched at ") +
           Earliest(end.earliest_ns);
  }

  std::string Dismissed() const {
    const bool ahead = event_.begin.earliest_ns != kNever && IsAhead(event_.begin.earliest_ns);
    return std::string(ahead ? "will not touch" : "did not touch") + ", which had been possible" +
           From() + Passed();
  }

  /// What happens if both keep their motion.
  std::string Expected() const {
    if (!event_.expected) return "";
    const Expectation& expected = *event_.expected;
    const std::string kept = "; if both keep their motion, ";
    switch (expected.outcome) {
      case ExpectedOutcome::kTouch:
        return kept + "they touch " + Between(expected.begin);
      case ExpectedOutcome::kPass:
        return kept + "they stay " +
               (expected.closest ? Apart(*expected.closest) : std::string("apart")) + " up to " +
               Earliest(expected.until_ns);
      case ExpectedOutcome::kUndecided:
        return kept + "it is open whether they touch";
    }
    return "";
  }

  std::string Passed() const {
    if (!event_.closest || event_.closest->distance_upper_m <= 0) return "";
    return "; they came " + Nearest(*event_.closest) + ", " + Between(event_.closest->at);
  }

  /// "at least 1.99 m apart"
  static std::string Apart(const ClosestApproach& closest) {
    return "at least " + MetresText(std::max(0.0, closest.distance_lower_m), Rounding::kDown) +
           " m apart";
  }

  /// "as near as 1.99 to 2.01 m"
  static std::string Nearest(const ClosestApproach& closest) {
    return "as near as " + MetresText(std::max(0.0, closest.distance_lower_m), Rounding::kDown) +
           " to " + MetresText(closest.distance_upper_m, Rounding::kUp) + " m";
  }

  /// How fast they move against each other where they touch.
  std::string Speed() const {
    if (!event_.proximity || !event_.proximity->relative_velocity) return "";
    const Vector3& v = event_.proximity->relative_velocity->velocity_m_s;
    char text[64];
    std::snprintf(text, sizeof text, ", at %.3g m/s", std::hypot(v[0], v[1], v[2]));
    return text;
  }

  std::string Undecided() const {
    const TimeBracket span{event_.begin.earliest_ns, event_.end.latest_ns};
    std::string text = "may have touched";
    if (event_.began_before || span.latest_ns == kNever) {
      text += From();
      if (span.latest_ns != kNever) text += ", up to " + Latest(span.latest_ns);
    } else {
      text += " " + Between(span);
    }
    text += ": neither contact nor a gap could be certified";
    switch (event_.limited_by) {
      case EventLimit::kNone:
        return text;
      case EventLimit::kBudget:
        return text + ", for want of working time";
      case EventLimit::kMotion:
        return text + ", since their motion is not known well enough";
      case EventLimit::kGeometry:
        return text + ", since their shapes are not resolved well enough";
    }
    return text;
  }

  /// Of a common point, with the decimals that its error leaves.
  std::string Place() const {
    if (!event_.proximity || event_.proximity->separation_upper_m > 0) return "";
    const Proximity& proximity = *event_.proximity;
    constexpr int kDecimalsMax = 6;
    int decimals = 1;
    for (double unit = 0.1; unit > proximity.point_error_m && decimals < kDecimalsMax; unit /= 10) {
      ++decimals;
    }
    // An exact point needs no more digits than one that is known to a millimetre.
    if (proximity.point_error_m <= 0) decimals = 3;
    const double scale = std::pow(10, decimals);
    Vector3 p = proximity.point_m;
    for (double& x : p) x = std::round(x * scale) / scale + 0.0;  // -0 becomes 0.
    char text[1024];
    std::snprintf(text, sizeof text, ", at (%.*f, %.*f, %.*f) m", decimals, p[0], decimals, p[1],
                  decimals, p[2]);
    return text;
  }

  /// Why an agent of the pair is gone.
  std::string Reason() const {
    if (event_.because == "silent")
      return ", since the service removed a simulator that was silent";
    if (event_.because == "evicted") return ", since an operator evicted a simulator";
    if (event_.because == "restarted") return ", since time began anew";
    if (event_.because == "refused") return ", since the service refused a simulator";
    return event_.because == "left" ? ", since one of them left" : "";
  }

  const Event& event_;
  const std::int64_t now_ns_, origin_ns_;
};

std::string MarginText(const Event& event) {
  if (event.margin_m <= 0) return "";
  char text[64];
  std::snprintf(text, sizeof text, " (within %.6g m counts as touching", event.margin_m);
  return text + (event.level.empty() ? std::string(")") : ": level " + event.level + ")");
}

}  // namespace

std::string EventSentence(const Event& event, const AgentNamer& name, std::int64_t now_ns,
                          std::int64_t origin_ns) {
  return name(event.lower) + " and " + name(event.higher) + " " +
         Writer(event, now_ns, origin_ns).Text() + MarginText(event) + ".";
}

}  // namespace collision::client
