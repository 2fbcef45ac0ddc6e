#include "tests/bench/precision_pose.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tests/support/random.h"

namespace collision::bench {
namespace {

/// Grazing: 1e-3, 1e-4 ... 1e-12 of the size.
constexpr int kGrazes = 10;
constexpr double kShareMin = 1e-3, kShareMax = 0.5, kOverlapMax = 0.1;

/// A gap is met to this part of it; beginnings of overlaps and the smallest gaps to so many metres.
constexpr double kGapTolerance = 1e-2, kFinest = 2e-14;
constexpr int kDrawsMax = 200;

Eigen::Matrix3d RandomRotation(Random& random) {
  for (;;) {
    const Eigen::Quaterniond q(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1),
                               random.Uniform(-1, 1));
    const double norm = q.norm();
    if (norm > 0.1 && norm <= 1) return q.normalized().toRotationMatrix();
  }
}

struct Placement {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d direction;

  narrow_phase::RelativePose At(double along) const {
    return collision::narrow_phase::PoseOf(rotation, along * direction);
  }
  PlainPose Plainly(double along) const {
    const Eigen::Vector3d offset = along * direction;
    PlainPose pose;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) pose.rotation[i][j] = rotation(i, j);
      pose.offset[i] = offset[i];
    }
    return pose;
  }
};

/// How far along the direction it is near no longer, within `tolerance`.
template <typename IsNear>
std::optional<double> Boundary(double diameter, double tolerance, const IsNear& is_near) {
  double near = 0, far = 2 * diameter;
  if (!is_near(near)) return std::nullopt;
  while (far - near > tolerance) {
    const double middle = 0.5 * (near + far);
    if (middle <= near || middle >= far) break;
    (is_near(middle) ? near : far) = middle;
  }
  return far;
}

class Drawer {
 public:
  Drawer(const PairOracle& oracle, const ExactDistance& exact, double diameter)
      : oracle_(oracle), exact_(exact), diameter_(diameter) {}

  std::optional<JudgedPose> Gap(const Placement& placement, double share) const {
    const double wanted = share * diameter_;
    const double off = std::max(kGapTolerance * wanted, kFinest), close = 0.1 * off;
    const auto along = Boundary(diameter_, close, [&](double at) {
      return oracle_.distance(placement.At(at), close).upper <= wanted;
    });
    if (!along) return std::nullopt;
    const double upper = oracle_.distance(placement.At(*along), 0).upper;
    if (std::abs(upper - wanted) > off) return std::nullopt;
    const PlainPose pose = placement.Plainly(*along);
    const double distance = exact_(pose, upper);
    if (!(distance > 0) || std::abs(distance - wanted) > 2 * off) return std::nullopt;
    return JudgedPose{pose, share, false, distance};
  }

  std::optional<JudgedPose> Overlap(const Placement& placement, double share) const {
    const auto touch = Boundary(diameter_, 0.5 * kFinest, [&](double at) {
      return oracle_.decide(placement.At(at)) == narrow_phase::Verdict::kTouching;
    });
    if (!touch) return std::nullopt;
    const PlainPose pose = placement.Plainly(*touch - share * diameter_);
    if (exact_(pose, 0) != 0) return std::nullopt;
    return JudgedPose{pose, share, true, 0};
  }

 private:
  const PairOracle& oracle_;
  const ExactDistance& exact_;
  const double diameter_;
};

struct Wanted {
  double share;
  bool overlap;
};

std::vector<Wanted> WantedOf(Motion motion, std::size_t count, Random& random) {
  std::vector<Wanted> wanted;
  for (std::size_t i = 0; i < count; ++i) {
    if (motion == Motion::kGrazing) {
      const double share = std::pow(10.0, -3 - static_cast<int>(i % kGrazes));
      wanted.push_back({share, false});
      wanted.push_back({share, true});
    } else {
      wanted.push_back({random.LogUniform(kShareMin, kShareMax), false});
      if (i % 2 == 0) wanted.push_back({random.LogUniform(kShareMin, kOverlapMax), true});
    }
  }
  return wanted;
}

}  // namespace

const char* Name(Motion motion) {
  switch (motion) {
    case Motion::kTranslation:
      return "translation";
    case Motion::kRotation:
      return "rotation";
    case Motion::kGrazing:
      return "grazing";
  }
  return "";
}

std::vector<JudgedPose> DrawPoses(const PairOracle& oracle, const ExactDistance& exact,
                                  double diameter, Motion motion, std::size_t count,
                                  std::uint64_t seed) {
  Random random(seed);
  const Drawer drawer(oracle, exact, diameter);
  std::vector<JudgedPose> poses;
  for (const Wanted& wanted : WantedOf(motion, count, random)) {
    for (int draw = 0; draw < kDrawsMax; ++draw) {
      Placement placement{Eigen::Matrix3d::Identity(), random.UnitVector()};
      if (motion != Motion::kTranslation) placement.rotation = RandomRotation(random);
      const auto pose = wanted.overlap ? drawer.Overlap(placement, wanted.share)
                                       : drawer.Gap(placement, wanted.share);
      if (!pose) continue;
      poses.push_back(*pose);
      break;
    }
  }
  return poses;
}

}  // namespace collision::bench
