#include "collision_core/geometry/convex/epa_faces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "collision_core/numeric/allowances.h"
#include "collision_core/numeric/exact_sign.h"

namespace collision::geometry {
namespace {

using Eigen::Vector3d;

/// The least sine of the angle between two edges of a face; with a smaller one it is a needle.
constexpr double kNeedle = 1e-10;

/// Relative to |y_0| |e_1| |e_2|: more than twice what a computed y_0·(e_1 × e_2) is off by, 12u
/// (IsSeenFromWithin).
constexpr double kTripleError = 32 * numeric::kUnitRoundoff;

/// Relative to S: n·y is off by 3u |y| <= 3u √3 S, and |n| by 4u, which counts of the distance, at
/// most S; below 9.2u, rounded up.
constexpr double kDistanceError = 12 * numeric::kUnitRoundoff;

constexpr int kNext[3] = {1, 2, 0};

}  // namespace

bool PolytopeFaces::Make(int i, int j, int k, Face* face) const {
  const Vector3d &a = points_[i].y, &b = points_[j].y, &c = points_[k].y;
  const Vector3d ab = b - a, ac = c - a, normal = ab.cross(ac);
  const double length = normal.norm();
  if (!(length > kNeedle * std::sqrt(ab.squaredNorm() * ac.squaredNorm()))) return false;
  face->corners = {i, j, k};
  face->normal = normal / length;
  face->distance = std::min({face->normal.dot(a), face->normal.dot(b), face->normal.dot(c)});
  face->is_final = face->is_visible = false;
  return true;
}

void PolytopeFaces::Start(const std::array<Point, 4>& tetrahedron, double tolerance) {
  tolerance_ = tolerance;
  point_count_ = 4;
  for (int i = 0; i < 4; ++i) points_[i] = tetrahedron[i];
  const auto& p = points_;
  const Vector3d normal = (p[1].y - p[0].y).cross(p[2].y - p[0].y);
  if (normal.dot(p[3].y - p[0].y) > 0) std::swap(points_[1], points_[2]);
  // The fourth point is behind 0, 1, 2 now.
  constexpr int kCorners[4][3] = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  constexpr int kNeighbours[4][3] = {{1, 2, 3}, {3, 2, 0}, {1, 3, 0}, {2, 1, 0}};
  face_count_ = 0;
  for (int i = 0; i < 4; ++i) {
    if (!Make(kCorners[i][0], kCorners[i][1], kCorners[i][2], &faces_[i])) return;
    std::copy_n(kNeighbours[i], 3, faces_[i].neighbours.begin());
  }
  face_count_ = 4;
}

int PolytopeFaces::Nearest() const {
  int nearest = -1;
  for (int i = 0; i < face_count_; ++i) {
    if (faces_[i].is_final) continue;
    if (nearest < 0 || faces_[i].distance < faces_[nearest].distance) nearest = i;
  }
  return nearest;
}

bool PolytopeFaces::Add(int beyond, const Point& point) {
  if (point_count_ == kPointsMax) return false;
  points_[point_count_] = point;
  // A face in whose plane the point lies counts as hidden at first, and as visible in a second
  // attempt.
  for (const double tolerance : {tolerance_, -tolerance_}) {
    const bool fits = FindHorizon(beyond, point.y, tolerance) && MakeCone() && JoinCone();
    for (int i = 0; i < visible_count_; ++i) faces_[visible_[i]].is_visible = false;
    if (!fits) continue;
    Replace();
    ++point_count_;
    return true;
  }
  return false;
}

bool PolytopeFaces::FindHorizon(int beyond, const Vector3d& y, double tolerance) {
  edge_count_ = 0;
  visible_[0] = beyond;
  visible_count_ = 1;
  faces_[beyond].is_visible = true;
  for (int i = 0; i < visible_count_; ++i) {
    for (const int neighbour : faces_[visible_[i]].neighbours) {
      Face& face = faces_[neighbour];
      if (face.is_visible || !(face.normal.dot(y) - face.distance > tolerance)) continue;
      face.is_visible = true;
      visible_[visible_count_++] = neighbour;
    }
  }
  for (int i = 0; i < visible_count_; ++i) {
    const Face& face = faces_[visible_[i]];
    for (int side = 0; side < 3; ++side) {
      const int neighbour = face.neighbours[side];
      if (faces_[neighbour].is_visible) continue;
      const auto& back = faces_[neighbour].neighbours;
      const auto& corners = faces_[neighbour].corners;
      int at = 0;
      while (at < 2 && !(back[at] == visible_[i] && corners[at] == face.corners[kNext[side]])) ++at;
      horizon_[edge_count_++] = {face.corners[side], face.corners[kNext[side]], neighbour, at};
    }
  }
  return edge_count_ >= 3 && face_count_ - visible_count_ + edge_count_ <= kEpaFacesMax;
}

bool PolytopeFaces::MakeCone() {
  for (int i = 0; i < edge_count_; ++i) {
    if (!Make(horizon_[i].from, horizon_[i].to, point_count_, &cone_[i])) return false;
  }
  return true;
}

/// The horizon must be one loop: then each of its points starts one edge. Neighbours within the
/// cone are identified by their number in the cone for now.
bool PolytopeFaces::JoinCone() {
  for (int i = 0; i < edge_count_; ++i) starts_[horizon_[i].from] = starts_[horizon_[i].to] = -1;
  for (int i = 0; i < edge_count_; ++i) {
    if (starts_[horizon_[i].from] >= 0) return false;
    starts_[horizon_[i].from] = i;
  }
  for (int i = 0; i < edge_count_; ++i) {
    const int next = starts_[horizon_[i].to];
    if (next < 0) return false;
    cone_[i].neighbours = {horizon_[i].face, next, -1};
  }
  for (int i = 0; i < edge_count_; ++i) cone_[cone_[i].neighbours[1]].neighbours[2] = i;
  return true;
}

/// The cone's faces take the places of the visible ones, then new places; places left over are
/// filled with the last faces.
void PolytopeFaces::Replace() {
  std::array<int, kEpaFacesMax> place;
  for (int i = 0; i < edge_count_; ++i) {
    place[i] = i < visible_count_ ? visible_[i] : face_count_++;
  }
  for (int i = 0; i < edge_count_; ++i) {
    Face& face = faces_[place[i]];
    face = cone_[i];
    for (int side = 1; side < 3; ++side) face.neighbours[side] = place[face.neighbours[side]];
    faces_[horizon_[i].face].neighbours[horizon_[i].side] = place[i];
  }
  if (edge_count_ >= visible_count_) return;
  std::sort(visible_.begin() + edge_count_, visible_.begin() + visible_count_);
  for (int i = visible_count_ - 1; i >= edge_count_; --i) {
    const int last = --face_count_, hole = visible_[i];
    if (hole == last) continue;
    faces_[hole] = faces_[last];
    for (const int neighbour : faces_[hole].neighbours) {
      auto& back = faces_[neighbour].neighbours;
      std::replace(back.begin(), back.end(), last, hole);
    }
  }
}

// With the corners y_0, y_1, y_2 and edges e_1, e_2 from the first: y_0·(e_1 × e_2) is computed to
// within 12 · 2^-53 |y_0| |e_1| |e_2|; where that does not decide the sign, exact arithmetic does.
bool PolytopeFaces::IsSeenFromWithin(const Face& face) const {
  const Vector3d& a = points_[face.corners[0]].y;
  const Vector3d &b = points_[face.corners[1]].y, &c = points_[face.corners[2]].y;
  const Vector3d ab = b - a, ac = c - a;
  const double bound = a.cwiseAbs().sum() * ab.cwiseAbs().sum() * ac.cwiseAbs().sum();
  if (a.dot(ab.cross(ac)) > kTripleError * bound + kSupportUnderflow) return true;
  return numeric::OrientationSign(a, b, c, Vector3d::Zero()) == -1;
}

double PolytopeFaces::CertainInnerRadius(double point_error, double size) const {
  if (face_count_ < 4) return -numeric::kInfinity;
  double least = numeric::kInfinity;
  for (int i = 0; i < face_count_; ++i) {
    least = std::min(least, faces_[i].distance);
    if (!(least > point_error)) return -numeric::kInfinity;
  }
  for (int i = 0; i < face_count_; ++i) {
    if (!IsSeenFromWithin(faces_[i])) return -numeric::kInfinity;
  }
  return numeric::AddDown(least, -numeric::AddUp(point_error, kDistanceError * size));
}

}  // namespace collision::geometry
