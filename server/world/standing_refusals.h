// What is refused of one simulator now.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

#include "server/codec/refusal.h"

namespace collision::server {

/// Standing refusals of one simulator that are listed; more are only counted.
inline constexpr std::size_t kStandingRefusalsMax = 64;

/// Refusals as a state: one of each topic and slot, the newest, until a message of that topic and
/// slot was accepted, the agent in the slot is gone, or a new run begins. One thread.
class StandingRefusals {
 public:
  using Key = std::pair<v1::InputTopic, std::uint32_t>;  ///< Topic, slot.

  /// Whether a refusal for this reason is of what the owner of the id wrote in its run: others do
  /// not stand.
  static bool Stands(v1::RejectionReason reason);

  void Add(const Refusal& refusal);
  void Accept(v1::InputTopic topic, std::uint32_t slot);

  /// The agent in the slot is gone.
  void RemoveAgent(std::uint32_t slot);

  void Clear();

  /// By topic and slot.
  const std::map<Key, Refusal>& listed() const { return listed_; }

  /// Those listed and those for which there was no place, which count until the list is empty: so
  /// it is never too small.
  std::uint64_t count() const { return listed_.size() + unlisted_; }

  /// The most descriptions that may be refused, of those counted.
  std::uint64_t descriptions() const;

  /// Grows with every change.
  std::uint64_t revision() const { return revision_; }

 private:
  std::map<Key, Refusal> listed_;
  std::uint64_t unlisted_ = 0;
  std::uint64_t revision_ = 0;
};

}  // namespace collision::server
