// What was told of agents lately, for a page that is opened now.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>

#include "client/programs/scene/payload.h"
#include "client/programs/scene/state_table.h"

namespace collision::client {

/// Keeps states of the last kSpanNs of the world's time, the fewer the more agents there are: at
/// most kStatesMax, and of an agent one a second. One thread keeps; any may ask.
class Past {
 public:
  static constexpr std::int64_t kSpanNs = 600'000'000'000;
  static constexpr std::int64_t kPeriodNs = 1'000'000'000;  ///< Between two states of an agent.
  static constexpr std::size_t kStatesMax = 200'000;

  /// To be called when the world's time has come to `now_ns`. Where time begins anew, what was
  /// before is forgotten.
  void Keep(const StateTable& states, std::int64_t now_ns);

  /// All of it as items of kind kChangedStates, the oldest first.
  std::string Items() const;

 private:
  struct Sample {
    std::int64_t now_ns = 0;
    std::size_t states = 0;
    Payload item;
  };

  mutable std::mutex mutex_;
  std::deque<Sample> samples_;  ///< Guarded by it.
  std::size_t states_ = 0;      ///< In all samples.
  std::uint64_t seen_ = 0;
};

}  // namespace collision::client
