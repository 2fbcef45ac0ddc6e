#include "tests/bench/narrow_pose.h"

#include <Eigen/Geometry>
#include <optional>

#include "collision_core/narrow_phase/separation/separation.h"
#include "tests/support/random.h"

namespace collision::bench {
namespace {

constexpr std::uint64_t kUnlimited = std::uint64_t{1} << 60;
/// A gap is met to this part of it, and the beginning of an overlap to this part of the diameter.
constexpr double kGapTolerance = 1e-2, kTouchTolerance = 1e-7;
/// Draws for one pose, before it is given up.
constexpr int kDrawsMax = 1000;

Eigen::Matrix3d RandomRotation(Random& random) {
  for (;;) {
    const Eigen::Quaterniond q(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1),
                               random.Uniform(-1, 1));
    const double norm = q.norm();
    if (norm > 0.1 && norm <= 1) return q.normalized().toRotationMatrix();
  }
}

PlainPose PlainOf(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& offset) {
  PlainPose pose;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) pose.rotation[i][j] = rotation(i, j);
    pose.offset[i] = offset[i];
  }
  return pose;
}

class Sampler {
 public:
  Sampler(PairOracle oracle, double diameter, std::uint64_t seed)
      : oracle_(std::move(oracle)), diameter_(diameter), random_(seed) {}

  std::optional<PlainPose> Draw(const GapClass& gap) {
    rotation_ = RandomRotation(random_);
    direction_ = random_.UnitVector();
    const double wanted = gap.share * diameter_;
    if (!gap.overlap) return Gap(wanted);
    const auto touch = Boundary(kTouchTolerance * diameter_, [&](double at) { return Touch(at); });
    if (!touch || !Touch(*touch - wanted)) return std::nullopt;
    return PlainOf(rotation_, (*touch - wanted) * direction_);
  }

 private:
  narrow_phase::RelativePose At(double along) const {
    return collision::narrow_phase::PoseOf(rotation_, along * direction_);
  }

  bool Touch(double along) const {
    return oracle_.decide(At(along)) == narrow_phase::Verdict::kTouching;
  }

  std::optional<PlainPose> Gap(double wanted) const {
    const double close = 0.1 * kGapTolerance * wanted;
    const auto along =
        Boundary(close, [&](double at) { return oracle_.distance(At(at), close).upper <= wanted; });
    if (!along) return std::nullopt;
    const numeric::Interval distance = oracle_.distance(At(*along), close);
    const double off = kGapTolerance * wanted;
    if (distance.lower < wanted - off || distance.upper > wanted + off) return std::nullopt;
    if (oracle_.decide(At(*along)) != narrow_phase::Verdict::kApart) return std::nullopt;
    return PlainOf(rotation_, *along * direction_);
  }

  /// From where the centres coincide, which must be near, to where it is not, within `tolerance`.
  template <typename IsNear>
  std::optional<double> Boundary(double tolerance, const IsNear& is_near) const {
    if (!is_near(0)) return std::nullopt;
    double near = 0, far = 2 * diameter_;
    while (far - near > tolerance) {
      const double middle = 0.5 * (near + far);
      (is_near(middle) ? near : far) = middle;
    }
    return far;
  }

  const PairOracle oracle_;
  const double diameter_;
  Random random_;
  Eigen::Matrix3d rotation_;
  Eigen::Vector3d direction_;
};

}  // namespace

const std::vector<GapClass>& GapClasses() {
  static const std::vector<GapClass> classes = {
      {"overlap 10 %", 0.1, true}, {"overlap 0.1 %", 0.001, true}, {"gap 0.1 %", 0.001, false},
      {"gap 1 %", 0.01, false},    {"gap 10 %", 0.1, false},       {"gap 50 %", 0.5, false}};
  return classes;
}

narrow_phase::RelativePose PoseOf(const PlainPose& pose) {
  Eigen::Matrix3d rotation;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) rotation(i, j) = pose.rotation[i][j];
  }
  return collision::narrow_phase::PoseOf(rotation,
                                         {pose.offset[0], pose.offset[1], pose.offset[2]});
}

narrow_phase::BodySegment BodyOf(std::shared_ptr<const shape::Shape> shape) {
  narrow_phase::BodySegment body;
  body.shape = std::move(shape);
  return body;
}

PoseSample SamplePoses(std::shared_ptr<const shape::Shape> shape, double diameter,
                       const GapClass& gap, std::size_t count, std::uint64_t seed) {
  const narrow_phase::BodySegment body = BodyOf(std::move(shape));
  const PairOracle oracle = {
      [body](const narrow_phase::RelativePose& pose) {
        WorkBudget work(kUnlimited);
        return narrow_phase::DecideAt(
                   {narrow_phase::BodyTree(body), narrow_phase::BodyTree(body), pose}, &work)
            .verdict;
      },
      [body](const narrow_phase::RelativePose& pose, double width) {
        WorkBudget work(kUnlimited);
        const narrow_phase::SeparationBracket look = narrow_phase::BracketSeparation(
            {narrow_phase::BodyTree(body), narrow_phase::BodyTree(body), pose}, {width, 0}, &work);
        return numeric::Interval(look.lower, look.upper);
      }};
  return SamplePoses(oracle, diameter, gap, count, seed);
}

PoseSample SamplePoses(PairOracle oracle, double diameter, const GapClass& gap, std::size_t count,
                       std::uint64_t seed) {
  Sampler sampler(std::move(oracle), diameter, seed);
  PoseSample sample;
  int draws = 0;
  while (sample.poses.size() < count && draws < kDrawsMax) {
    ++draws;
    if (const auto pose = sampler.Draw(gap)) {
      sample.poses.push_back(*pose);
      draws = 0;
    } else {
      ++sample.redrawn;
    }
  }
  return sample;
}

}  // namespace collision::bench
