// The bounds that a method of the broad phase holds, and the one place of this room where rules and
// half-spaces enter.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "collision_core/base/check.h"
#include "collision_core/broad_phase/agent_bound.h"
#include "collision_core/broad_phase/half_space.h"
#include "collision_core/intersection/pair_rules.h"

namespace collision::broad_phase {

/// The bounds of all agents by index, with what is agreed in addition: excluded pairs, margins of
/// pairs, and half-spaces (floors, walls). It is the common base of NeighbourIndex and
/// EarliestSweep, which query the bounds that are held.
///
/// Rules and half-spaces enter a method only here. No declaration has rules, so only tests set any.
/// A margin grows an agent's reach where its bound is stored (HornTable, AlphaTFaces), so that the
/// filters know nothing of pairs; an exclusion is applied to the pairs that the filters leave
/// (PairRules has both arguments). What declarations say of partners stands in the filters of the
/// bounds (collision_filter.h).
///
/// A change takes effect at once; structures are brought up to date by the next query. Indices
/// are small whole numbers that the caller chooses; memory is in proportion to the greatest.
/// Single-threaded.
class AgentBounds {
 public:
  using SharedRules = std::shared_ptr<intersection::PairRules>;

  /// Methods that work together share one PairRules. A caller that changes a rule without SetRule()
  /// calls UpdateRules() of each method. Requires `rules` not null.
  explicit AgentBounds(SharedRules rules = NoRules()) : rules_(std::move(rules)) {
    CORE_CHECK(rules_ != nullptr, "there is an object for rules, which may be empty");
  }
  AgentBounds(const AgentBounds&) = delete;
  AgentBounds& operator=(const AgentBounds&) = delete;
  virtual ~AgentBounds() = default;

  /// Adds the agent, or replaces its bound or the half-space of that index.
  virtual void Set(std::uint32_t agent, const AgentBound& bound) = 0;
  /// Removes the agent or half-space, if it is there, and all its rules.
  virtual void Remove(std::uint32_t agent) = 0;

  /// Adds a half-space under an index of its own, or replaces what that index held. Returns false,
  /// and changes nothing, if HalfSpaces refuses it.
  virtual bool SetHalfSpace(std::uint32_t agent, const HalfSpace& half_space) = 0;
  const HalfSpaces& half_spaces() const { return half_spaces_; }

  /// Whether an agent of this index is held; a half-space is none.
  virtual bool Contains(std::uint32_t agent) const = 0;

  /// Replaces the rule of a pair; PairRule() takes it away. It counts from the next query on,
  /// also for agents that are set later, until one of the two is removed. Returns false, and
  /// changes nothing, if PairRules refuses it.
  bool SetRule(std::uint32_t a, std::uint32_t b, intersection::PairRule rule) {
    if (!rules_->Set(a, b, rule)) return false;
    UpdateRules(a);
    UpdateRules(b);
    return true;
  }
  bool Exclude(std::uint32_t a, std::uint32_t b) { return SetRule(a, b, {.excluded = true}); }
  bool SetMargin(std::uint32_t a, std::uint32_t b, double metres) {
    return SetRule(a, b, {.margin = metres});
  }
  void ClearRule(std::uint32_t a, std::uint32_t b) { SetRule(a, b, {}); }
  const intersection::PairRules& rules() const { return *rules_; }

  /// The rules of the agent have changed: stored reaches that depend on them are updated.
  virtual void UpdateRules(std::uint32_t /*agent*/) {}

  /// Walks the structure and compares its parts. Here: half-spaces stand in the order of their
  /// indices, which are no agents'. Throws CheckFailure.
  virtual void Validate() const {
    std::uint32_t next = 0;
    for (const HalfSpaces::Entry& entry : half_spaces_) {
      CORE_CHECK(entry.agent >= next, "half-spaces are in the order of their indices", entry.agent);
      CORE_CHECK(!Contains(entry.agent), "an index is an agent's or a half-space's", entry.agent);
      next = entry.agent + 1;
    }
  }

 protected:
  /// Removes all rules of the agent and updates its partners.
  void ForgetRules(std::uint32_t agent) {
    for (const std::uint32_t partner : rules_->Forget(agent)) UpdateRules(partner);
  }

  static SharedRules NoRules() { return std::make_shared<intersection::PairRules>(); }
  const SharedRules& shared_rules() const { return rules_; }
  HalfSpaces& mutable_half_spaces() { return half_spaces_; }

 private:
  const SharedRules rules_;
  HalfSpaces half_spaces_;
};

}  // namespace collision::broad_phase
