// Hubbard's face sweep: a sweep over the faces of all hypertrapezoids.
//
// Why its answer is that of all pairs, bit for bit, despite rounding:
//
// 1. Faces contain every possible answer. EarliestIntersectionOf() gives t only if boxes overlap at
// t, up to what the inputs' rounding forces and 1e-9 of the way (with directions and caps the
// boxes' first overlap may be earlier than t, never later). Each face is moved outward by 2^-44 of
// all magnitudes in the bound, and the canonical routine's allowances are some tens of 2^-53 of
// them; the sweep goes on until 2^-29 of the way and 3 ns beyond the best answer (WithEarliness()).
//
// 2. Nothing rounds after that. Faces are rounded outward to whole numbers up to 2^50, and time is
// cut into 2^30 ticks of the window: which face is higher at a tick, and when two change places,
// are exact. In metres touching is overlap; on the grid it is overlap by two units, so ties need no
// rule.
//
// 3. No pair is missed. A pair that overlaps at t either has its faces in overlapping order on all
// axes at the start, and is found there; or on some axis they stand the other way round, change
// places at s <= t, and at the last such s the other axes overlap already. The crossing is reported
// at the tick after s, and its cross-section is tested at both ends of that tick.
//
// 4. It ends. Only a face with the higher end passes another, and never comes back: at most F (F −
// 1) / 2 crossings of F faces. Many at one point change places one by one within one tick. Only
// neighbours are queued, at most F − 1 = 2 N − 1 events an axis, and only those due in the present
// stretch of the window, so the queue fits into the cache. After a stretch with few crossings the
// next one is two or eight times as long, after one with many half as long.
//
// Windows double (FirstWindow() gives the first). An agent whose stamp lies inside a window has
// faces that count from there on, prolonged back. Agents with infinite faces, and up to 32 agents
// that reach 1,000 times farther than all others and would make the grid too coarse, are tested
// against every other. If a pair meets at once, only lower indices count, and the lowest 16 agents
// are tested first: a crowd in which all agents meet costs O(N).
//
// Cost. Crossings = 6 N² t · mean |Δv| / L for N agents in a cube of side L, |Δv| along one axis:
// N²/2 pairs, and four pairs of faces on each of three axes, whatever the boxes' size.
// FaceSweepCost.CrossingsGrowAsSquareOfAgentsTimesTime holds the count to 5 % of it. Each costs
// 0.17 to 0.26 µs of a loaded core. At most 0.38 N
// events were queued at once in those scenes. About 0.5 kB an agent
// beside its bound, kept from query to query. It loses where N² t is large, and where
// everything crosses at one point; a crowd in which all boxes overlap but no pair meets costs all
// its pairs, as for any method.
#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "collision_core/broad_phase/earliest_sweep.h"
#include "collision_core/broad_phase/face_sweep/alpha_t_faces.h"
#include "collision_core/broad_phase/face_sweep/crossing_order.h"
#include "collision_core/broad_phase/face_sweep/face_sweep_start.h"

namespace collision::broad_phase {

/// Hubbard's face sweep. Faces of hypertrapezoids are grouped by normal axis; along its normal each
/// is a segment in the α–t plane, and two boxes begin to overlap where an upper face of one passes
/// a lower face of the other on one axis while their cross-sections overlap on the others. Bentley
/// and Ottmann's sweep finds all crossings of each axis in the order of time; at each such crossing
/// EarliestIntersectionOf() is asked, until the next crossing is later than the best answer. Boxes
/// that overlap at the window's start are found there.
///
/// Its answer is AllPairs' answer, bit for bit: the faces contain all that EarliestIntersectionOf()
/// can answer (kFacePadding), nothing after them is rounded (CrossingOrder), and it stops only
/// beyond WithEarliness(). The proof is at the head of this file.
///
/// Horns are swept in windows [s, s + w], w doubling, since a chord over a long window cuts far
/// outside a horn; the first is chosen by FirstWindow(). Hypertrapezoids have their one window.
/// Agents with no place on the grid (faces not finite, or far beyond all others) are tested against
/// all, and so are half-spaces, which have no faces. It pays where the first intersection comes
/// soon or N is small: the crossings of one axis grow as N² t.
///
/// A library call, not a method of the service: set all bounds, ask once. It has no incremental
/// form, since a sweep has no use for a query about one agent. Callers, none of them in the
/// service: the paper's collision loop (tests/baselines/global_loop.h) and the benchmark of the
/// broad phase (tests/bench/broad_phase/methods.h). Source: Hubbard, IEEE TVCG 1(3), 1995, section
/// 4.
class FaceSweep : public EarliestSweep {
 public:
  explicit FaceSweep(SharedRules rules = NoRules()) : AgentBounds(std::move(rules)) {}

  void Set(std::uint32_t agent, const AgentBound& bound) override;
  void Remove(std::uint32_t agent) override;
  bool SetHalfSpace(std::uint32_t agent, const HalfSpace& half_space) override;
  std::optional<intersection::IntersectingPair> Earliest(
      const intersection::BroadQuery& query) override;
  /// visits: crossings. filter_tests: tests of two boxes. rebuilds: windows.
  BroadPhaseWork work() const override { return work_; }
  bool Contains(std::uint32_t agent) const override { return Holds(bounds_, agent); }

  /// The most crossings that one axis has had queued at once, in any query: below 2 N for N agents.
  std::size_t queued_max() const { return queued_max_; }

 private:
  struct Search;

  void SweepHorns(Search* search);
  void SweepWindow(Instant start, Instant end, Search* search);
  void TestApart(Search* search);
  void TestOverlapsAtStart(Instant start, Instant end, Search* search);
  /// Once some pair meets at once only pairs of lower indices count: tests the lowest agents first,
  /// which settles a crowd of agents that all meet.
  void TestLowest(Instant start, Instant end, Search* search);
  void TestCrossings(Instant start, Instant end, Search* search);
  void Test(std::uint32_t agent, std::uint32_t partner, Search* search);

  BoundList bounds_;                       // By agent.
  std::vector<std::uint32_t> candidates_;  // Agents not yet tested against all others.
  AlphaTFaces faces_;
  FaceSweepStart at_start_;
  std::array<CrossingOrder, 3> orders_;
  BroadPhaseWork work_;
  std::size_t queued_max_ = 0;
};

}  // namespace collision::broad_phase
