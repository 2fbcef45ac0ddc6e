// Samples that have arrived and wait, in a queue for each sender.
#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "idl/dds/inbox/sender_limits.h"

namespace collision::dds {

/// What a newer sample replaces an older one of.
struct SampleKey {
  std::uint64_t writer = 0;
  bool disposal = false;  ///< A disposal replaces an older disposal only.
  std::array<unsigned char, 16> key{};

  auto operator<=>(const SampleKey&) const = default;
};

/// What is known of a sample beside its contents.
struct SampleFacts {
  std::uint64_t sender = 0;
  SampleKey key;
  std::size_t depth = 1;  ///< Newest samples of the key that are kept.
  /// Of a key that is written all the time: the oldest that waits keeps its place, too, or none
  /// would ever come to the front of a queue that is long.
  bool keeps_place = false;
  std::size_t bytes = 0;
};

/// What a sender loses, or is about to.
struct SenderLoss {
  std::uint64_t sender = 0;
  std::uint64_t dropped = 0;        ///< Samples that were refused, gave way or were ignored.
  std::size_t waiting = 0;          ///< Samples.
  std::int64_t ignored_for_ns = 0;  ///< From now on; 0: it is not.
};

/// First in, first out for each sender, the newest `depth` samples of each key; all senders get
/// equal shares of what is taken at once. Keeps the SenderLimits. Nothing but waiting samples takes
/// memory, so keys may be ever new: an ordered map finds them, since whoever writes them chooses
/// them, and could choose keys that a hash table does not spread.
///
/// Times are of one clock that never goes back [ns]. One thread at a time.
template <class Item>
class SenderQueues {
 public:
  explicit SenderQueues(const SenderLimits& limits) : limits_(limits) {}

  enum class Outcome {
    kWaits,
    kOverRate,  ///< Waits likewise, behind others of the sender, until the rate allows it.
    kRefused,
    kIgnored,  ///< The sender is ignored; its samples that waited are gone.
    kIgnoredFromNow,
  };

  Outcome Put(const SampleFacts& facts, Item item, std::int64_t now_ns) {
    Queue& queue = queues_.try_emplace(facts.sender, NewQueue(now_ns)).first->second;
    if (now_ns < queue.ignored_until_ns) {
      CountDropped(1, &queue, now_ns);
      return Outcome::kIgnored;
    }
    const bool first = queue.order.empty();
    Replace(facts, &queue);
    if (!MakeRoom(facts.bytes + kSampleOverhead, &queue, now_ns)) return Refuse(&queue, now_ns);
    Append(facts.key, {facts.key, facts.bytes, std::move(item), {}}, &queue);
    Refill(&queue, now_ns);
    return first || Ready(queue) ? Outcome::kWaits : Outcome::kOverRate;
  }

  /// Appends at most `samples` items, as many as have `bytes` together, but one in any case if
  /// `items` is empty. What is too large for the rest of them waits, at most a turn of
  /// each other sender.
  void Take(std::size_t samples, std::size_t bytes, std::int64_t now_ns, std::vector<Item>* items) {
    Budget budget{samples, bytes};
    for (auto& [sender, queue] : queues_) Refill(&queue, now_ns);
    for (bool served = true; served && budget.left();) {
      served = false;
      // From the sender behind the one that was served last, once around.
      auto next = queues_.upper_bound(last_served_);
      for (std::size_t i = 0; i < queues_.size() && budget.left(); ++i, ++next) {
        if (next == queues_.end()) next = queues_.begin();
        if (!Ready(next->second)) continue;
        if (!Serve(&next->second, &budget, items)) continue;
        last_served_ = next->first;
        served = true;
      }
    }
    std::erase_if(queues_, [&](const auto& entry) { return IsForgotten(entry.second, now_ns); });
  }

  /// How much should be taken at once [bytes]: a part of what waits. So a sample that arrives while
  /// the burst of another sender is worked on waits for that part only, and a program that is far
  /// behind still takes much at once.
  std::size_t AtOnce() const { return std::max(kAtOnceMin, waiting_bytes_ / kAtOnceShare); }

  /// How long until something should be taken [ns]; nullopt: nothing waits. Of what exceeds a rate
  /// some gathers first.
  std::optional<std::int64_t> UntilReady(std::int64_t now_ns) {
    std::optional<std::int64_t> least;
    for (auto& [sender, queue] : queues_) {
      if (queue.order.empty()) continue;
      Refill(&queue, now_ns);
      const double seconds =
          std::max({-queue.samples_left / static_cast<double>(limits_.samples_per_second),
                    -queue.bytes_left / static_cast<double>(limits_.bytes_per_second), 0.0});
      const auto wait =
          Ready(queue) ? 0 : std::max(static_cast<std::int64_t>(1e9 * seconds), kGathers);
      least = least ? std::min(*least, wait) : wait;
    }
    return least;
  }

  /// How long a sender is ignored this time [ns]; 0: it is not.
  std::int64_t IgnoredFor(std::uint64_t sender, std::int64_t now_ns) const {
    const auto found = queues_.find(sender);
    if (found == queues_.end()) return 0;
    return std::max<std::int64_t>(found->second.ignored_until_ns - now_ns, 0);
  }

  /// The senders that have lost something within kLossToldFor, or of which so much waits that only
  /// the newest sample of each key is kept. Counts are of that time.
  std::vector<SenderLoss> Losses(std::int64_t now_ns) const {
    std::vector<SenderLoss> losses;
    for (const auto& [sender, queue] : queues_) {
      if (!HasLost(queue, now_ns) && !IsBehind(queue)) continue;
      losses.push_back({sender, queue.dropped, queue.order.size(), IgnoredFor(sender, now_ns)});
    }
    return losses;
  }

  /// Drops all that waits.
  void Clear() {
    queues_.clear();
    waiting_bytes_ = 0;
  }

  /// Of all that waits, kSampleOverhead included.
  std::size_t waiting_bytes() const { return waiting_bytes_; }

  /// Samples that were neither taken nor replaced by newer ones.
  std::uint64_t refused() const { return refused_; }

 private:
  struct Sample;
  using Order = std::list<Sample>;
  struct Sample {
    SampleKey key;
    std::size_t bytes;
    Item item;
    typename Order::iterator newer;  ///< Of its key; unset: it is the newest.
  };
  struct OfKey {
    typename Order::iterator oldest, newest;
    std::size_t count = 0;
  };
  struct Queue {
    Order order;
    std::map<SampleKey, OfKey> keys;
    std::size_t waiting_bytes = 0;
    double samples_left = 0, bytes_left = 0;  ///< Of the rates; a sample may overdraw them.
    std::int64_t refilled_ns = 0;
    std::size_t refused = 0;
    std::int64_t ignored_for_ns = 0, ignored_until_ns = 0;
    std::uint64_t dropped = 0;
    std::int64_t dropped_ns = 0;  ///< The last one, if there was one.
  };
  struct Budget {
    std::size_t samples, bytes;
    bool left() const { return samples > 0 && bytes > 0; }
  };

  static constexpr std::int64_t kGathers = 1'000'000;  // ns

  /// What a sender is handed out before it is the turn of the next.
  static constexpr std::size_t kTurnBytes = 65536;

  Queue NewQueue(std::int64_t now_ns) const {
    Queue queue;
    queue.samples_left = SamplesMax();
    queue.bytes_left = BytesMax();
    queue.refilled_ns = now_ns;
    return queue;
  }

  double SamplesMax() const { return kBurst * static_cast<double>(limits_.samples_per_second); }
  double BytesMax() const { return kBurst * static_cast<double>(limits_.bytes_per_second); }

  void Refill(Queue* queue, std::int64_t now_ns) const {
    const double seconds = 1e-9 * static_cast<double>(now_ns - queue->refilled_ns);
    const auto fill = [seconds](double left, std::uint64_t rate, double most) {
      return std::min(left + seconds * static_cast<double>(rate), most);
    };
    queue->samples_left = fill(queue->samples_left, limits_.samples_per_second, SamplesMax());
    queue->bytes_left = fill(queue->bytes_left, limits_.bytes_per_second, BytesMax());
    queue->refilled_ns = now_ns;
  }

  static bool Ready(const Queue& queue) {
    return !queue.order.empty() && queue.samples_left > 0 && queue.bytes_left > 0;
  }

  /// False: not even its first sample is within the budget.
  bool Serve(Queue* queue, Budget* budget, std::vector<Item>* items) {
    std::size_t turn = 0;
    while (turn < kTurnBytes && Ready(*queue) && budget->left()) {
      const auto first = queue->order.begin();
      const std::size_t cost = first->bytes + kSampleOverhead;
      if (cost > budget->bytes && !items->empty()) {
        budget->bytes = 0;
        break;
      }
      turn += cost;
      budget->bytes -= std::min(budget->bytes, cost);
      --budget->samples;
      queue->samples_left -= 1;
      queue->bytes_left -= static_cast<double>(first->bytes);
      items->push_back(std::move(first->item));
      Erase(first, queue);
    }
    if (queue->order.empty()) queue->refused = 0;
    return turn > 0;
  }

  void Replace(const SampleFacts& facts, Queue* queue) {
    const std::size_t least = facts.keeps_place ? 2 : 1;
    const std::size_t depth = IsBehind(*queue) ? least : std::max(facts.depth, least);
    for (auto of_key = queue->keys.find(facts.key);
         of_key != queue->keys.end() && of_key->second.count >= depth;
         of_key = queue->keys.find(facts.key)) {
      if (facts.keeps_place) {
        EraseSecond(&of_key->second, queue);
      } else {
        Erase(of_key->second.oldest, queue);
      }
    }
  }

  /// Where memory is full, the sender of which most waits loses its oldest sample, unless it is the
  /// one that wants room or would then have less than that.
  bool MakeRoom(std::size_t cost, Queue* queue, std::int64_t now_ns) {
    while (waiting_bytes_ + cost > limits_.waiting_bytes_max) {
      Queue& largest = std::max_element(queues_.begin(), queues_.end(), [](auto& a, auto& b) {
                         return a.second.waiting_bytes < b.second.waiting_bytes;
                       })->second;
      if (largest.waiting_bytes <= queue->waiting_bytes + cost) return false;
      Erase(largest.order.begin(), &largest);
      ++largest.refused;
      CountDropped(1, &largest, now_ns);
    }
    return true;
  }

  Outcome Refuse(Queue* queue, std::int64_t now_ns) {
    CountDropped(1, queue, now_ns);
    if (++queue->refused <= kRefusedMax) return Outcome::kRefused;
    CountDropped(queue->order.size(), queue, now_ns);
    waiting_bytes_ -= queue->waiting_bytes;
    const std::int64_t twice = std::min(2 * queue->ignored_for_ns, kIgnoredForMax);
    const std::uint64_t dropped = queue->dropped;
    *queue = NewQueue(now_ns);
    queue->dropped = dropped;
    queue->dropped_ns = now_ns;
    queue->ignored_for_ns = std::max(twice, kIgnoredFor);
    queue->ignored_until_ns = now_ns + queue->ignored_for_ns;
    return Outcome::kIgnoredFromNow;
  }

  void Append(const SampleKey& key, Sample sample, Queue* queue) {
    const std::size_t cost = sample.bytes + kSampleOverhead;
    queue->waiting_bytes += cost;
    waiting_bytes_ += cost;
    const auto added = queue->order.insert(queue->order.end(), std::move(sample));
    OfKey& of_key = queue->keys[key];
    (of_key.count++ == 0 ? of_key.oldest : of_key.newest->newer) = added;
    of_key.newest = added;
  }

  /// Requires that the sample is the oldest of its key, as the oldest of the queue is.
  void Erase(typename Order::iterator sample, Queue* queue) {
    const std::size_t cost = sample->bytes + kSampleOverhead;
    queue->waiting_bytes -= cost;
    waiting_bytes_ -= cost;
    const auto of_key = queue->keys.find(sample->key);
    of_key->second.oldest = sample->newer;
    if (--of_key->second.count == 0) queue->keys.erase(of_key);
    queue->order.erase(sample);
  }

  /// Requires that at least two wait.
  void EraseSecond(OfKey* of_key, Queue* queue) {
    const auto second = of_key->oldest->newer;
    const std::size_t cost = second->bytes + kSampleOverhead;
    queue->waiting_bytes -= cost;
    waiting_bytes_ -= cost;
    of_key->oldest->newer = second->newer;
    if (of_key->newest == second) of_key->newest = of_key->oldest;
    --of_key->count;
    queue->order.erase(second);
  }

  void CountDropped(std::size_t samples, Queue* queue, std::int64_t now_ns) {
    refused_ += samples;
    if (!HasLost(*queue, now_ns)) queue->dropped = 0;
    queue->dropped += samples;
    queue->dropped_ns = now_ns;
  }

  static bool HasLost(const Queue& queue, std::int64_t now_ns) {
    return queue.dropped > 0 && now_ns - queue.dropped_ns <= kLossToldFor;
  }

  bool IsBehind(const Queue& queue) const {
    return queue.order.size() >= kBehind || queue.waiting_bytes >= limits_.waiting_bytes_max / 4;
  }

  /// A sender that has nothing to hide behind a new queue.
  bool IsForgotten(const Queue& queue, std::int64_t now_ns) const {
    const std::int64_t since = now_ns - queue.ignored_until_ns;
    return queue.order.empty() && !HasLost(queue, now_ns) && queue.samples_left >= SamplesMax() &&
           queue.bytes_left >= BytesMax() && (queue.ignored_for_ns == 0 || since > kIgnoredForMax);
  }

  const SenderLimits limits_;
  std::map<std::uint64_t, Queue> queues_;
  std::uint64_t last_served_ = 0;
  std::size_t waiting_bytes_ = 0;
  std::uint64_t refused_ = 0;
};

}  // namespace collision::dds
