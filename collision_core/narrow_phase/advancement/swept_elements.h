// How long two elements of two swept bodies stay apart.
//
// Each pair is convex, so its own direction may be used: the one between the nearest points at the
// instant asked for. Nearest points a short way apart give no direction; there the normals and
// edges of two triangles do: any direction is right, the best is taken.
#pragma once

#include "collision_core/base/work_budget.h"
#include "collision_core/geometry/triangle/triangle_pair.h"
#include "collision_core/narrow_phase/advancement/point_motion.h"
#include "collision_core/narrow_phase/advancement/swept_convex_pair.h"
#include "collision_core/narrow_phase/advancement/swept_points.h"
#include "collision_core/narrow_phase/pose/pair_parts.h"

namespace collision::narrow_phase {

/// A ball that moves with its centre.
struct CentredBall {
  Eigen::Vector3d centre;  ///< In A's body frame at the start [m].
  double radius;
};

/// Queries of two swept bodies, element by element. All results include the uncertainty of the
/// pose, of the motion and of rounding.
class SweptElements {
 public:
  /// What is passed in outlives this. `duration`: no answer need reach beyond it [s].
  SweptElements(const SweptPair& pair, const PointMotion& motion, double duration, WorkBudget* work)
      : a_(pair.a),
        b_(pair.b),
        swept_(pair.swept),
        motion_(motion),
        duration_(duration),
        work_(*work) {}

  /// For how many seconds from `h` on two elements certainly stay apart; 0 if nothing is certain,
  /// +infinity: for the rest of the duration. A body that is a ball counts as its own element.
  double ApartFor(ElementPair elements, double h) const;

  /// The same from the start on for a ball fixed to A and a triangle of B.
  double ApartFor(const CentredBall& ball_of_a, ElementIndex triangle_of_b) const;
  /// The same from the start on for a triangle of A and a ball fixed to B.
  double ApartFor(ElementIndex triangle_of_a, const CentredBall& ball_of_b) const;

 private:
  double SolidsApartFor(ElementPair elements, double h) const;
  double BallApartFor(const CentredBall& ball_of_a, const geometry::TrianglePoints& corners,
                      double h) const;
  double BallApartFor(const geometry::TrianglePoints& corners, const CentredBall& ball_of_b,
                      double h) const;
  MovingSet MovingA(ElementIndex element) const;
  MovingSet MovingB(ElementIndex element) const;
  double FarOfB(const geometry::TrianglePoints& corners) const;

  template <std::size_t kPoints>
  MovingPoints<kPoints> OfA(const std::array<Eigen::Vector3d, kPoints>& points) const {
    MovingPoints<kPoints> moving{points, {}};
    for (std::size_t i = 0; i < kPoints; ++i) {
      moving.velocities[i] = motion_.VelocityOfA(points[i]);
    }
    return moving;
  }

  template <std::size_t kPoints>
  MovingPoints<kPoints> OfB(const std::array<Eigen::Vector3d, kPoints>& points) const {
    MovingPoints<kPoints> moving{points, {}};
    for (std::size_t i = 0; i < kPoints; ++i) {
      moving.velocities[i] = motion_.VelocityOfB(points[i]);
    }
    return moving;
  }

  const BodyTree& a_;
  const BodyTree& b_;
  const SweptPose& swept_;
  const PointMotion& motion_;
  const double duration_;
  WorkBudget& work_;
};

}  // namespace collision::narrow_phase
