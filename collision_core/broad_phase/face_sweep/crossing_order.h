// Bentley and Ottmann's sweep over the faces of one axis.
#pragma once

#include <cstdint>
#include <vector>

#include "collision_core/broad_phase/face_sweep/alpha_t_faces.h"
#include "collision_core/broad_phase/face_sweep/crossing_queue.h"

namespace collision::broad_phase {

/// Two faces change places: `rising` was below `falling` up to tick − 1 and is above it at `tick`.
struct FaceCrossing {
  std::uint32_t tick;
  AlphaTFace rising;
  AlphaTFace falling;
};

/// Keeps the faces of one axis in their order while time runs through the window, and reports each
/// change of places in the order of time. Time is cut into 2^30 ticks; as ticks and coordinates are
/// whole numbers, no answer here is rounded:
///   - after all crossings up to a tick, the faces are in order at that tick. Coincident faces need
///     no crossing; where many meet at one point, their neighbours change places one by one, all at
///     that tick;
///   - only a face whose end lies higher passes another, and then never comes back: each pair
///     crosses at most once, which bounds all crossings by F (F − 1) / 2 of F faces;
///   - only neighbours are queued: never more than F − 1 events, O(F) memory.
/// Source: Bentley and Ottmann, "Algorithms for reporting and counting geometric intersections",
/// IEEE Trans. Computers C-28(9), 1979, as Hubbard 1995 uses it.
class CrossingOrder {
 public:
  static constexpr int kTickBits = 30;
  static constexpr std::uint32_t kTicks = 1u << kTickBits;

  /// Sorts `faces` by start, then end, then name, and begins at tick 0.
  void Start(const std::vector<AlphaTFace>& faces);

  /// The faces in their present order, from below.
  const std::vector<AlphaTFace>& faces() const { return faces_; }

  /// Whether there is another crossing up to `limit` <= kTicks; if so, it is at tick().
  bool HasNext(std::uint32_t limit);
  std::uint32_t tick() const { return queue_.tick(); }
  /// Swaps the next pair and returns it. Requires HasNext().
  FaceCrossing Next();

  /// The most events that were queued at once since Start().
  std::size_t queued_max() const { return queued_max_; }

 private:
  /// Sorts into as many buckets as faces, then each bucket: in clusters that is a plain sort.
  void SortInto(const std::vector<AlphaTFace>& faces);
  /// Queues the neighbours `place` and `place` + 1 if they cross by due_.
  void Schedule(std::uint32_t place);
  /// Moves due_ on and queues what has become due.
  void Extend();

  std::vector<AlphaTFace> faces_;
  std::vector<std::uint32_t> bucket_ends_;
  CrossingQueue queue_;
  // Only crossings up to due_ are queued, so that the queue of a stretch of the window fits into
  // the cache. One pass over the order per stretch finds those that have become due; the length of
  // a stretch follows the number of crossings in the one before.
  std::uint32_t due_ = 0;
  std::uint32_t stretch_ = 0;
  std::size_t crossings_in_stretch_ = 0;
  std::size_t queued_max_ = 0;
};

/// The first tick at which `below` is above `above`. Requires below.start <= above.start and
/// below.end > above.end.
std::uint32_t CrossingTick(const AlphaTFace& below, const AlphaTFace& above);

}  // namespace collision::broad_phase
