// Which other agents an agent can meet at all, whatever their motion.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

namespace collision::broad_phase {

/// Single partners of an agent, by the numbers of their names. Each list ascends without
/// duplicates.
struct PartnerLists {
  std::vector<std::uint32_t> meets_in_assembly = {};  ///< Met although of the same assembly.
  std::vector<std::uint32_t> never_meets = {};        ///< Never met, of whatever assembly.

  friend bool operator==(const PartnerLists&, const PartnerLists&) = default;
};

/// The greatest number of a side.
inline constexpr std::uint32_t kSideMax = 3;

/// What decides whether two agents can meet at all: groups, the assembly, the side, and single
/// partners.
///
/// Whether two can meet is a function of their two filters alone. So it does not depend on which of
/// them came first, nothing changes for others when an agent comes or goes, and there is no table
/// of pairs: an assembly of n agents costs one number in each, not n (n − 1) / 2 rules. Numbers are
/// the caller's; only their equality counts.
struct CollisionFilter {
  std::uint32_t group = 1;     ///< Groups that the agent belongs to, as bits.
  std::uint32_t mask = ~0u;    ///< Groups that it can meet.
  std::uint32_t assembly = 0;  ///< The agents of one assembly do not meet; 0: of none.
  std::uint32_t name = 0;      ///< By which lists refer to the agent; 0: none does.
  std::uint32_t side = 0;      ///< The agents of one side never meet; 0: of none, at most kSideMax.
  std::shared_ptr<const PartnerLists> partners = nullptr;  ///< Null: both lists are empty.

  /// Lists are compared by their content.
  friend bool operator==(const CollisionFilter& a, const CollisionFilter& b);
};

/// Whether the lists leave two agents that have these names able to meet; null: empty lists.
/// `apart`: the two are of one assembly. One list is enough: the two meet within their assembly if
/// either lists the other, and they never meet if either lists the other there, which wins over
/// everything else.
bool ListsLetMeet(const PartnerLists* of_a, std::uint32_t name_of_a, const PartnerLists* of_b,
                  std::uint32_t name_of_b, bool apart);

/// Whether each is in a group that the other's mask names.
inline bool GroupsLetMeet(std::uint32_t group_of_a, std::uint32_t mask_of_a,
                          std::uint32_t group_of_b, std::uint32_t mask_of_b) {
  return (group_of_a & mask_of_b) != 0 && (group_of_b & mask_of_a) != 0;
}

/// Whether an assembly keeps two agents of these assemblies apart.
inline bool AreOfOneAssembly(std::uint32_t of_a, std::uint32_t of_b) {
  return of_a == of_b && of_a != 0;
}

/// Whether both are of one side.
inline bool AreOfOneSide(std::uint32_t of_a, std::uint32_t of_b) {
  return of_a == of_b && of_a != 0;
}

/// Whether the two can meet at all.
inline bool CanMeet(const CollisionFilter& a, const CollisionFilter& b) {
  if (!GroupsLetMeet(a.group, a.mask, b.group, b.mask)) return false;
  if (AreOfOneSide(a.side, b.side)) return false;
  const bool apart = AreOfOneAssembly(a.assembly, b.assembly);
  if (!a.partners && !b.partners) return !apart;
  return ListsLetMeet(a.partners.get(), a.name, b.partners.get(), b.name, apart);
}

/// Whether an agent that had the filter `before` may meet some agent with `next` that it could not
/// meet before. Never falsely false; true for another name, and for another assembly or side than
/// one that it was in, even if no other agent has or lists them.
bool MayMeetMore(const CollisionFilter& before, const CollisionFilter& next);

/// Whether the filter says more than a name.
inline bool KeepsApart(const CollisionFilter& filter) {
  return filter.group != 1 || filter.mask != ~0u || filter.assembly != 0 || filter.side != 0 ||
         filter.partners;
}

}  // namespace collision::broad_phase
