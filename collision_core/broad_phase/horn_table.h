// All agents' bounds by index, and the short form of each that filters read.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "collision_core/broad_phase/query.h"

namespace collision {

/// A horn in plain doubles, rounded outward: at τ >= 0 after its stamp the agent lies within
/// u0 + u1 τ + u2 τ² of p + v τ, whatever direction, expiry or speed cap say beyond.
struct HornRow {
  double p[3];
  double v[3];
  double u0, u1, u2;
  Instant stamp;
  std::uint32_t group = 0;  ///< 0: no such agent.
  std::uint32_t mask = 0;
  bool still = false;  ///< NeverMoves().
  bool wild = false;   ///< Too large or too far for filters: to be asked directly.
};

/// The same from an instant on: at x >= 0 after it within s0 + s1 x + s2 x² of c + v x.
struct HornAt {
  double c[3];
  double v[3];
  double s0, s1, s2;
};

class HornTable {
 public:
  void Put(std::uint32_t agent, const SpaceTimeBound& bound);
  void Remove(std::uint32_t agent);

  /// One more than the greatest index ever used.
  std::uint32_t size() const { return static_cast<std::uint32_t>(rows_.size()); }
  std::uint32_t count() const { return count_; }
  std::uint32_t wild_count() const { return wild_count_; }
  bool contains(std::uint32_t agent) const { return agent < size() && rows_[agent].group != 0; }
  const HornRow& row(std::uint32_t agent) const { return rows_[agent]; }
  const SpaceTimeBound& bound(std::uint32_t agent) const { return *bounds_[agent]; }

  /// Whether filters can reckon with the instant: differences of such are exact.
  static bool Near(Instant t) {
    constexpr std::int64_t kFarthest = std::int64_t{1} << 61;
    return t.nanoseconds() > -kFarthest && t.nanoseconds() < kFarthest;
  }

  /// Of a row that is not wild, at an instant that is Near(). Before its stamp the line goes on backward, and the reach stays.
  HornAt At(std::uint32_t agent, Instant instant) const;

  /// A filter: no horn of the two meets earlier than this many seconds after `from`, and none at
  /// all within `limit` if the answer is larger. Off by a relative 1e-9 or so; 0 for wild ones.
  double EarlierBound(std::uint32_t a, std::uint32_t b, Instant from, double limit) const;

 private:
  std::vector<HornRow> rows_;                          // by agent
  std::vector<std::optional<SpaceTimeBound>> bounds_;  // by agent
  std::uint32_t count_ = 0, wild_count_ = 0;
};

/// The reach of a hypertrapezoid's box over a window of `duration` seconds, from that of its horn:
/// chords instead of parabolas, and corners √3 away instead of the ball.
HornAt BoxReach(HornAt horn, double duration);

}  // namespace collision
