// Bounds that a motion keeps, from samples of it.
//
// Between its samples the motion is taken to be the cubic Hermite curve through their positions
// and velocities, as trajectory-player plays it. For that curve the bounds are proofs. Other
// motions lead through the same samples, and the next run is another one: bounds from states of a
// run are therefore made greater by a margin.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "client/programs/tools/suggest_bounds/motion_samples.h"

namespace collision::client {

struct BoundsRequest {
  /// Of the pieces between two samples, this share keeps each bound; 1: all.
  double quantile = 1;
  double margin = 0.1;      ///< Added, as a share, where the bounds are no proof.
  double look_ahead_s = 2;  ///< Bounds with and without a known acceleration are compared after it.
  bool is_curve = false;    ///< The samples are rows, between which the curve is the motion.
};

struct SuggestedBounds {
  std::string simulator;
  std::string name;
  std::size_t samples = 0;
  /// Between two samples without a jump; without one nothing is known, and no bound means anything.
  std::size_t pieces = 0;
  bool is_proof = false;             ///< For the curve; else an estimate, margin included.
  double acceleration_max_m_s2 = 0;  ///< Where no state tells its acceleration: M.
  double deviation_max_m_s2 = 0;     ///< Where states tell it: D and J.
  double jerk_max_m_s3 = 0;
  bool known_is_narrower = false;  ///< D and J give the smaller bound after the look-ahead.
  double speed_max_m_s = 0;
  std::optional<double> angular_acceleration_max_rad_s2 = {};  ///< Of an agent that turns.
  std::optional<DeclaredBounds> declared = {};
};

SuggestedBounds SuggestBounds(const SampledAgent& agent, const BoundsRequest& request);

/// Bounds for all of them: of each the greatest. Requires one at least.
SuggestedBounds GreatestOf(const std::vector<SuggestedBounds>& all, double look_ahead_s);

}  // namespace collision::client
