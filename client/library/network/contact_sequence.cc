#include "client/library/network/contact_sequence.h"

#include <algorithm>

namespace collision::client {

void ContactSequence::Restart() {
  begun_ = false;
  taken_ = given_up_ = 0;
}

bool ContactSequence::Take(std::uint64_t sequence) {
  if (begun_ && sequence <= taken_) return false;
  if (begun_) {
    const std::uint64_t settled = std::max(taken_, given_up_);
    if (sequence <= settled) {
      --missed_;
    } else {
      missed_ += sequence - settled - 1;
    }
  }
  begun_ = true;
  taken_ = sequence;
  return true;
}

void ContactSequence::BeginAtNone() { begun_ = true; }

bool ContactSequence::HasAll(std::uint64_t sequence) const {
  return std::max(taken_, given_up_) >= sequence;
}

void ContactSequence::GiveUp(std::uint64_t sequence) {
  if (HasAll(sequence)) return;
  // Whoever joins gets the newest contact: at least that one was lost.
  missed_ += begun_ ? sequence - std::max(taken_, given_up_) : 1;
  if (!begun_) taken_ = sequence - 1;
  begun_ = true;
  given_up_ = sequence;
}

}  // namespace collision::client
