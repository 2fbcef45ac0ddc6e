// What a program that reads simulators takes from each sender.
#pragma once

#include <cstddef>
#include <cstdint>

namespace collision::dds {

/// A sender is a program that writes. What exceeds its rates waits; beyond `waiting_bytes_max` it
/// is refused, and a sender that goes on is ignored for a while.
struct SenderLimits {
  std::uint64_t samples_per_second = 300'000;    ///< Of one sender, > 0.
  std::uint64_t bytes_per_second = 268'435'456;  ///< Likewise.
  /// Of all senders together, the memory beside the samples included. Where that is full, the
  /// sender of which most waits gives way, so that each may fill an equal share.
  std::size_t waiting_bytes_max = 128'000'000;
};

/// A sender may take its rates at once for so long [s]: programs that start tell much at once.
inline constexpr double kBurst = 0.5;

/// Memory of a waiting sample beside its bytes.
inline constexpr std::size_t kSampleOverhead = 512;

/// Of a sender of which so many samples wait, or a quarter of `waiting_bytes_max`, only the newest
/// sample of each key is kept.
inline constexpr std::size_t kBehind = 16384;

/// Samples that were refused or gave way since the sender's queue was last empty; with one more it
/// is ignored.
inline constexpr std::size_t kRefusedMax = 65536;

/// What is taken at once of all that waits: this part, and at least so many bytes (about a full
/// message of states).
inline constexpr std::size_t kAtOnceShare = 8;
inline constexpr std::size_t kAtOnceMin = 8192;

/// How long it is ignored for the first time [ns]; then twice as long each time, up to the maximum.
/// So long after it was last ignored, it counts as new.
inline constexpr std::int64_t kIgnoredFor = 10'000'000'000;
inline constexpr std::int64_t kIgnoredForMax = 3'600'000'000'000;

/// How long it is told what a sender has lost, after it lost something for the last time [ns].
inline constexpr std::int64_t kLossToldFor = 60'000'000'000;

}  // namespace collision::dds
