// Poses that ask for precision: shifted, turned, and grazing.
#include <algorithm>
#include <cmath>

#include "tests/bench/pairs/pose.h"
#include "tests/support/random_rotation.h"

namespace collision::bench {
namespace {

/// Grazing: 1e-3, 1e-4 ... 1e-12 of the size.
constexpr int kGrazes = 10;
constexpr double kShareMin = 1e-3, kShareMax = 0.5, kOverlapMax = 0.1;

/// A gap is met to this part of it; beginnings of overlaps and the smallest gaps to so many metres.
constexpr double kGapTolerance = 1e-2, kFinest = 2e-14;
constexpr int kDrawsMax = 200;

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
