// Batches that may not hold all that has arrived.
#pragma once

#include <algorithm>
#include <cstddef>

#include "idl/messages.pb.h"

namespace collision::server {

/// Whether more may have arrived than was taken. A network that hands on instance by instance may
/// give a clock with the newest of the states that it counts while older ones of other agents still
/// wait: no clock comes into force then. One thread.
class FullBatches {
 public:
  /// Inputs of full batches that follow one another while no clock comes into force; after so many
  /// it does all the same, so that a flood of messages does not stop everybody's time.
  static constexpr std::size_t kHeldInputsMax = 1 << 20;

  /// A batch of at most `most` inputs was received.
  void Take(const google::protobuf::RepeatedPtrField<v1::Input>& inputs, std::size_t most) {
    const auto received = std::count_if(inputs.begin(), inputs.end(), [](const v1::Input& input) {
      return !input.has_shape_ready();
    });
    // What comes with a suspected message follows it.
    const bool is_suspected = !inputs.empty() && inputs.Get(0).suspected();
    full_ = is_suspected || static_cast<std::size_t>(received) >= most;
    held_ = full_ && held_ < kHeldInputsMax ? held_ + static_cast<std::size_t>(inputs.size()) : 0;
  }

  bool last_was_full() const { return full_; }
  bool holds_clocks() const { return held_ > 0; }

 private:
  bool full_ = false;
  std::size_t held_ = 0;  ///< In the full batches up to now.
};

}  // namespace collision::server
