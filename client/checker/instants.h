// What a motion says about one instant.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "client/checker/motion/true_contacts.h"

namespace collision::checker {

/// States and logs are rounded differently [m].
inline constexpr double kLengthTolerance = 1e-6;

/// The pieces that contain an instant. Where one ends and the next begins there are two, and an
/// event may refer to either if the agent jumps there.
inline std::vector<const Piece*> PiecesAt(const AgentMotion& motion, std::int64_t t_ns) {
  std::vector<const Piece*> found;
  auto it = std::partition_point(motion.pieces.begin(), motion.pieces.end(),
                                 [&](const Piece& piece) { return piece.t1_ns < t_ns; });
  for (; it != motion.pieces.end() && it->t0_ns <= t_ns; ++it) found.push_back(&*it);
  return found;
}

}  // namespace collision::checker
