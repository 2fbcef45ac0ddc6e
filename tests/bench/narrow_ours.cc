#include "tests/bench/narrow_ours.h"

#include <algorithm>

#include "collision_core/narrow_phase/separation/separation.h"
#include "tests/bench/narrow_pose.h"

namespace collision::bench {
namespace {

constexpr std::uint64_t kUnlimited = std::uint64_t{1} << 60;

Reply Decide(const narrow_phase::BodySegment& body, const PlainPose& at) {
  const narrow_phase::BodyTree a(body), b(body);
  WorkBudget work(kUnlimited);
  switch (narrow_phase::DecideAt({a, b, PoseOf(at)}, &work).verdict) {
    case narrow_phase::Verdict::kApart:
      return Plain(0);
    case narrow_phase::Verdict::kTouching:
      return Plain(1);
    case narrow_phase::Verdict::kUndecided:
      break;
  }
  return {0, 1};
}

Reply Bracket(const narrow_phase::BodySegment& body, const PlainPose& at, double width,
              double share) {
  const narrow_phase::BodyTree a(body), b(body);
  WorkBudget work(kUnlimited);
  const narrow_phase::SeparationBracket look =
      narrow_phase::BracketSeparation({a, b, PoseOf(at)}, {width, share}, &work);
  if (look.upper <= 0 || look.crossing_margin >= 0) return Plain(0);
  return {std::max(0.0, look.lower), look.upper};
}

}  // namespace

NarrowQueries OurQueries(std::shared_ptr<const shape::Shape> shape, double diameter,
                         const std::string& name, Who who) {
  const narrow_phase::BodySegment body = BodyOf(std::move(shape));
  const double width = kBracketShare * diameter;
  return {
      {name, Task::kDecision, who, [body](const PlainPose& at) { return Decide(body, at); }},
      {name, Task::kDistance, who,
       [body](const PlainPose& at) { return Bracket(body, at, 0, kDistanceShare); }},
      {name, Task::kBracket, who,
       [body, width](const PlainPose& at) { return Bracket(body, at, width, 0); }},
  };
}

}  // namespace collision::bench
