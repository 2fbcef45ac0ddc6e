// Filters with assemblies, sides and lists, at random.
#pragma once

#include <memory>

#include "collision_core/broad_phase/collision_filter.h"
#include "tests/support/random.h"

namespace collision::broad_phase {

/// Of a few assemblies and names, so that they occur often; names are not unique.
inline CollisionFilter DrawFilter(Random* random) {
  const auto draw = [random](int count) {
    return static_cast<std::uint32_t>(random->Below(count));
  };
  CollisionFilter filter{.assembly = draw(4), .name = draw(12)};
  if (random->Chance(0.1)) filter.mask = 2;
  if (random->Chance(0.4)) filter.side = draw(kSideMax + 1);
  if (random->Chance(0.6)) return filter;
  PartnerLists lists;
  for (std::uint32_t name = 1; name < 12; ++name) {
    if (random->Chance(0.2)) lists.meets_in_assembly.push_back(name);
    if (random->Chance(0.1)) lists.never_meets.push_back(name);
  }
  filter.partners = std::make_shared<PartnerLists>(lists);
  return filter;
}

}  // namespace collision::broad_phase
