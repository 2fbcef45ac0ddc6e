// What a caller has, whatever the method: one small record for each agent.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace collision::baselines {

/// An agent without errors, direction or expiry.
struct BallAgent {
  Eigen::Vector3d p_WA = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d v_WA = Eigen::Vector3d::Zero();  ///< [m/s]
  double radius = 0;                               ///< [m]
  double acceleration_max = 0;                     ///< M [m/s²]
  double stamp = 0;                                ///< When the state held, after the start [s].
};

using BallScene = std::vector<BallAgent>;

/// When two agents first meet, seconds after the start, from the later of their stamps to `limit`;
/// +infinity: not by then. Plain double without a rounding allowance, as users of other libraries
/// write it, and fast: most pairs are ruled out without a root.
double ReferenceIntersectionTime(const BallAgent& a, const BallAgent& b, double limit);

/// A box that contains an agent over a window.
struct SweptBox {
  double lower[3];
  double upper[3];
};

/// The box of the horn from its stamp to `end`. The upper faces are convex in time and the lower
/// ones concave, so both are farthest out at an end.
SweptBox SweptBoxOf(const BallAgent& agent, double end);

}  // namespace collision::baselines
