// A network cable that delays, reorders and loses what goes through it.
#pragma once

#include <cstdint>
#include <string>

namespace collision::repeat {

struct CableFaults {
  double delay_min_s = 0;  ///< Of each frame, drawn on its own: frames overtake one another.
  double delay_max_s = 0;
  double loss = 0;  ///< Probability that a frame is lost.
  std::uint64_t seed = 1;
};

/// Carries Ethernet frames both ways between two network devices of this network namespace until a
/// stop signal comes. Prints "carries" when it does. Throws std::system_error where it may not:
/// that takes root.
void CarryFrames(const std::string& device_a, const std::string& device_b,
                 const CableFaults& faults);

}  // namespace collision::repeat
