// Which boxes overlap at the start of a window: sort and sweep.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "collision_core/broad_phase/face_sweep/alpha_t_faces.h"

namespace collision::broad_phase {

/// Finds the boxes that overlap at a window's start, by the order of their faces alone: a lower
/// face before an upper one counts as overlap. A pair that is not found here has its faces the
/// other way round on some axis, and CrossingOrder reports when they change places.
///
/// It sweeps along the axis on which the fewest pairs overlap, in strips across the axis with the
/// second fewest. A strip is as many faces wide as a box spans on average, so that a box lies in
/// two strips on average, whatever the scene. The box of an agent above its own speed cap may be
/// inverted, its lower face above its upper one: it overlaps the boxes that reach from its lower
/// face to its upper one.
class FaceSweepStart {
 public:
  /// Receives a pair of slots, lower < higher. Returns the *ceiling*: pairs whose lower slot is
  /// above it are no longer needed. It never rises.
  using Found = std::function<std::uint32_t(std::uint32_t lower, std::uint32_t higher)>;

  /// `orders`: the sorted faces of each axis, all of the same slots. `ceiling`: the first one.
  /// Returns the number of tests of two boxes.
  std::uint64_t ForEach(const std::array<const std::vector<AlphaTFace>*, 3>& orders,
                        std::uint32_t ceiling, const Found& found);

 private:
  /// One box in a strip, as places in the orders.
  struct Entry {
    std::uint32_t slot;
    std::uint32_t end;  // Of the box, along the sweep.
    std::uint32_t lower_across, upper_across;
    std::uint32_t lower_other, upper_other;
  };
  /// The boxes in a strip, by whether their slot is up to the ceiling: two slots above it need not
  /// be compared.
  struct Strip {
    std::vector<Entry> useful;
    std::vector<Entry> others;
  };

  void ChooseAxes(const std::array<const std::vector<AlphaTFace>*, 3>& orders);
  Entry EntryOf(std::uint32_t slot) const;
  void Enter(const Entry& entry, const Found& found);
  void TestAll(const Entry& entry, std::uint32_t strip, std::vector<Entry>* actives,
               const Found& found);

  std::array<std::vector<std::uint32_t>, 3> places_;  // By axis, then face.
  int along_ = 0, across_ = 1, other_ = 2;
  std::uint32_t strip_width_ = 1;
  std::vector<Strip> strips_;
  std::uint32_t ceiling_ = 0;
  std::uint64_t tests_ = 0;
};

}  // namespace collision::broad_phase
