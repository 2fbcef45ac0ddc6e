// The receiver of the pairs that a search finds.
#pragma once

#include <cstdint>

#include "collision_core/numeric/rounding.h"

namespace collision::broad_phase {

/// Receives pairs that may come near each other; the limit tells the search how far to look.
class PairSink {
 public:
  /// Two agents that may come near each other; or one agent twice, which is no pair.
  virtual void Offer(std::uint32_t a, std::uint32_t b) = 0;

  /// Seconds after the search's begin: pairs that come near later do not count. May shrink.
  double limit() const { return limit_; }

 protected:
  ~PairSink() = default;

  double limit_ = numeric::kInfinity;
};

}  // namespace collision::broad_phase
