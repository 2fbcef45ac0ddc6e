// The kernel of lanes_answers.h. After a lanes header (simd/).
#pragma once

#include "collision_core/simd/points_wide.h"
#include "tests/collision_core/simd/lanes_answers.h"

namespace collision::simd::lanes_answers::COLLISION_SIMD {

using namespace simd::COLLISION_SIMD;

/// The lanes from `k` on.
WIDE inline void AnswerFrom(std::uint32_t k, const LaneInputs& in, LaneAnswers* out) {
  const Lanes a = Load(in.a + k), b = Load(in.b + k), c = Load(in.c + k);
  Store(out->sum + k, a + b);
  Store(out->difference + k, a - b);
  Store(out->product + k, a * b);
  Store(out->quotient + k, a / b);
  Store(out->root + k, Root(a));
  Store(out->lesser + k, Lesser(a, b));
  Store(out->greater + k, Greater(a, b));
  Store(out->where_greater + k, WhereGreater(a, b, c));
  Store(out->eight + k, LoadEight(in.a));
  Store(out->four + k, LoadFour(in.a));
  Store(out->fours + k, SpreadFours(in.a, k / 4));
  Store(out->eights + k, SpreadEights(in.a, k / 8, k / 8 + 1));
  const Points p{a, b, c}, q{c, a, b};
  Store(out->dot + k, Dot(p, q));
  const Points cross = Cross(p, q);
  Store(out->cross_x + k, cross.x);
  Store(out->cross_y + k, cross.y);
  Store(out->cross_z + k, cross.z);
  out->not_greater |= NotGreater(a, b) << k;
  out->not_less |= NotLess(a, b) << k;
  out->not_at_least |= NotAtLeast(a, b) << k;
  std::uint32_t* const to = out->selected + out->selected_count;
  const std::uint32_t found = StoreSelected(NotGreater(a, b), k, to);
  StoreCopies(7, found, out->copies + out->selected_count);
  out->selected_count += found;
  const float least = LeastOf(Load(out->root + k));
  out->least = k == 0 || least < out->least ? least : out->least;
}

WIDE inline void Answer(const LaneInputs& in, LaneAnswers* out) {
  out->not_greater = out->not_less = out->not_at_least = out->selected_count = 0;
  for (std::uint32_t k = 0; k < kCount; k += kWidth) AnswerFrom(k, in, out);
}

}  // namespace collision::simd::lanes_answers::COLLISION_SIMD
