#include "collision/event_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace collision::client {
namespace {

constexpr std::size_t kPairColumns = 28;

constexpr std::int64_t kSecond = 1'000'000'000;  // [ns]
// Later instants belong to a wall clock: this is 1973, or three years of simulation.
constexpr std::int64_t kWallClock = 100'000'000 * kSecond;

std::string WithFraction(std::uint64_t whole, std::uint64_t fraction, int decimals) {
  if (decimals == 0) return std::to_string(whole);
  const std::string digits = std::to_string(fraction);
  return std::to_string(whole) + "." + std::string(decimals - digits.size(), '0') + digits;
}

/// Nanoseconds of one unit in the last of `decimals` decimals of a second.
std::int64_t Unit(int decimals) {
  std::int64_t unit = kSecond;
  for (int i = 0; i < decimals; ++i) unit /= 10;
  return unit;
}

/// The difference of two instants in units; it needs 65 bits before it is divided.
__int128 Units(std::int64_t instant_ns, std::int64_t origin_ns, std::int64_t unit,
               Rounding rounding) {
  const __int128 difference = static_cast<__int128>(instant_ns) - origin_ns;
  const __int128 units = difference / unit;
  if (units * unit == difference) return units;
  if (rounding == Rounding::kUp && difference > 0) return units + 1;
  return rounding == Rounding::kDown && difference < 0 ? units - 1 : units;
}

std::string LatestText(std::int64_t instant_ns, std::int64_t origin_ns) {
  return instant_ns == kNever ? "open" : TimeText(instant_ns, origin_ns, 6, Rounding::kUp);
}

std::string BracketText(std::int64_t earliest_ns, std::int64_t latest_ns, std::int64_t origin_ns) {
  return "[" + TimeText(earliest_ns, origin_ns, 6) + ", " + LatestText(latest_ns, origin_ns) + "]";
}

/// A contact that may be older than the pair has no known earliest begin.
std::string BeginText(const Event& event, std::int64_t origin_ns) {
  const TimeBracket& begin = event.begin;
  if (!event.began_before) return BracketText(begin.earliest_ns, begin.latest_ns, origin_ns);
  const std::string latest = LatestText(begin.latest_ns, origin_ns);
  return (begin.latest_ns == kNever ? latest : "≤ " + latest) + " (began before)";
}

/// An end without a latest time tells how long the contact certainly lasts, if that is known.
std::string EndText(const Event& event, std::int64_t origin_ns) {
  const TimeBracket& end = event.end;
  if (end.latest_ns != kNever) return BracketText(end.earliest_ns, end.latest_ns, origin_ns);
  const bool known_to_last = event.begin.latest_ns != kNever && end.earliest_ns != kNever &&
                             end.earliest_ns > event.begin.latest_ns;
  return known_to_last ? "≥ " + TimeText(end.earliest_ns, origin_ns, 6) : "open";
}

/// An undecided pair may not have touched at all: it has neither begin nor end.
std::string WhenText(const Event& event, std::int64_t origin_ns) {
  if (event.status != EventStatus::kUndecided) {
    return "begin " + BeginText(event, origin_ns) + "  end " + EndText(event, origin_ns);
  }
  return "not certified free in " +
         BracketText(event.begin.earliest_ns, event.end.latest_ns, origin_ns) +
         (event.began_before ? " (began before)" : "");
}

constexpr double kDegrees = 57.29577951308233;        // of a radian, rounded up
constexpr double kHalfDiagonal = 0.8660254037844387;  // of a cube of side 1, rounded up
constexpr int kDecimalsMax = 9;

std::string VectorText(const Vector3& vector, int decimals) {
  char text[128];
  std::snprintf(text, sizeof text, "(%.*f, %.*f, %.*f)", decimals, vector[0] + 0.0, decimals,
                vector[1] + 0.0, decimals, vector[2] + 0.0);
  return text;
}

/// With as many decimals as make sense for the error; the rounding of the digits adds to the error.
std::string PointText(const Proximity& proximity) {
  double unit = 1;
  int decimals = 0;
  for (; decimals < kDecimalsMax && unit > proximity.point_error_m / 10; ++decimals) unit /= 10;
  return "  at " + VectorText(proximity.point_m, decimals) + " ± " +
         MetresText(proximity.point_error_m + kHalfDiagonal * unit, Rounding::kUp) + " m";
}

std::string NormalText(const Proximity& proximity) {
  if (!proximity.normal) return "";
  const double degrees = proximity.normal->error_rad * kDegrees;
  // Three decimals turn a unit vector by less than 0.05 degrees.
  return "  normal " + VectorText(proximity.normal->direction, 3) + " ± " +
         MetresText(degrees + 0.05, Rounding::kUp) + "°";
}

std::string LimitText(const Event& event) {
  if (event.limited_by == EventLimit::kNone) return "";
  return std::string(", limited by ") + Name(event.limited_by);
}

/// A ball has no parts.
std::string PartsText(const Proximity& proximity) {
  if (!proximity.lower_part && !proximity.higher_part) return "";
  const auto text = [](const std::optional<std::uint32_t>& part) {
    return part ? std::to_string(*part) : std::string("ball");
  };
  return "  parts " + text(proximity.lower_part) + " × " + text(proximity.higher_part);
}

/// What the sphere trees tell about two shapes. For balls the gap says everything.
std::string ShapesText(const Event& event, const Proximity& proximity) {
  std::string text;
  if (proximity.separation_upper_m <= 0) {
    if (proximity.depth_lower_m > 0) {
      text += "  depth ≥ " + MetresText(proximity.depth_lower_m, Rounding::kDown) + " m";
    }
    text += PointText(proximity) + NormalText(proximity) + PartsText(proximity);
  }
  text += "  tree level " + std::to_string(event.tree_level) + ", " +
          std::to_string(event.work_units) + " units";
  return text + LimitText(event);
}

std::string BetweenText(double lower, double upper, const std::string& unit = "m") {
  return "[" + MetresText(lower, Rounding::kDown) + ", " + MetresText(upper, Rounding::kUp) + "] " +
         unit;
}

std::string GapText(const Event& event) {
  if (!event.proximity) return "";
  const Proximity& proximity = *event.proximity;
  const std::string between =
      "  gap " + BetweenText(proximity.separation_lower_m, proximity.separation_upper_m);
  if (event.tree_level > 0) return between + ShapesText(event, proximity);
  if (proximity.separation_upper_m <= 0) {
    return "  gap ≤ " + MetresText(proximity.separation_upper_m, Rounding::kUp) + " m";
  }
  // Balls are limited by motion alone. Another limit tells of shapes that were not evaluated, or
  // whose trees are not built yet.
  const bool names_limit =
      event.limited_by == EventLimit::kBudget || event.limited_by == EventLimit::kGeometry;
  return between + (names_limit ? LimitText(event) : "");
}

/// How fast the two move against each other where they touch.
std::string SpeedText(const Event& event) {
  if (!event.proximity || !event.proximity->relative_velocity) return "";
  const RelativeVelocity& relative = *event.proximity->relative_velocity;
  const Vector3& v = relative.velocity_m_s;
  const double speed = std::hypot(v[0], v[1], v[2]);
  return "  relative speed " +
         BetweenText(std::max(0.0, speed - relative.error_m_s), speed + relative.error_m_s, "m/s");
}

std::string PassText(const ClosestApproach& closest, std::int64_t origin_ns) {
  return BetweenText(closest.distance_lower_m, closest.distance_upper_m) + " in " +
         BracketText(closest.at.earliest_ns, closest.at.latest_ns, origin_ns);
}

std::string ExpectedText(const Event& event, std::int64_t origin_ns) {
  if (!event.expected) return "";
  const Expectation& expected = *event.expected;
  switch (expected.outcome) {
    case ExpectedOutcome::kTouch:
      return "  expected to touch in " +
             BracketText(expected.begin.earliest_ns, expected.begin.latest_ns, origin_ns);
    case ExpectedOutcome::kPass:
      return "  expected to pass" +
             (expected.closest ? " at " + PassText(*expected.closest, origin_ns) : "");
    case ExpectedOutcome::kUndecided:
      return "  expected: undecided";
  }
  return "";
}

std::string ClosestText(const Event& event, std::int64_t origin_ns) {
  if (event.status != EventStatus::kDismissed || !event.closest) return "";
  return "  passed at " + PassText(*event.closest, origin_ns);
}

}  // namespace

std::string MetresText(double value, Rounding rounding) {
  if (value != 0 && std::isfinite(value)) {
    const double unit = std::pow(10, std::floor(std::log10(std::abs(value))) - 2);
    value = (rounding == Rounding::kUp ? std::ceil(value / unit) : std::floor(value / unit)) * unit;
  }
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value + 0.0);  // -0 becomes 0.
  return text;
}

std::string Padded(std::string text, std::size_t columns) {
  const auto width = static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
  if (width < columns) text.append(columns - width, ' ');
  return text;
}

std::string SecondsText(std::int64_t instant_ns, std::int64_t origin_ns, int decimals,
                        Rounding rounding) {
  if (instant_ns == kNever) return "never";
  const std::int64_t unit = Unit(decimals);
  const __int128 units = Units(instant_ns, origin_ns, unit, rounding);
  const std::uint64_t per_second = kSecond / unit;
  const auto magnitude = static_cast<std::uint64_t>(units < 0 ? -units : units);
  return (units < 0 ? "-" : "") +
         WithFraction(magnitude / per_second, magnitude % per_second, decimals);
}

bool IsTimeOfDay(std::int64_t instant_ns, std::int64_t origin_ns) {
  return origin_ns == 0 && instant_ns > kWallClock && instant_ns != kNever;
}

std::string TimeText(std::int64_t instant_ns, std::int64_t origin_ns, int decimals,
                     Rounding rounding) {
  if (!IsTimeOfDay(instant_ns, origin_ns)) {
    return SecondsText(instant_ns, origin_ns, decimals, rounding);
  }
  const std::int64_t unit = Unit(decimals);
  const std::uint64_t per_second = kSecond / unit;
  const auto units = static_cast<std::uint64_t>(Units(instant_ns, 0, unit, rounding));
  const std::uint64_t seconds = units / per_second % 86400;
  char minutes[16];
  std::snprintf(minutes, sizeof minutes, "%02d:%02d:", static_cast<int>(seconds / 3600),
                static_cast<int>(seconds / 60 % 60));
  return minutes + std::string(seconds % 60 < 10 ? "0" : "") +
         WithFraction(seconds % 60, units % per_second, decimals);
}

std::string InstantText(std::int64_t instant_ns, std::int64_t origin_ns, int decimals,
                        Rounding rounding) {
  std::string text = TimeText(instant_ns, origin_ns, decimals, rounding);
  if (instant_ns == kNever) return text;
  return text + (IsTimeOfDay(instant_ns, origin_ns) ? " UTC" : " s");
}

std::string EventLine(const Event& event, const AgentNamer& name, std::int64_t origin_ns) {
  char head[64];
  std::snprintf(head, sizeof head, "%13s  %-9s  ", InstantText(event.now_ns, origin_ns, 3).c_str(),
                Name(event.status));
  return head + Padded(name(event.lower) + " × " + name(event.higher), kPairColumns) + "  #" +
         std::to_string(event.contact) + " r" + std::to_string(event.revision) + "  " +
         (event.hypothetical ? "hypothetical  " : "") +
         (event.level.empty() ? "" : "level " + event.level + "  ") + WhenText(event, origin_ns) +
         GapText(event) + SpeedText(event) + ExpectedText(event, origin_ns) +
         ClosestText(event, origin_ns) +
         (event.because.empty() ? "" : "  because " + event.because);
}

}  // namespace collision::client
