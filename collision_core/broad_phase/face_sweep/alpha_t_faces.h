// The faces of all hypertrapezoids over one window, as segments on a grid of whole numbers.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "collision_core/broad_phase/agent_bound.h"
#include "collision_core/intersection/pair_rules.h"

namespace collision::broad_phase {

/// One face of one hypertrapezoid, seen along its normal: a segment in the plane of that coordinate
/// (α) and time, from the window's start to its end. In grid units.
struct AlphaTFace {
  std::int64_t start;
  std::int64_t end;
  std::uint32_t face;  ///< 2 · slot, and 1 more if it is the upper one.

  bool is_upper() const { return face & 1; }
  std::uint32_t slot() const { return face >> 1; }
};

/// The six faces of one agent over a window: lower x, y, z, upper x, y, z. In metres or grid units.
struct FaceLines {
  std::array<double, 6> start;
  std::array<double, 6> end;
};

/// Lines that bound the horn (and the hypertrapezoid) from outside wherever it counts in [start,
/// end], each moved outward by kFacePadding. nullopt: not finite.
///
/// An agent meets no other before its stamp, so faces count only from a stamp inside the window on.
/// If the stamp lies in the first half, each face is the chord from the stamp to the end, prolonged
/// back to the start (and there not inside the face at the stamp, so that no box is turned inside
/// out). Else a prolonged chord would lead far outside; the face is then constant, the outer one of
/// its values at stamp and end. A convex face lies inside both. Requires start <= end and
/// stamp <= end.
std::optional<FaceLines> FaceLinesOf(const motion::SpaceTimeBound& bound, Instant start,
                                     Instant end);

/// How far faces move outward, as a part of all magnitudes that enter the agent's bound over the
/// window. EarliestIntersectionOf() may let a pair meet that is apart by what its inputs' rounding
/// forces: some tens of units in the last place (2^−53) of these magnitudes. With the padding such
/// a pair's boxes overlap nevertheless, with room for 2^9 of them.
inline constexpr double kFacePadding = 0x1p-44;

/// Rounds the faces of many agents to whole numbers, so that everything after it is exact: which of
/// two faces is higher at a tick, and at which tick they change places. Lower faces round down,
/// upper ones up, each by one unit more than needed: boxes that touch in metres overlap on the
/// grid.
class AlphaTFaces {
 public:
  /// Coordinates lie within ±2^50, a little more with rounding.
  static constexpr int kCoordinateBits = 50;
  /// Agents that reach so much farther than the others that the grid would be too coarse for them
  /// are set apart: at most one in this many, and never more than kApartMax.
  static constexpr std::size_t kAgentsPerApart = 64;
  static constexpr std::size_t kApartMax = 32;

  /// Takes those of `agents` that count in [start, end]: not expired before it, and stamped by its
  /// end. Each is grown by half of its greatest margin, so that pairs within a margin overlap.
  void Build(const BoundList& bounds, const std::vector<std::uint32_t>& agents, Instant start,
             Instant end, const intersection::PairRules& rules = {});

  /// The agent in each slot, ascending.
  const std::vector<std::uint32_t>& agents() const { return agents_; }
  /// Agents that have no place on the grid: faces not finite, or too far out.
  const std::vector<std::uint32_t>& apart() const { return apart_; }
  /// The faces with normals along `axis` in the order of slots, lower before upper.
  const std::vector<AlphaTFace>& faces(int axis) const { return faces_[axis]; }
  /// Whether the boxes of two slots may overlap at one of two times, given as fractions of the
  /// window. True where rounding leaves it open.
  bool MayOverlap(std::uint32_t slot, std::uint32_t other, double fraction_1,
                  double fraction_2) const;

 private:
  void FindOrigin();
  /// Sets the farthest few apart if the others are much nearer; returns the farthest that is left.
  double SetFarthestApart();
  void PutOnGrid(double reach);

  std::vector<std::uint32_t> agents_;
  std::vector<std::uint32_t> apart_;
  std::vector<FaceLines> lines_;  // By slot; on the grid once built.
  std::array<double, 3> origin_;
  std::vector<double> scratch_;
  std::array<std::vector<AlphaTFace>, 3> faces_;
};

}  // namespace collision::broad_phase
