// A stream of states, one agent at a time, each within what the last one allowed.
#pragma once

#include <vector>

#include "tests/baselines/ball_scene.h"

namespace collision::bench {

struct UpdateStream {
  struct Update {
    std::uint32_t agent;
    baselines::BallAgent state;  ///< Its stamp is the time of the update.
  };
  baselines::BallScene start;
  std::vector<Update> updates;
  std::size_t warm_up = 0;  ///< So many of them before a steady state.
  double horizon = 0;       ///< Each update asks for the first meeting within this [s].
  double period = 0;        ///< Longest time between two states of an agent [s].
};

/// Balls around random homes, one part in a hundred of the volume being cubes as in the paper,
/// swing about their homes with up to 0.9 M, and never touch; but their bounds meet again and
/// again. Each tells its state 20 times a second, in an order drawn once. After half a second, the
/// warm-up, every agent has been renewed ten times: `updates` follow it.
UpdateStream MakeUpdates(std::uint32_t agents, std::size_t updates);

}  // namespace collision::bench
