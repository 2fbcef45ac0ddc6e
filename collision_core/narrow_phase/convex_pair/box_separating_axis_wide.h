// The kernel of box_separating_axis.h: three axes at once. After a lanes header (simd/).
//
// Everything is seen through x' = Gᵀx, in which A's edges are the columns of GᵀG (nearly diagonal:
// squares, and `off` beside them), B's are those of C = GᵀM, and the centres' difference is p =
// Gᵀd. The gap of the two along a normal n' is |n'·p| less the reach of all edges; it is the same
// number as that along N = G n' of what is not transformed, times |N|.
//
// Rounding, with u = 2^-53, W_i = |g_k| |g_l| of the other two edges, W = |g_0| |g_1| |g_2| and b_j
// = |m_j|. Sums of three products are off by 3u, d by u:
//   n' = e_i        (N = g_i)            terms of up to |g_i| S: off by less than 2^-49 |g_i| S.
//   N = m_j                              likewise.
//   n' = e_i × C_j  (|N| <= 2 W_i b_j)   two products each, of terms up to W_i b_j S: 64u of that.
//   n' = C_j × C_m  (|N| <= 6 W b_j b_m) likewise 96u W b_j b_m S.
// Any n' is right to tell two apart, as it is computed. To tell that they touch the exact normals
// count: C is off by 3u |g_i| |m_j|, which is in the above, and A's edges are not quite along e_i.
// With |off| <= 2^-46 of the least square that turns n' by less than 2^-45, weighed by the edges'
// lengths; less than 2^-43 S of the above factors with everything else. Products of lengths are
// bounded by spans: |g_i| <= s_A, W_i b_j <= s_A² s_B / 4, W b_j b_m <= s_A³ s_B² / 108.
#pragma once

#include "collision_core/narrow_phase/convex_pair/box_separating_axis.h"
#include "collision_core/simd/doubles_wide.h"

namespace collision::narrow_phase::box_separating_axis::COLLISION_SIMD {

using namespace simd::COLLISION_SIMD;

/// From here on [m] products of lengths, six and more, might overflow.
constexpr double kSizeMax = 1e45;
constexpr double kFaceError = 0x1p-49;
constexpr double kEdgeError = 0x1p-43;
constexpr double kSquare = 0x1p-46;
/// Of s_A³ s_B²: |N| of n' = C_j × C_m is at most 6 W b_j b_m, 1/18 of it.
constexpr double kFaceNormalMax = 0.0625;
/// More than what underflows, and above rounding of the last few steps.
constexpr double kTiny = 0x1p-1000;
constexpr double kMore = 1 + 0x1p-40;

WIDE_INLINE void Rows(const double* m, Doubles* rows) {
  rows[0] = Doubles{m[0], m[3], m[6], 0};
  rows[1] = Doubles{m[1], m[4], m[7], 0};
  rows[2] = Doubles{m[2], m[5], m[8], 0};
}

/// Σ factors[k] rows[k].
WIDE_INLINE Doubles Along(const double* factors, const Doubles* rows) {
  return (factors[0] * rows[0] + factors[1] * rows[1]) + factors[2] * rows[2];
}

/// Edges of one box, lanes: squared lengths, and the products of each with the next one.
struct Gram {
  Doubles square, off;
};
WIDE_INLINE Gram GramOf(const Doubles* rows) {
  return {(rows[0] * rows[0] + rows[1] * rows[1]) + rows[2] * rows[2],
          Magnitude((rows[0] * Next(rows[0]) + rows[1] * Next(rows[1])) + rows[2] * Next(rows[2]))};
}

/// What edges reach along each of themselves.
WIDE_INLINE Doubles OwnReach(const Gram& gram) {
  return gram.square + (gram.off + Previous(gram.off));
}

WIDE inline BoxSeparation TestAxes(const BoxPair& pair) {
  if (!(pair.size < kSizeMax)) return BoxSeparation::kUnknown;
  const double* const g = pair.of_a;
  Doubles a[3], h[3], m[3], c[3];
  Rows(g, a);
  Rows(pair.of_b, h);
  for (int i = 0; i < 3; ++i) {
    const double row[3] = {pair.rotation[i], pair.rotation[3 + i], pair.rotation[6 + i]};
    m[i] = Along(row, h);
  }
  for (int i = 0; i < 3; ++i) c[i] = Along(g + 3 * i, m);
  const Doubles p = Along(pair.d, a), q = Along(pair.d, m);
  const Gram gram_a = GramOf(a), gram_b = GramOf(m);
  const Doubles size[3] = {Magnitude(c[0]), Magnitude(c[1]), Magnitude(c[2])};
  const Doubles reach = {SumOfThree(size[0]), SumOfThree(size[1]), SumOfThree(size[2]), 0};

  const double need = pair.apart + kFaceError * pair.size;
  const double square = kMore * (need * need);
  const Doubles beside_a = Magnitude(p) - (OwnReach(gram_a) + reach);
  const Doubles beside_b = Magnitude(q) - (OwnReach(gram_b) + ((size[0] + size[1]) + size[2]));
  if (AnyOfThree((beside_a * Magnitude(beside_a) > square * gram_a.square + kTiny) |
                 (beside_b * Magnitude(beside_b) > square * gram_b.square + kTiny))) {
    return BoxSeparation::kApart;
  }

  const Doubles s = gram_a.square;
  const double off = Greater(Greater(gram_a.off[0], gram_a.off[1]), gram_a.off[2]);
  if (!(off <= kSquare * Lesser(Lesser(s[0], s[1]), s[2]))) return BoxSeparation::kUnknown;
  const double margin = kEdgeError * pair.size + pair.inside;
  bool touching = AllOfThree(-beside_a > margin * pair.span_a);
  const double faces = pair.span_a * pair.span_a * pair.span_b;
  const double error = kEdgeError * pair.size * faces, edge_margin = margin * faces;
  Doubles across[3];  // Of edges m_j and m_(j+1).
  for (int i = 0; i < 3; ++i) {
    const int k = (i + 1) % 3, l = (i + 2) % 3;
    across[i] = c[k] * Next(c[l]) - c[l] * Next(c[k]);
    const Doubles turned = Magnitude(across[i]);
    const Doubles beyond = Magnitude(p[l] * c[k] - p[k] * c[l]) -
                           ((s[k] * size[l] + s[l] * size[k]) + (turned + Previous(turned)));
    const Doubles certain = beyond - error;
    const Doubles normal = s[k] * (c[l] * c[l]) + s[l] * (c[k] * c[k]);
    if (AnyOfThree(certain * Magnitude(certain) > square * normal + kTiny))
      return BoxSeparation::kApart;
    touching = touching && AllOfThree(-beyond > edge_margin);
  }
  const Doubles volume =
      (across[0] * Previous(c[0]) + across[1] * Previous(c[1])) + across[2] * Previous(c[2]);
  const Doubles along = (p[0] * across[0] + p[1] * across[1]) + p[2] * across[2];
  const Doubles own =
      (s[0] * Magnitude(across[0]) + s[1] * Magnitude(across[1])) + s[2] * Magnitude(across[2]);
  const double face_margin = margin * (faces * pair.span_a * pair.span_b) * kFaceNormalMax;
  touching = touching && AllOfThree((own + Magnitude(volume)) - Magnitude(along) > face_margin);
  return touching ? BoxSeparation::kTouching : BoxSeparation::kUnknown;
}

}  // namespace collision::narrow_phase::box_separating_axis::COLLISION_SIMD
