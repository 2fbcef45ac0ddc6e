#include "client/programs/scene/past.h"

#include <algorithm>
#include <utility>

#include "client/programs/scene/item.h"

namespace collision::client {
namespace {

/// What comes on several topics may come a little out of order.
constexpr std::int64_t kDisorderNs = 1'000'000'000;

}  // namespace

void Past::Keep(const StateTable& states, std::int64_t now_ns) {
  const std::lock_guard lock(mutex_);
  if (!samples_.empty() && now_ns < samples_.back().now_ns - kDisorderNs) {
    samples_.clear();
    states_ = 0;
    seen_ = 0;
  }
  const double agents = static_cast<double>(states.agents().size());
  const double period = static_cast<double>(kSpanNs) * agents / static_cast<double>(kStatesMax);
  const auto wanted = std::max(kPeriodNs, static_cast<std::int64_t>(period));
  if (!samples_.empty() && now_ns - samples_.back().now_ns < wanted) return;
  std::string packed = states.PackAfter(seen_);
  seen_ = states.newest_change();
  if (packed.empty()) return;
  const std::size_t count = packed.size() / (StateTable::kHeaderBytes + StateTable::kStateBytes);
  samples_.push_back({now_ns, count, MakeItem(ItemKind::kChangedStates, std::move(packed))});
  states_ += count;
  while (!samples_.empty() &&
         (states_ > kStatesMax || samples_.front().now_ns < now_ns - kSpanNs)) {
    states_ -= samples_.front().states;
    samples_.pop_front();
  }
}

std::string Past::Items() const {
  const std::lock_guard lock(mutex_);
  std::string items;
  for (const Sample& sample : samples_) items += *sample.item;
  return items;
}

}  // namespace collision::client
