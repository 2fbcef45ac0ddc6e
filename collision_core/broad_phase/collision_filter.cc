#include "collision_core/broad_phase/collision_filter.h"

#include <algorithm>

namespace collision::broad_phase {
namespace {

using Numbers = std::vector<std::uint32_t>;

bool Lists(const PartnerLists* lists, Numbers PartnerLists::*which, std::uint32_t name) {
  if (lists == nullptr || name == 0) return false;
  const Numbers& numbers = lists->*which;
  return std::binary_search(numbers.begin(), numbers.end(), name);
}

bool EitherLists(const PartnerLists* of_a, std::uint32_t name_of_a, const PartnerLists* of_b,
                 std::uint32_t name_of_b, Numbers PartnerLists::*which) {
  return Lists(of_a, which, name_of_b) || Lists(of_b, which, name_of_a);
}

const PartnerLists& ListsOf(const CollisionFilter& filter) {
  static const PartnerLists kEmpty;
  return filter.partners ? *filter.partners : kEmpty;
}

bool HasAll(const Numbers& of, const Numbers& all) {
  return std::includes(of.begin(), of.end(), all.begin(), all.end());
}

}  // namespace

bool operator==(const CollisionFilter& a, const CollisionFilter& b) {
  return a.group == b.group && a.mask == b.mask && a.assembly == b.assembly && a.name == b.name &&
         a.side == b.side && (a.partners == b.partners || ListsOf(a) == ListsOf(b));
}

bool ListsLetMeet(const PartnerLists* of_a, std::uint32_t name_of_a, const PartnerLists* of_b,
                  std::uint32_t name_of_b, bool apart) {
  const auto either_lists = [&](Numbers PartnerLists::*which) {
    return EitherLists(of_a, name_of_a, of_b, name_of_b, which);
  };
  if (either_lists(&PartnerLists::never_meets)) return false;
  return !apart || either_lists(&PartnerLists::meets_in_assembly);
}

bool MayMeetMore(const CollisionFilter& before, const CollisionFilter& next) {
  if ((next.group & ~before.group) != 0 || (next.mask & ~before.mask) != 0) return true;
  if (before.assembly != 0 && next.assembly != before.assembly) return true;
  if (before.side != 0 && next.side != before.side) return true;
  if (before.name != next.name) return true;
  const PartnerLists &had = ListsOf(before), &has = ListsOf(next);
  return !HasAll(has.never_meets, had.never_meets) ||
         !HasAll(had.meets_in_assembly, has.meets_in_assembly);
}

}  // namespace collision::broad_phase
