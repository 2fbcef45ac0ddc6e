// Turk's uniform grid, in a hash table made anew each frame.
#pragma once

#include <vector>

#include "tests/baselines/collision_loop.h"

namespace collision::baselines {

/// Each cube is entered into every cell that it overlaps, and tested against those already there.
/// Two cells of one slot cost a test, not an answer. Source: Turk, "Interactive collision detection
/// for molecular graphics", 1989.
class TurkHash : public CollisionLoop {
 public:
  /// `cell`: its side [m].
  explicit TurkHash(double cell) : cell_(cell) {}

  std::optional<CubePair> Look(const MovingCubes& cubes) override;

 private:
  struct Entry {
    std::uint32_t cube;
    std::int32_t next;
  };

  void EnterAndTest(const MovingCubes& cubes, std::uint32_t cube, std::size_t slot,
                    std::optional<CubePair>* first);

  double cell_;
  std::vector<std::int32_t> slots_;  ///< First entry, or -1.
  std::vector<Entry> entries_;
};

}  // namespace collision::baselines
