#include "server/intake/unproven_inputs.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace collision::server {

void UnprovenInputs::Add(std::int64_t now_ns, std::uint64_t simulator_id, const v1::Input& input) {
  if (!senders_.contains(input.sender()) && senders_.size() >= kUnprovenSendersMax) {
    ++dropped_;
    return;
  }
  Sender& sender = senders_[input.sender()];
  const std::size_t bytes = std::max(input.ByteSizeLong(), kUnprovenInputBytesMin);
  sender.waiting.push_back({now_ns, simulator_id, bytes, input});
  sender.newest_ns = now_ns;
  sender.bytes += bytes;
  bytes_ += bytes;
  ++size_;
  while (bytes_ > kUnprovenBytesMax) {
    const auto largest = std::max_element(
        senders_.begin(), senders_.end(),
        [](const auto& a, const auto& b) { return a.second.bytes < b.second.bytes; });
    ++largest->second.lost;
    DropOldest(&largest->second);
  }
}

void UnprovenInputs::DropOldest(Sender* sender) {
  sender->bytes -= sender->waiting.front().bytes;
  bytes_ -= sender->waiting.front().bytes;
  sender->waiting.pop_front();
  --size_;
  ++dropped_;
}

UnprovenInputs::Proved UnprovenInputs::Take(std::uint64_t simulator_id, std::uint64_t sender) {
  Proved proved;
  const auto found = senders_.find(sender);
  if (found == senders_.end()) return proved;
  Sender& of_sender = found->second;
  proved.lost = std::exchange(of_sender.lost, 0);
  std::deque<Waiting> others;
  for (Waiting& one : of_sender.waiting) {
    if (one.simulator_id != simulator_id) {
      others.push_back(std::move(one));
      continue;
    }
    of_sender.bytes -= one.bytes;
    bytes_ -= one.bytes;
    --size_;
    proved.inputs.push_back(std::move(one.input));
  }
  of_sender.waiting = std::move(others);
  if (of_sender.waiting.empty()) senders_.erase(found);
  return proved;
}

void UnprovenInputs::Forget(std::uint64_t sender) {
  const auto found = senders_.find(sender);
  if (found == senders_.end()) return;
  while (!found->second.waiting.empty()) DropOldest(&found->second);
  senders_.erase(found);
}

std::uint64_t UnprovenInputs::DropOverdue(std::int64_t now_ns) {
  const std::uint64_t before = dropped_;
  for (auto next = senders_.begin(); next != senders_.end();) {
    Sender& sender = next->second;
    while (!sender.waiting.empty() && sender.waiting.front().arrived_ns + kUnprovenTime <= now_ns) {
      DropOldest(&sender);
    }
    next = sender.newest_ns + kUnprovenTime <= now_ns ? senders_.erase(next) : std::next(next);
  }
  return dropped_ - before;
}

std::optional<std::int64_t> UnprovenInputs::NextDue() const {
  std::optional<std::int64_t> next;
  for (const auto& [id, sender] : senders_) {
    const std::int64_t oldest =
        sender.waiting.empty() ? sender.newest_ns : sender.waiting.front().arrived_ns;
    next = std::min(next.value_or(oldest + kUnprovenTime), oldest + kUnprovenTime);
  }
  return next;
}

}  // namespace collision::server
