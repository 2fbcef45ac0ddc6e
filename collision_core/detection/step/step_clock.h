// The step that the detector is in.
#pragma once

#include <cstdint>
#include <functional>

#include "collision_core/numeric/seconds.h"

namespace collision::detection {

/// The time and number of the current step. All components of a detector share one object, which
/// only Detector::Advance() changes.
struct StepClock {
  Instant now = Instant::Always();  ///< The time of the last step; Always() before the first.
  std::uint64_t step = 0;           ///< Steps so far.
  double announce_within = 0;       ///< DetectorOptions::announce_within [s].
  /// Called after each bounded piece of a step's work; empty: nobody wants to know.
  std::function<void()> progress = nullptr;

  void MadeProgress() const {
    if (progress) progress();
  }

  /// now + announce_within, rounded down; a pair that may meet by then is tracked. Never() if there
  /// is no such instant.
  Instant announce_until() const { return numeric::AddRoundedDown(now, announce_within); }
};

}  // namespace collision::detection
