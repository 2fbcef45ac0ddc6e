// The naive loop over a scene's true motion: every pair in every frame, and nothing between.
#pragma once

#include <cstdint>
#include <vector>

#include "client/checker/motion/true_contacts.h"

namespace collision::bench {

struct SteppingResult {
  std::uint64_t frames = 0;
  std::uint64_t pair_tests = 0;   ///< Of two balls.
  std::uint64_t shape_tests = 0;  ///< Of pairs with shapes whose balls overlap.
  double ball_seconds = 0;        ///< Processor's time of the loop over pairs.
  double shape_seconds = 0;       ///< And of the exact tests.
  std::size_t contacts = 0;       ///< True ones, certain.
  std::size_t missed = 0;         ///< In no frame in contact.
  std::vector<double> late;       ///< Of the others: from the true begin to the first frame [s].
};

/// Steps through the time that the motions cover, `rate` frames a second from its begin, tests all
/// pairs of balls, and exactly those with shapes whose balls overlap. Motions are exact: what is
/// missed is missed for the frames' sake only.
SteppingResult StepThrough(const std::vector<checker::AgentMotion>& motions,
                           const std::vector<checker::TrueContact>& contacts, double rate);

}  // namespace collision::bench
