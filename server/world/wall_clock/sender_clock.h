// How far the clock of one sender is off, and whether that is too far.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "collision_core/base/instant.h"

namespace collision::server {

/// Two clocks drift apart by at most this: both slewed at the limit of 500 ppm, in opposite
/// directions.
inline constexpr std::int64_t kDriftPerSecondNs = 1'000'000;

/// A refused sender is taken again when its offset may be within this share of the bound, so that
/// one that is beyond it by a hair is not refused and taken in turns.
inline constexpr double kTakenWithin = 0.75;

/// A closed interval of offsets [ns]: the sender's clock less the service's.
struct OffsetBracket {
  static constexpr std::int64_t kNoLower = std::numeric_limits<std::int64_t>::min();
  static constexpr std::int64_t kNoUpper = std::numeric_limits<std::int64_t>::max();

  std::int64_t lower_ns = kNoLower;
  std::int64_t upper_ns = kNoUpper;

  bool has_lower() const { return lower_ns != kNoLower; }
  bool has_upper() const { return upper_ns != kNoUpper; }
  friend bool operator==(const OffsetBracket&, const OffsetBracket&) = default;
};

/// The four instants of a round trip: the service asks with each of its samples, and the sender
/// answers with each of its clocks.
struct RoundTrip {
  std::optional<Instant> asked;  ///< t1: `now` of the sample, by the service's clock.
  Instant heard;                 ///< t2: when the sender heard it, by its clock.
  Instant answered;              ///< t3: when its answer left, by its clock.
  Instant arrived;               ///< t4: not before the answer arrived, by the service's clock.
};

/// What is certain about the offset θ of one sender.
///
/// The answer left before it arrived, and the sample was heard after it was published, so θ lies in
/// [t3 − t4, t2 − t1], the upper end widened by what drifts apart from t1 to t4. This needs no
/// assumption about the ways there and back; only their sum makes the interval wide, and so does
/// the time that a message waits for the service's step. A trip without `asked` gives the lower end
/// alone.
///
/// What one trip has proved holds later, less kDriftPerSecondNs of the time since. All bounds widen
/// at that rate, so the best one stays the best, and one per side is all that is kept. A trip that
/// contradicts them shows that the sender's clock was set: then only that trip counts. One thread.
class ClockOffset {
 public:
  /// `monotonic_ns`: never goes back from call to call.
  void Take(const RoundTrip& trip, std::int64_t monotonic_ns);

  /// The service's clock was set: what was measured before does not count.
  void Forget() { *this = ClockOffset(); }

  OffsetBracket At(std::int64_t monotonic_ns) const;

 private:
  OffsetBracket best_;
  std::int64_t lower_at_ns_ = 0;  ///< Monotonic: when each end was measured.
  std::int64_t upper_at_ns_ = 0;
};

/// What has changed with a round trip.
enum class SenderVerdict { kUnchanged, kRefused, kTaken };

/// Whether one sender may speak: it is refused while its offset is certainly beyond the bound κ.
/// One thread.
class SenderClock {
 public:
  SenderVerdict Take(const RoundTrip& trip, std::int64_t monotonic_ns, std::int64_t skew_max_ns);

  /// See ClockOffset. A refused sender stays refused until it has answered again.
  void Forget() { offset_.Forget(); }

  bool refused() const { return refused_; }
  OffsetBracket offset(std::int64_t monotonic_ns) const { return offset_.At(monotonic_ns); }

  /// The service's time up to which the sender was last certain to be within the bound; Always():
  /// it never was.
  Instant within_until() const { return within_until_; }

 private:
  bool MayBeTaken(const OffsetBracket& offset, std::int64_t skew_max_ns) const;

  ClockOffset offset_;
  bool refused_ = false;
  bool behind_ = false;  ///< If refused: its clock was behind.
  Instant within_until_ = Instant::Always();
};

/// The offset in words: "1.2 to 3.4 ms ahead", "at least 5.0 ms ahead".
std::string OffsetText(const OffsetBracket& offset);

/// The least bound that is certain to admit this offset, in whole milliseconds [s]; of an end that
/// is not known nothing is asked.
double SufficientSkew(const OffsetBracket& offset);

}  // namespace collision::server
