// Inputs of rounds that a standby has not reached.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "collision_core/base/instant.h"
#include "idl/messages.pb.h"

namespace collision::server {

/// A simulator cannot tell of a time that it has not been granted, so a service that grants time
/// never has states of a later round. One that stands by follows the grants of another one, and may
/// be behind: it keeps such states and clocks until it gets there, and so finds what the other one
/// finds. One thread.
class LaterRounds {
 public:
  /// Beyond it nothing more is kept: rounds are judged together, which makes brackets wider.
  static constexpr std::size_t kKeptMax = 65536;

  /// Keeps the input if it tells of a time after `end`, the end of the present round.
  bool Keep(const v1::Input& input, Instant end);

  /// What does not tell of a time after `end`, in the order of its arrival.
  std::vector<v1::Input> Take(Instant end);

  /// What this simulator told up to and with its first clock that is kept: the clock before it,
  /// which would have ended the round, was lost.
  std::vector<v1::Input> TakeToClock(std::uint64_t simulator);

  /// The greatest clock that has been kept so far; else Always().
  Instant newest_clock() const { return newest_clock_; }

  bool empty() const { return kept_.empty(); }

  /// Time begins anew.
  void Clear() { *this = {}; }

 private:
  std::deque<v1::Input> kept_;
  Instant newest_clock_ = Instant::Always();
};

}  // namespace collision::server
