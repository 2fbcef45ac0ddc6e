// Goal:   groups, assemblies, sides and lists decide alike in either order, in the table and for a
//         guest, and a change of filter that lets an agent meet more is never taken for one that
//         does not.
// Method: each rule by hand; random filters, beside a definition in sets.
#include "collision_core/broad_phase/collision_filter.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "collision_core/broad_phase/filter/horn_table.h"
#include "tests/collision_core/broad_phase/draw_filter.h"

namespace collision::broad_phase {
namespace {

using Numbers = std::vector<std::uint32_t>;

CollisionFilter Member(std::uint32_t assembly, std::uint32_t name) {
  return {.assembly = assembly, .name = name};
}

CollisionFilter WithLists(CollisionFilter filter, const Numbers& meets, const Numbers& never) {
  filter.partners = std::make_shared<PartnerLists>(PartnerLists{meets, never});
  return filter;
}

void ExpectMeet(const CollisionFilter& a, const CollisionFilter& b, bool meet) {
  EXPECT_EQ(CanMeet(a, b), meet);
  EXPECT_EQ(CanMeet(b, a), meet);
}

TEST(CollisionFilter, AgentsOfOneAssemblyDoNotMeet) {
  ExpectMeet(Member(7, 1), Member(7, 2), false);
  ExpectMeet(Member(7, 1), Member(8, 2), true);
  ExpectMeet(Member(7, 1), Member(0, 2), true);
  ExpectMeet(Member(0, 1), Member(0, 2), true);
}

TEST(CollisionFilter, AgentsOfOneSideNeverMeet) {
  const CollisionFilter none, one{.side = 1}, other{.side = 2};
  ExpectMeet(one, one, false);
  ExpectMeet(one, other, true);
  ExpectMeet(one, none, true);
  ExpectMeet(none, none, true);
  CollisionFilter listed = WithLists(Member(7, 1), {2}, {}), partner = Member(7, 2);
  ExpectMeet(listed, partner, true);
  listed.side = partner.side = 1;
  ExpectMeet(listed, partner, false);
  EXPECT_TRUE(KeepsApart(one));
  EXPECT_NE(none, one);
  EXPECT_TRUE(MayMeetMore(one, none));
  EXPECT_TRUE(MayMeetMore(one, other));
  EXPECT_FALSE(MayMeetMore(none, one));
}

TEST(CollisionFilter, OneListIsEnoughToMeetInAnAssembly) {
  ExpectMeet(WithLists(Member(7, 1), {2, 5}, {}), Member(7, 2), true);
  ExpectMeet(WithLists(Member(7, 1), {2, 5}, {}), Member(7, 3), false);
  ExpectMeet(WithLists(Member(7, 1), {2, 5}, {}), Member(7, 0), false);
  CollisionFilter masked = Member(7, 2);
  masked.mask = 2;
  ExpectMeet(WithLists(Member(7, 1), {2}, {}), masked, false);
}

TEST(CollisionFilter, OneListIsEnoughNeverToMeetAndItWins) {
  ExpectMeet(WithLists(Member(0, 1), {}, {2}), Member(0, 2), false);
  ExpectMeet(WithLists(Member(7, 1), {}, {2}), Member(8, 2), false);
  ExpectMeet(WithLists(Member(0, 1), {}, {2}), Member(0, 3), true);
  ExpectMeet(WithLists(Member(7, 1), {2}, {}), WithLists(Member(7, 2), {}, {1}), false);
}

TEST(CollisionFilter, IsComparedByWhatItSays) {
  const CollisionFilter filter = WithLists(Member(1, 2), {3}, {4});
  EXPECT_EQ(filter, WithLists(Member(1, 2), {3}, {4}));
  EXPECT_NE(filter, WithLists(Member(1, 2), {3}, {5}));
  EXPECT_NE(filter, Member(1, 2));
  EXPECT_EQ(WithLists(Member(1, 2), {}, {}), Member(1, 2));
  EXPECT_TRUE(KeepsApart(filter));
  EXPECT_FALSE(KeepsApart(Member(0, 2)));
}

TEST(CollisionFilter, LessExclusionMayMeetMoreAndMoreExclusionDoesNot) {
  const CollisionFilter none = Member(0, 1), member = Member(7, 1);
  EXPECT_FALSE(MayMeetMore(none, member));
  EXPECT_TRUE(MayMeetMore(member, none));
  EXPECT_TRUE(MayMeetMore(member, Member(8, 1)));
  EXPECT_TRUE(MayMeetMore(member, WithLists(member, {2}, {})));
  EXPECT_FALSE(MayMeetMore(WithLists(member, {2}, {}), member));
  EXPECT_TRUE(MayMeetMore(WithLists(none, {}, {2, 3}), WithLists(none, {}, {3})));
  EXPECT_FALSE(MayMeetMore(WithLists(none, {}, {3}), WithLists(none, {}, {2, 3})));
  EXPECT_TRUE(MayMeetMore(none, Member(0, 2))) << "others may never meet the former name";
  EXPECT_TRUE(MayMeetMore(Member(0, 0), none)) << "others may meet the name in their assembly";
}

bool Has(const Numbers& numbers, std::uint32_t name) {
  return name != 0 && std::find(numbers.begin(), numbers.end(), name) != numbers.end();
}

bool CanMeetByDefinition(const CollisionFilter& a, const CollisionFilter& b) {
  const PartnerLists of_a = a.partners ? *a.partners : PartnerLists();
  const PartnerLists of_b = b.partners ? *b.partners : PartnerLists();
  if (!(a.group & b.mask) || !(b.group & a.mask)) return false;
  if (a.side != 0 && a.side == b.side) return false;
  if (Has(of_a.never_meets, b.name) || Has(of_b.never_meets, a.name)) return false;
  if (a.assembly == 0 || a.assembly != b.assembly) return true;
  return Has(of_a.meets_in_assembly, b.name) || Has(of_b.meets_in_assembly, a.name);
}

// Goal: the table, which keeps filters in parts, decides as the filters do, also where bounds are
//       kept whole, and returns every filter as it was set.
TEST(CollisionFilter, TheTableDecidesAsTheFiltersDo) {
  constexpr std::uint32_t kAgents = 200;
  Random random(1);
  HornTable table;
  std::vector<CollisionFilter> filters(kAgents);
  int met = 0, apart = 0;
  for (int round = 0; round < 20; ++round) {
    for (std::uint32_t agent = 0; agent < kAgents; ++agent) {
      if (random.Chance(0.5) && round > 0) continue;
      filters[agent] = DrawFilter(&random);
      motion::SpaceTimeBound bound;
      if (random.Chance(0.3)) bound.state.position_error = 1;
      if (random.Chance(0.2)) table.Remove(agent);
      table.Set(agent, {bound, filters[agent]});
    }
    table.Validate();
    for (std::uint32_t a = 0; a < kAgents; ++a) {
      ASSERT_EQ(table.filter(a), filters[a]) << a;
      for (std::uint32_t b = 0; b < kAgents; ++b) {
        const bool meet = CanMeetByDefinition(filters[a], filters[b]);
        ASSERT_EQ(CanMeet(filters[a], filters[b]), meet) << a << " " << b;
        ASSERT_EQ(table.FiltersLetMeet(a, b), meet) << a << " " << b;
        ASSERT_EQ(table.FiltersLetMeet(a, filters[b]), meet) << a << " " << b;
        ++(meet ? met : apart);
      }
    }
  }
  EXPECT_GT(met, 100'000);
  EXPECT_GT(apart, 100'000);
}

// Goal: MayMeetMore() is never falsely false.
TEST(CollisionFilter, WhatMayMeetMoreIsNeverMissed) {
  Random random(2);
  int more = 0, not_more = 0;
  for (int change = 0; change < 20'000; ++change) {
    const CollisionFilter before = DrawFilter(&random);
    CollisionFilter next = DrawFilter(&random);
    if (random.Chance(0.8)) next.name = before.name;
    if (random.Chance(0.5)) next.assembly = before.assembly;
    if (random.Chance(0.5)) next.side = before.side;
    const bool may = MayMeetMore(before, next);
    ++(may ? more : not_more);
    for (int other = 0; other < 20 && !may; ++other) {
      const CollisionFilter partner = DrawFilter(&random);
      ASSERT_FALSE(!CanMeet(before, partner) && CanMeet(next, partner)) << change;
    }
  }
  EXPECT_GT(more, 1000);
  EXPECT_GT(not_more, 1000);
}

}  // namespace
}  // namespace collision::broad_phase
