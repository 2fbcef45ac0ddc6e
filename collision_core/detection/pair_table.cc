#include "collision_core/detection/pair_table.h"

#include <algorithm>

namespace collision::detection {

std::optional<std::uint32_t> PairTable::Add(const PairRecord& pair) {
  if (size_ == pairs_max_) return std::nullopt;
  std::uint32_t slot;
  if (free_.size() <= kSlotsResting && pairs_.size() < pairs_max_) {
    slot = static_cast<std::uint32_t>(pairs_.size());
    pairs_.emplace_back(pair);
  } else {
    slot = free_.front();
    free_.pop_front();
    pairs_[slot] = pair;
  }
  ++size_;
  return slot;
}

void PairTable::Remove(std::uint32_t slot) {
  pairs_[slot].reset();
  free_.push_back(slot);
  --size_;
}

std::uint32_t PairTable::NextContact(std::uint32_t lower, std::uint32_t higher) {
  if (numbers_.size() <= std::max(lower, higher)) numbers_.resize(std::max(lower, higher) + 1);
  const std::uint32_t known = TakeNumber(lower, higher);
  TakeNumber(higher, lower);
  const std::uint32_t last =
      known != 0 ? known : std::max(numbers_[lower].given_up, numbers_[higher].given_up);
  KeepNumber(lower, higher, last + 1);
  KeepNumber(higher, lower, last + 1);
  return last + 1;
}

// 0: not known.
std::uint32_t PairTable::TakeNumber(std::uint32_t agent, std::uint32_t partner) {
  std::vector<Number>& known = numbers_[agent].known;
  const auto found = std::find_if(known.begin(), known.end(), [partner](const Number& number) {
    return number.partner == partner;
  });
  if (found == known.end()) return 0;
  const std::uint32_t last = found->last;
  known.erase(found);
  return last;
}

void PairTable::KeepNumber(std::uint32_t agent, std::uint32_t partner, std::uint32_t number) {
  Numbers& numbers = numbers_[agent];
  if (numbers.known.size() == kNumbersPerAgentMax) {
    const Number oldest = numbers.known.front();
    TakeNumber(agent, oldest.partner);
    TakeNumber(oldest.partner, agent);
    for (Numbers* side : {&numbers, &numbers_[oldest.partner]}) {
      side->given_up = std::max(side->given_up, oldest.last);
    }
  }
  numbers.known.push_back({partner, number});
}

void PairTable::Forget(std::uint32_t agent) {
  if (numbers_.size() <= agent) return;
  for (const Number& number : numbers_[agent].known) TakeNumber(number.partner, agent);
  numbers_[agent] = Numbers();
}

}  // namespace collision::detection
