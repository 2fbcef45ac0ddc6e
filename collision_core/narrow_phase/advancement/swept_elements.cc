#include "collision_core/narrow_phase/advancement/swept_elements.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "collision_core/geometry/triangle/triangle_directions.h"
#include "collision_core/narrow_phase/pose/boxed_triangle.h"
#include "collision_core/narrow_phase/separation/element.h"

namespace collision::narrow_phase {
namespace {

// The direction of a way as short as this, as a share of the triangles' size, is uncertain.
constexpr double kShortWay = 0x1p-20;

// The greatest distance of a corner from A's reference point.
double FarOfA(const geometry::TrianglePoints& corners) {
  return std::max({corners[0].norm(), corners[1].norm(), corners[2].norm()});
}

// The greatest distance of an element from its body's reference point; 0 for a ball, whose points
// move with its centre.
double FarOf(const BodyTree& body, ElementIndex element) {
  if (body.shape() == nullptr) return 0;
  if (body.shape()->IsSolid(element)) return body.shape()->SolidAt(element).facts().radius;
  return FarOfA(CornersOf(*body.shape(), element));
}

}  // namespace

double SweptElements::FarOfB(const geometry::TrianglePoints& corners) const {
  double far = 0;
  for (const auto& y : corners) far = std::max(far, (y - swept_.pose.p_AB).norm());
  return far;
}

MovingSet SweptElements::MovingA(ElementIndex element) const {
  const Eigen::Vector3d spin = a_.shape() ? swept_.spin_A : Eigen::Vector3d::Zero();
  return {SetOf(a_, element), {Eigen::Vector3d::Zero(), spin, Eigen::Vector3d::Zero()}};
}

// What is not known of its turning counts with the growth.
MovingSet SweptElements::MovingB(ElementIndex element) const {
  RelativePose pose = swept_.pose;
  pose.chord_B = 0;
  const Eigen::Vector3d spin = b_.shape() ? swept_.spin_B : Eigen::Vector3d::Zero();
  return {PosedB(SetOf(b_, element), pose), {swept_.velocity, spin, pose.p_AB}};
}

double SweptElements::SolidsApartFor(ElementPair elements, double h) const {
  const SweptPose::Growth used = motion_.UsedUp(0, FarOf(a_, elements.a), FarOf(b_, elements.b));
  return narrow_phase::ApartFor({MovingA(elements.a), MovingB(elements.b), used}, h, duration_,
                                &work_);
}

double SweptElements::BallApartFor(const CentredBall& ball_of_a,
                                   const geometry::TrianglePoints& corners, double h) const {
  const auto& [x, radius] = ball_of_a;
  const auto ball = OfA(std::array{x});
  const auto b = OfB(corners);
  const Eigen::Vector3d way = geometry::DistanceOf(ball.At(h)[0], b.At(h)).b - ball.At(h)[0];
  const SweptPose::Growth used = motion_.UsedUp(radius, x.norm(), FarOfB(corners));
  return ApartAlong(way, SweptPoints<1, 3>{ball, b, used}, h, duration_);
}

double SweptElements::BallApartFor(const geometry::TrianglePoints& corners,
                                   const CentredBall& ball_of_b, double h) const {
  const auto& [x, radius] = ball_of_b;
  const auto a = OfA(corners);
  const auto ball = OfB(std::array{x});
  const Eigen::Vector3d way = ball.At(h)[0] - geometry::DistanceOf(ball.At(h)[0], a.At(h)).b;
  const double far_b = (x - swept_.pose.p_AB).norm();
  const SweptPose::Growth used = motion_.UsedUp(radius, FarOfA(corners), far_b);
  return ApartAlong(way, SweptPoints<3, 1>{a, ball, used}, h, duration_);
}

double SweptElements::ApartFor(const CentredBall& ball_of_a, ElementIndex triangle_of_b) const {
  return BallApartFor(ball_of_a, CornersOf(*b_.shape(), triangle_of_b, swept_.pose), 0);
}

double SweptElements::ApartFor(ElementIndex triangle_of_a, const CentredBall& ball_of_b) const {
  return BallApartFor(CornersOf(*a_.shape(), triangle_of_a), ball_of_b, 0);
}

double SweptElements::ApartFor(ElementPair elements, double h) const {
  if (AnySolid(a_, b_, elements)) return SolidsApartFor(elements, h);
  if (!a_.shape()) {
    const geometry::TrianglePoints corners = CornersOf(*b_.shape(), elements.b, swept_.pose);
    return BallApartFor({Eigen::Vector3d(0, 0, 0), a_.reach()}, corners, h);
  }
  const geometry::TrianglePoints corners_a = CornersOf(*a_.shape(), elements.a);
  if (!b_.shape()) return BallApartFor(corners_a, {swept_.pose.p_AB, b_.reach()}, h);
  const geometry::TrianglePoints corners_b = CornersOf(*b_.shape(), elements.b, swept_.pose);
  const SweptPoints<3, 3> triangles{OfA(corners_a), OfB(corners_b),
                                    motion_.UsedUp(0, FarOfA(corners_a), FarOfB(corners_b))};
  const geometry::TrianglePoints at_a = triangles.a.At(h), at_b = triangles.b.At(h);
  const geometry::TriangleDistance found = geometry::DistanceOf(at_a, at_b);
  const Eigen::Vector3d d = found.b - found.a;
  double longest = ApartAlong(d, triangles, h, duration_);
  const double size = (at_a[1] - at_a[0]).cwiseAbs().sum() + (at_b[1] - at_b[0]).cwiseAbs().sum();
  if (d.squaredNorm() > kShortWay * kShortWay * size * size) return longest;
  work_.Spend(kTrianglePairUnits);
  geometry::ForEachFeatureDirection(at_a, at_b, [&](const Eigen::Vector3d& n) {
    longest = std::max({longest, ApartAlong(n, triangles, h, duration_),
                        ApartAlong(Eigen::Vector3d(-n), triangles, h, duration_)});
  });
  return longest;
}

}  // namespace collision::narrow_phase
