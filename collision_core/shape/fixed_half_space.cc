#include "collision_core/shape/fixed_half_space.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "collision_core/base/number_text.h"
#include "collision_core/numeric/interval.h"
#include "collision_core/numeric/rounding.h"

namespace collision::shape {
namespace {

using Eigen::Vector3d;
using numeric::Interval;

/// The half widths of blocks [m]: from below a millimetre to beyond the Moon, each eight times the
/// one before.
constexpr double kWidthMin = 0x1p-12, kWidthFactor = 8;
constexpr int kBlocks = 14;

/// The half width of a block in units of what it must look endless to.
constexpr double kWidthOverReach = 4;

/// Two unit vectors across the normal and across each other, rounded.
std::pair<Vector3d, Vector3d> Across(const Vector3d& normal) {
  Eigen::Index least;
  normal.cwiseAbs().minCoeff(&least);
  const Vector3d first = normal.cross(Vector3d::Unit(least)).normalized();
  return {first, normal.cross(first).normalized()};
}

}  // namespace

std::optional<std::string> RefusalOfHalfSpace(const Vector3d& normal, double offset) {
  const double length = normal.norm();
  if (!(std::abs(length - 1) <= kNormalLengthTolerance)) {
    return "half_space.normal has the length " + NumberText(length) + "; allowed is 1, to within " +
           NumberText(kNormalLengthTolerance);
  }
  if (!(std::abs(offset) <= kHalfSpaceOffsetMax)) {
    return "half_space.offset_m is " + NumberText(offset) + "; allowed are " +
           NumberText(-kHalfSpaceOffsetMax) + " to " + NumberText(kHalfSpaceOffsetMax);
  }
  return std::nullopt;
}

std::shared_ptr<const FixedHalfSpace> FixedHalfSpace::Build(const Vector3d& normal, double offset) {
  CORE_CHECK(!RefusalOfHalfSpace(normal, offset), "the half-space is within its ranges");
  return std::shared_ptr<const FixedHalfSpace>(new FixedHalfSpace(normal, offset, nullptr));
}

std::shared_ptr<const FixedHalfSpace> FixedHalfSpace::WithBlocks() const {
  auto blocks = std::make_shared<Blocks>();
  double half_width = kWidthMin;
  for (int k = 0; k < kBlocks; ++k, half_width *= kWidthFactor) {
    blocks->push_back(BlockOf(half_width));
  }
  return std::shared_ptr<const FixedHalfSpace>(
      new FixedHalfSpace(normal_, offset_, std::move(blocks)));
}

std::shared_ptr<const FixedHalfSpace> FixedHalfSpace::Grown(double more) const {
  const double length = numeric::Norm(numeric::IntervalVector(normal_)).upper;
  const double offset = numeric::AddUp(offset_, numeric::MultiplyUp(length, more));
  return std::shared_ptr<const FixedHalfSpace>(new FixedHalfSpace(normal_, offset, blocks_));
}

/// Of a point above the plane with this offset, in metres.
Interval FixedHalfSpace::HeightAbove(double offset, const Vector3d& point) const {
  const numeric::IntervalVector n(normal_);
  return (Dot(n, numeric::IntervalVector(point)) - Interval(offset)) / numeric::Norm(n);
}

FixedHalfSpace::Block FixedHalfSpace::BlockOf(double half_width) const {
  const auto [first, second] = Across(normal_);
  const Vector3d down = -2 * half_width * normal_.normalized();
  ConvexDescription block;
  block.core = geometry::ConvexCore::kHull;
  Interval heights(0);
  for (const int i : {-1, 1}) {
    for (const int k : {-1, 1}) {
      const Vector3d corner = half_width * (i * first + k * second);
      const Interval height = HeightAbove(0, corner);
      heights = {std::min(heights.lower, height.lower), std::max(heights.upper, height.upper)};
      block.points.push_back(corner);
      block.points.push_back(corner + down);
    }
  }
  // The face is at least as wide as L, and a sine is at least half its angle.
  const double spread = numeric::AddUp(heights.upper, -heights.lower);
  const double tilt = numeric::DivideUp(numeric::MultiplyUp(2, spread), half_width);
  return {half_width, Shape::Compound(nullptr, {ConvexSolid::BuildOfAnySize(block)}), heights,
          tilt};
}

std::optional<FixedHalfSpace::StandIn> FixedHalfSpace::Around(const Vector3d& centre,
                                                              double reach) const {
  CORE_CHECK(blocks_ != nullptr, "a half-space that is looked at has its blocks");
  const Interval height = HeightAbove(offset_, centre);
  const double wanted = kWidthOverReach * (reach + std::max(0.0, -height.lower));
  const auto block = std::find_if(blocks_->begin(), blocks_->end(),
                                  [wanted](const Block& one) { return one.half_width >= wanted; });
  if (block == blocks_->end()) return std::nullopt;
  const Vector3d position = centre - height.middle() * normal_.normalized();
  const Interval off = HeightAbove(offset_, position) + block->heights;
  return StandIn{block->shape, position, std::max(off.upper, -off.lower), block->tilt};
}

}  // namespace collision::shape
