#include "collision_core/geometry/convex/convex_points.h"

#include <array>

#include "collision_core/base/check.h"
#include "collision_core/numeric/interval.h"

namespace collision::geometry {
namespace {

using Eigen::Vector3d;

/// Up to this many points, a query tests all of them.
constexpr std::size_t kScanMax = 8;

/// Cells along an edge of the cube: finer for more points, so that a cell keeps about four.
std::uint32_t CellsFor(std::size_t points) {
  if (points <= kScanMax) return 0;
  if (points <= 512) return 8;
  return points <= 4096 ? 16 : 32;
}

/// On a face of the cube |n| is from 1 to √3, and a difference of two products n·x is computed to
/// within 11 · 2^-53 reach. With a margin of 2^-48 reach a point is left out only where it is
/// certainly exceeded: on the way to the finest cells, so that nothing adds up.
constexpr double kCertain = 0x1p-48;

/// Coordinates are below it [m], so that their squares and sums of these stay finite.
constexpr double kCoordinateMax = 1e100;

}  // namespace

ConvexPoints::ConvexPoints(std::span<const Vector3d> points)
    : points_(points.begin(), points.end()),
      all_(static_cast<std::uint32_t>(points.size())),
      cells_(CellsFor(points.size())) {
  for (const Vector3d& p : points_) {
    CORE_CHECK((p.array().abs() < kCoordinateMax).all(), "the squares of coordinates are finite",
               p.x(), p.y(), p.z());
    reach_ = std::max(reach_, numeric::Norm(numeric::IntervalVector(p)).upper);
  }
  SetBlocks();
  if (cells_ == 0) return;
  std::vector<std::uint32_t> candidates(points_.size());
  for (std::uint32_t i = 0; i < candidates.size(); ++i) candidates[i] = i;
  of_cell_.resize(6 * cells_ * cells_);
  for (std::uint32_t face = 0; face < 6; ++face) Divide({face, 0, 0, cells_}, candidates);
  for (const auto& kept : of_cell_) {
    starts_.push_back(static_cast<std::uint32_t>(kept_.size()));
    kept_.insert(kept_.end(), kept.begin(), kept.end());
  }
  starts_.push_back(static_cast<std::uint32_t>(kept_.size()));
  of_cell_ = {};
}

void ConvexPoints::SetBlocks() {
  for (const Vector3d& p : points_) extents_ = extents_.cwiseMax(p.cwiseAbs());
  if (points_.size() > kBlockPointsMax) return;
  for (std::size_t first = 0; first < points_.size(); first += 4) {
    for (int axis = 0; axis < 3; ++axis) {
      for (std::size_t i = first; i < first + 4; ++i) {
        blocks_.push_back(points_[std::min(i, points_.size() - 1)][axis]);
      }
    }
  }
}

/// The direction at a corner of cells; coordinates are multiples of 2 / cells_: exact.
Vector3d ConvexPoints::CornerOf(const Patch& patch, std::uint32_t u, std::uint32_t v) const {
  const int axis = static_cast<int>(patch.face / 2);
  Vector3d n;
  n[axis] = patch.face % 2 ? -1 : 1;
  n[(axis + 1) % 3] = 2.0 * u / cells_ - 1;
  n[(axis + 2) % 3] = 2.0 * v / cells_ - 1;
  return n;
}

void ConvexPoints::Divide(const Patch& patch, std::vector<std::uint32_t> candidates) {
  if (patch.width == 1) {
    // A point is left out as well where it is exceeded but for rounding: by less than 11u reach,
    // and a direction that was sorted into the wrong cell by rounding costs less than 2u reach
    // more.
    of_cell_[(patch.face * cells_ + patch.u) * cells_ + patch.v] = Needed(patch, 0, candidates);
    return;
  }
  candidates = Needed(patch, kCertain * reach_, candidates);
  const std::uint32_t half = patch.width / 2;
  for (const std::uint32_t u : {patch.u, patch.u + half}) {
    for (const std::uint32_t v : {patch.v, patch.v + half}) {
      Divide({patch.face, u, v, half}, candidates);
    }
  }
}

/// Returns the point furthest along the patch's middle, and all points that it does not exceed by
/// the margin at all corners.
std::vector<std::uint32_t> ConvexPoints::Needed(
    const Patch& patch, double margin, const std::vector<std::uint32_t>& candidates) const {
  const std::uint32_t u = patch.u + patch.width, v = patch.v + patch.width;
  const Vector3d corners[] = {CornerOf(patch, patch.u, patch.v), CornerOf(patch, patch.u, v),
                              CornerOf(patch, u, patch.v), CornerOf(patch, u, v)};
  const Vector3d middle = 0.5 * (corners[0] + corners[3]);
  std::uint32_t best = candidates[0];
  for (const std::uint32_t i : candidates) {
    if (middle.dot(points_[i]) > middle.dot(points_[best])) best = i;
  }
  std::array<double, 4> most;
  for (int k = 0; k < 4; ++k) most[k] = corners[k].dot(points_[best]) - margin;
  std::vector<std::uint32_t> needed = {best};
  for (const std::uint32_t i : candidates) {
    bool exceeded = true;
    for (int k = 0; k < 4 && exceeded; ++k) exceeded = corners[k].dot(points_[i]) <= most[k];
    if (!exceeded && i != best) needed.push_back(i);
  }
  return needed;
}

}  // namespace collision::geometry
