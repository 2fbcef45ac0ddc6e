// The contest's poses: classes of gaps and overlaps.
#include "tests/bench/pairs/pose.h"
#include "tests/support/random_rotation.h"

namespace collision::bench {
namespace {

/// A gap is met to this part of it, and the beginning of an overlap to this part of the diameter.
constexpr double kGapTolerance = 1e-2, kTouchTolerance = 1e-7;
/// Draws for one pose, before it is given up.
constexpr int kDrawsMax = 1000;

std::optional<PlainPose> Gap(const PairOracle& oracle, const Placement& placement, double diameter,
                             double wanted) {
  const double close = 0.1 * kGapTolerance * wanted;
  const auto along = Boundary(diameter, close, [&](double at) {
    return oracle.distance(placement.At(at), close).upper <= wanted;
  });
  if (!along) return std::nullopt;
  const numeric::Interval distance = oracle.distance(placement.At(*along), close);
  const double off = kGapTolerance * wanted;
  if (distance.lower < wanted - off || distance.upper > wanted + off) return std::nullopt;
  if (oracle.decide(placement.At(*along)) != narrow_phase::Verdict::kApart) return std::nullopt;
  return placement.Plainly(*along);
}

std::optional<PlainPose> Overlap(const PairOracle& oracle, const Placement& placement,
                                 double diameter, double wanted) {
  const auto touches = [&](double at) {
    return oracle.decide(placement.At(at)) == narrow_phase::Verdict::kTouching;
  };
  const auto touch = Boundary(diameter, kTouchTolerance * diameter, touches);
  if (!touch || !touches(*touch - wanted)) return std::nullopt;
  return placement.Plainly(*touch - wanted);
}

}  // namespace

const std::vector<GapClass>& GapClasses() {
  static const std::vector<GapClass> classes = {
      {"overlap 10 %", 0.1, true}, {"overlap 0.1 %", 0.001, true}, {"gap 0.1 %", 0.001, false},
      {"gap 1 %", 0.01, false},    {"gap 10 %", 0.1, false},       {"gap 50 %", 0.5, false}};
  return classes;
}

PoseSample SamplePoses(const PairOracle& oracle, double diameter, const GapClass& gap,
                       std::size_t count, std::uint64_t seed) {
  Random random(seed);
  PoseSample sample;
  int draws = 0;
  while (sample.poses.size() < count && draws < kDrawsMax) {
    ++draws;
    Placement placement;
    placement.rotation = RandomRotation(random);
    placement.direction = random.UnitVector();
    const double wanted = gap.share * diameter;
    const auto pose = gap.overlap ? Overlap(oracle, placement, diameter, wanted)
                                  : Gap(oracle, placement, diameter, wanted);
    if (pose) {
      sample.poses.push_back(*pose);
      draws = 0;
    } else {
      ++sample.redrawn;
    }
  }
  return sample;
}

}  // namespace collision::bench
