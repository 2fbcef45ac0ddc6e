#include "client/library/network/contact_sequence.h"

#include <algorithm>

namespace collision::client {

void ContactSequence::Restart() {
  begun_ = false;
  taken_ = given_up_ = given_up_after_ = 0;
}

void ContactSequence::GoOn(const ContactSequence& heard) {
  const std::uint64_t missed = missed_;
  *this = heard;
  missed_ = missed;
}

bool ContactSequence::Take(std::uint64_t sequence) {
  if (begun_ && sequence <= taken_) return false;
  if (begun_) {
    const std::uint64_t settled = std::max(taken_, given_up_);
    if (sequence > settled) {
      missed_ += sequence - settled - 1;
    } else if (sequence > given_up_after_) {
      --missed_;
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
  if (!begun_) given_up_after_ = sequence - 1;
  if (begun_ && given_up_ <= taken_) given_up_after_ = taken_;
  missed_ += sequence - std::max({taken_, given_up_, given_up_after_});
  begun_ = true;
  given_up_ = sequence;
}

}  // namespace collision::client
