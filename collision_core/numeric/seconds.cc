#include "collision_core/numeric/seconds.h"

#include "collision_core/base/check.h"

namespace collision::numeric {
namespace {

/// More seconds than lie between any two instants.
constexpr double kSecondsMax = 2e10;

enum class Rounding { kDown, kUp };

/// `from + seconds`, saturated and rounded to a whole nanosecond.
Instant Add(Instant from, double seconds, Rounding rounding) {
  CORE_CHECK(!std::isnan(seconds), "a time is a number");
  const bool up = rounding == Rounding::kUp;
  if (seconds == 0 || from == Instant::Never() || from == Instant::Always()) return from;
  if (seconds > kSecondsMax) return Instant::Never();
  if (seconds < -kSecondsMax) return Instant::Always();
  const double whole = std::trunc(seconds);
  const double fraction = seconds - whole;  // Exact, like the whole part.
  const double product = fraction * kNanosecondsPerSecond;
  const double error = std::fma(fraction, kNanosecondsPerSecond, -product);
  // A whole number is a double, so the rounded product lies on the exact one's side of it, or on
  // it.
  auto rest = static_cast<std::int64_t>(up ? std::ceil(product) : std::floor(product));
  if (product == std::floor(product)) rest += up ? error > 0 : -(error < 0);
  const __int128 ns =
      static_cast<__int128>(whole) * kNanosecondsPerSecond + rest + from.nanoseconds();
  if (ns >= Instant::Never().nanoseconds()) return Instant::Never();
  if (ns <= Instant::Always().nanoseconds()) return Instant::Always();
  return Instant::FromNanoseconds(static_cast<std::int64_t>(ns));
}

}  // namespace

Interval SecondsBetween(Instant from, Instant to) {
  // Up to three months a double holds the nanoseconds exactly.
  constexpr std::int64_t kExactMax = std::int64_t{1} << 53;
  std::int64_t ns;
  if (!__builtin_sub_overflow(to.nanoseconds(), from.nanoseconds(), &ns) && ns <= kExactMax &&
      ns >= -kExactMax) {
    return Interval(static_cast<double>(ns)) / Interval(kNanosecondsPerSecond);
  }
  // Seconds and nanoseconds apart, so that nothing overflows; of one sign, so that nothing cancels.
  std::int64_t seconds =
      to.nanoseconds() / kNanosecondsPerSecond - from.nanoseconds() / kNanosecondsPerSecond;
  std::int64_t rest =
      to.nanoseconds() % kNanosecondsPerSecond - from.nanoseconds() % kNanosecondsPerSecond;
  seconds += rest / kNanosecondsPerSecond;
  rest %= kNanosecondsPerSecond;
  if (seconds > 0 && rest < 0) --seconds, rest += kNanosecondsPerSecond;
  if (seconds < 0 && rest > 0) ++seconds, rest -= kNanosecondsPerSecond;
  return Interval(static_cast<double>(seconds)) +
         Interval(static_cast<double>(rest)) / Interval(kNanosecondsPerSecond);
}

Instant AddRoundedDown(Instant from, double seconds) { return Add(from, seconds, Rounding::kDown); }

Instant AddRoundedUp(Instant from, double seconds) { return Add(from, seconds, Rounding::kUp); }

}  // namespace collision::numeric
