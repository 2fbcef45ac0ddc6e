#include "collision_core/shape/outer_hull.h"

#include <array>
#include <limits>

#include "collision_core/base/check.h"
#include "collision_core/numeric/allowances.h"
#include "collision_core/numeric/rounding.h"

namespace collision::shape {
namespace {

using Eigen::Vector3d;

/// Cells along an edge of the cube for this many points: few points need no fine cells.
std::uint32_t CellsFor(std::size_t points) { return points <= 16 ? 2 : points <= 128 ? 4 : 8; }

/// Scales a bound for directions whose greatest coordinate is 1 to directions of length up to 1 +
/// 2^-16.
constexpr double kLonger = 1 + 0x1p-15;

/// Coordinates are below it [m]: single precision holds their squares and sums of these.
constexpr double kCoordinateMax = 1e15;

/// The share of the extent lost by casting the points, √3 u at most, along a direction of length √3
/// (u = 2^-24), and twice what three products and two sums of doubles lose.
constexpr double kStored = 4 * 0x1p-24;

/// A difference of points is off by 2^-53 of each coordinate, less than this share of the sum of
/// both lengths.
constexpr double kDifferenceRounding = 0x1p-51;

/// Added to a measure, which is 1 at most: keeps that of plates and needles away from zero.
constexpr float kMeasureMin = 0x1p-10f;

/// A point along the four corners of a patch.
using Heights = std::array<double, 4>;

double ExcessOf(const Heights& a, const Heights& b) {
  return std::max({a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]});
}

}  // namespace

/// A square of cells on a face of the cube.
struct OuterHull::Patch {
  std::uint32_t face, u, v, width, along_edge;

  /// The direction at a corner of cells, counted along the face; its coordinates are multiples of
  /// 2 / along_edge: exact.
  Vector3d Corner(std::uint32_t at_u, std::uint32_t at_v) const {
    const auto axis = static_cast<Eigen::Index>(face / 2);
    Vector3d n;
    n[axis] = face % 2 == 0 ? 1 : -1;
    n[(axis + 1) % 3] = 2.0 * at_u / along_edge - 1;
    n[(axis + 2) % 3] = 2.0 * at_v / along_edge - 1;
    return n;
  }

  std::vector<Heights> HeightsOf(const std::vector<Vector3d>& points) const {
    const Vector3d corners[] = {Corner(u, v), Corner(u, v + width), Corner(u + width, v),
                                Corner(u + width, v + width)};
    std::vector<Heights> heights;
    heights.reserve(points.size());
    for (const Vector3d& p : points) {
      heights.push_back(
          {corners[0].dot(p), corners[1].dot(p), corners[2].dot(p), corners[3].dot(p)});
    }
    return heights;
  }
};

namespace {

/// Returns the point farthest along the patch's middle, and all points that it does not exceed at
/// all four corners.
std::vector<Vector3d> Needed(const std::vector<Heights>& heights,
                             const std::vector<Vector3d>& points) {
  const auto along_middle = [](const Heights& h) { return (h[0] + h[1]) + (h[2] + h[3]); };
  std::size_t first = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (along_middle(heights[i]) > along_middle(heights[first])) first = i;
  }
  std::vector<Vector3d> needed = {points[first]};
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i != first && ExcessOf(heights[i], heights[first]) > 0) needed.push_back(points[i]);
  }
  return needed;
}

/// Chooses the cell's points one by one: each time the point that exceeds those kept by the most.
HullCell CellFor(const std::vector<Heights>& heights, const std::vector<Vector3d>& points,
                 double extent) {
  HullCell cell;
  std::vector<double> excess(points.size(), std::numeric_limits<double>::infinity());
  std::size_t next = 0;
  double left_out = 0;
  for (std::uint32_t k = 0; k < HullCell::kPoints; ++k) {
    const Eigen::Vector3f stored = points[next].cast<float>();
    cell.x[k] = stored.x(), cell.y[k] = stored.y(), cell.z[k] = stored.z();
    for (std::size_t i = 0; i < points.size(); ++i) {
      excess[i] = std::min(excess[i], ExcessOf(heights[i], heights[next]));
    }
    const auto most = std::max_element(excess.begin(), excess.end());
    left_out = std::max(0.0, *most);
    next = left_out > 0 ? static_cast<std::size_t>(most - excess.begin()) : 0;
  }
  cell.more = numeric::FloatUp((left_out + kStored * extent) * kLonger);
  return cell;
}

}  // namespace

OuterHull::OuterHull(std::span<const Vector3d> points, double rounding)
    : along_edge_(CellsFor(points.size())) {
  CORE_CHECK(!points.empty(), "a hull is around a point");
  Vector3d lower = points[0], upper = points[0];
  for (const Vector3d& p : points) {
    CORE_CHECK((p.array().abs() < kCoordinateMax).all(),
               "single precision holds the squares of coordinates", p.x(), p.y(), p.z());
    lower = lower.cwiseMin(p), upper = upper.cwiseMax(p);
  }
  origin_ = 0.5 * lower + 0.5 * upper;
  std::vector<Vector3d> seen;
  seen.reserve(points.size());
  double size = 0;
  for (const Vector3d& p : points) {
    seen.push_back(p - origin_);
    size = std::max(size, p.cwiseAbs().sum());
    extent_ = std::max(extent_, seen.back().norm());
  }
  rounding = (rounding + kDifferenceRounding * (size + origin_.cwiseAbs().sum())) * kLonger;
  rounding_ = numeric::FloatUp(rounding);
  extent_ = (extent_ + rounding) * numeric::kFewRoundingsUp + std::numeric_limits<float>::min();
  const Vector3d half = 0.5 * upper - 0.5 * lower;
  measure_ = (half / extent_).cwiseAbs2().cast<float>() + Eigen::Vector3f::Constant(kMeasureMin);
  cells_.resize(std::size_t{6} * along_edge_ * along_edge_);
  for (std::uint32_t face = 0; face < 6; ++face) {
    Divide({face, 0, 0, along_edge_, along_edge_}, seen);
  }
}

// A point that is dropped on the way is exceeded all over the patch, but for rounding, by one that
// is kept. These roundings add up over at most as many divisions as there are levels of patches,
// and kStored has room for that.
void OuterHull::Divide(const Patch& patch, const std::vector<Vector3d>& points) {
  const std::vector<Heights> heights = patch.HeightsOf(points);
  if (patch.width == 1) {
    cells_[(patch.face * along_edge_ + patch.u) * along_edge_ + patch.v] =
        CellFor(heights, points, extent_);
    return;
  }
  const std::vector<Vector3d> needed = Needed(heights, points);
  const std::uint32_t half = patch.width / 2;
  for (const std::uint32_t u : {patch.u, patch.u + half}) {
    for (const std::uint32_t v : {patch.v, patch.v + half}) {
      Divide({patch.face, u, v, half, along_edge_}, needed);
    }
  }
}

}  // namespace collision::shape
