// The paper's own method: a sweep over the faces of all hypertrapezoids.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "collision_core/broad_phase/alpha_t_faces.h"
#include "collision_core/broad_phase/broad_phase.h"
#include "collision_core/broad_phase/crossing_order.h"
#include "collision_core/broad_phase/face_sweep_start.h"

namespace collision {

/// Hubbard's face sweep. Faces of hypertrapezoids are grouped by normal axis; along its normal each
/// is a segment in the α–t plane, and two boxes begin to overlap where an upper face of one passes
/// a lower face of the other on one axis while their cross-sections overlap on the others. Bentley
/// and Ottmann's sweep tells all crossings of each axis in the order of time; at each such crossing
/// MeetingTime() is asked, until the next crossing is later than the best answer. Boxes that
/// overlap at the window's start are found there.
///
/// Its answer is AllPairs' answer, bit for bit: the faces contain all that MeetingTime() can
/// answer (kFacePadding), nothing after them is rounded (CrossingOrder), and it stops only beyond
/// WithEarliness(). The proof is in README.md.
///
/// Horns are swept in windows [s, s + w], w doubling, since a chord over a long window cuts far
/// outside a horn; the first is chosen by FirstWindow(). Hypertrapezoids have their one window.
/// Agents with no place on the grid (faces not finite, or far beyond all others) are asked against
/// all, and so are half-spaces, which have no faces. It pays where the first meeting comes soon or N is small: the crossings of one axis grow as
/// N² t. For one agent a sweep has no use: EarliestOf() and Meetings() ask every partner.
/// Source: Hubbard, IEEE TVCG 1(3), 1995, section 4.
class FaceSweep : public BroadPhase {
 public:
  void Put(std::uint32_t agent, const SpaceTimeBound& bound) override;
  void Remove(std::uint32_t agent) override;
  bool PutHalfSpace(std::uint32_t agent, const HalfSpace& half_space) override;
  std::optional<PairMeeting> Earliest(const BroadQuery& query) override;
  std::optional<PairMeeting> EarliestOf(std::uint32_t agent, const BroadQuery& query) override;
  /// Asks all pairs.
  void NearPairs(const BroadQuery& query, std::vector<NearPair>* pairs) override;
  void Meetings(std::uint32_t agent, Instant from, Instant until, Instant horizon, const Skip& skip,
                std::vector<Meeting>* meetings) override;
  /// visits: crossings. filter_tests: tests of two boxes. rebuilds: windows.
  BroadPhaseWork work() const override { return work_; }

  /// The most crossings queued at once, of all axes and questions: below 2 N for N agents.
  std::size_t queued_max() const { return queued_max_; }

 private:
  struct Search;

  void SweepHorns(Search* search);
  void SweepWindow(Instant start, Instant end, Search* search);
  void AskApart(Search* search);
  void AskOverlapsAtStart(Instant start, Instant end, Search* search);
  /// Once some pair meets at once only pairs of lower indices count: the lowest agents are asked
  /// first, which settles a heap of agents that all meet.
  void AskLowest(Instant start, Instant end, Search* search);
  void AskCrossings(Instant start, Instant end, Search* search);
  void Ask(std::uint32_t agent, std::uint32_t partner, Search* search);
  /// MeetingTime() of two, one of which may be a half-space, if both are there and may meet.
  PairTime TimeOf(const BroadQuery& query, std::uint32_t a, std::uint32_t b);
  bool Moves(std::uint32_t agent) const { return agent < bounds_.size() && bounds_[agent]; }
  /// One more than the greatest index, half-spaces included.
  std::uint32_t IndexEnd() const;

  std::vector<std::optional<SpaceTimeBound>> bounds_;  // By agent.
  std::vector<std::uint32_t> candidates_;              // Agents not yet asked against all others.
  AlphaTFaces faces_;
  FaceSweepStart at_start_;
  std::array<CrossingOrder, 3> orders_;
  BroadPhaseWork work_;
  std::size_t queued_max_ = 0;
};

}  // namespace collision
