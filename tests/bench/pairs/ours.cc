#include "tests/bench/pairs/ours.h"

#include <algorithm>

#include "collision_core/narrow_phase/convex_pair/convex_distance.h"
#include "collision_core/narrow_phase/separation/refinement.h"

namespace collision::bench {
namespace {

constexpr std::uint64_t kBudgets[] = {1, 4, 16, 64, 128, 256, 512, 1024, 4096, 1 << 16};
constexpr double kWidths[] = {0.3, 0.1, 3e-2, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12};
constexpr narrow_phase::BracketTolerance kAsNarrowAsCanBe{0, 0};

const char kByBudget[] = "work units a pair; at last the rounding of the pose";
const char kByWidth[] = "the width asked for; at last the rounding of the pose";
const char kByRounding[] = "the rounding of the pose";

Reply ReplyOf(const narrow_phase::SeparationBracket& look) {
  if (look.upper <= 0 || look.crossing_margin >= 0) return Plain(0);
  return {std::max(0.0, look.lower), look.upper};
}

Reply ReplyOf(const numeric::Interval& distance) { return {distance.lower, distance.upper}; }

Reply ReplyOf(narrow_phase::Verdict verdict) {
  if (verdict == narrow_phase::Verdict::kUndecided) return {0, 1};
  return Plain(verdict == narrow_phase::Verdict::kTouching);
}

/// The pair that may be nearest is opened first, so that both ends move all the time.
Reply ByBudget(const narrow_phase::BodySegment& body, const PlainPose& at, std::uint64_t units) {
  const narrow_phase::BodyTree surface(body);
  const narrow_phase::RelativePose pose = PoseOf(at);
  WorkBudget work(units);
  narrow_phase::SeparationSearch search({surface, surface, pose}, narrow_phase::Goal::kDecision,
                                        kAsNarrowAsCanBe, narrow_phase::SearchOrder::kNearest);
  search.Start(&work);
  search.Refine(&work);
  return ReplyOf(search.Result());
}

/// Until the bracket is narrower than `width` [m] or than `share` of its lower end.
Reply Bracket(const narrow_phase::BodySegment& body, const PlainPose& at, double width,
              double share = 0) {
  const narrow_phase::BodyTree a(body), b(body);
  WorkBudget work(kUnlimited);
  return ReplyOf(narrow_phase::BracketSeparation({a, b, PoseOf(at)}, {width, share}, &work));
}

Reply Decide(const narrow_phase::BodySegment& body, const PlainPose& at) {
  const narrow_phase::BodyTree a(body), b(body);
  WorkBudget work(kUnlimited);
  return ReplyOf(narrow_phase::DecideAt({a, b, PoseOf(at)}, &work).verdict);
}

std::vector<Reply> Together(const narrow_phase::BodySegment& body,
                            const std::vector<PlainPose>& poses,
                            narrow_phase::RefinementOrder order, std::uint64_t units) {
  const narrow_phase::BodyTree surface(body);
  narrow_phase::Refinement refinement(order);
  WorkBudget work(units * poses.size());
  for (const PlainPose& at : poses) {
    refinement.Add({surface, surface, PoseOf(at)}, 1, narrow_phase::Goal::kDecision,
                   kAsNarrowAsCanBe, &work);
  }
  refinement.Refine(&work);
  std::vector<Reply> replies;
  for (std::size_t i = 0; i < poses.size(); ++i) replies.push_back(ReplyOf(refinement.Result(i)));
  return replies;
}

PairMethod Ours(const std::string& name, const std::string& setting, const char* limited_by) {
  PairMethod method;
  method.name = name, method.setting = setting, method.limited_by = limited_by;
  method.origin = Origin::kOurs;
  method.certified = true;
  return method;
}

std::string Units(std::uint64_t units) { return std::to_string(units) + " units"; }

void AddTree(const std::string& name, const narrow_phase::BodySegment& body, PairMethods* methods) {
  for (const std::uint64_t units : kBudgets) {
    methods->push_back(Ours(name + ", by budget", Units(units), kByBudget));
    methods->back().ask = [body, units](const PlainPose& at) { return ByBudget(body, at, units); };
  }
  for (const double width : kWidths) {
    methods->push_back(Ours(name + ", by width", SettingText("", width, "m"), kByWidth));
    methods->back().ask = [body, width](const PlainPose& at) { return Bracket(body, at, width); };
  }
}

void AddRefinement(const narrow_phase::BodySegment& body, PairMethods* methods) {
  const std::pair<narrow_phase::RefinementOrder, const char*> orders[] = {
      {narrow_phase::RefinementOrder::kLevelByLevel, "refinement, level by level"},
      {narrow_phase::RefinementOrder::kLargestFirst, "refinement, largest first"}};
  for (const auto& [order, name] : orders) {
    for (const std::uint64_t units : kBudgets) {
      methods->push_back(Ours(name, Units(units), "the budget that all pairs share"));
      methods->back().ask_all = [body, units, order = order](const std::vector<PlainPose>& poses) {
        return Together(body, poses, order, units);
      };
    }
  }
}

numeric::Interval ByFullSearch(const ConvexPair& pair, const PlainPose& at, std::uint64_t units) {
  WorkBudget work(units);
  const narrow_phase::RelativePose pose = PoseOf(at);
  const numeric::Interval found =
      narrow_phase::IntervalOf(PosedA(pair.a.set(), pose), PosedB(pair.b.set(), pose),
                               {.goal = narrow_phase::ConvexGoal::kDistance}, &work);
  return {std::max(0.0, found.lower), std::max(0.0, found.upper)};
}

}  // namespace

PairMethods OurMesh(std::shared_ptr<const shape::Shape> shape, double diameter,
                    const std::string& name, Origin origin) {
  const narrow_phase::BodySegment body = BodyOf(std::move(shape));
  const double width = kBracketShare * diameter;
  const auto method = [&](Task task, std::function<Reply(const PlainPose&)> ask) {
    return PairMethod{.name = name, .task = task, .origin = origin, .ask = std::move(ask)};
  };
  return {
      method(Task::kDecision, [body](const PlainPose& at) { return Decide(body, at); }),
      method(Task::kDistance,
             [body](const PlainPose& at) { return Bracket(body, at, 0, kDistanceShare); }),
      method(Task::kBracket,
             [body, width](const PlainPose& at) { return Bracket(body, at, width); }),
  };
}

PairMethods OurConvex(const ConvexPair& pair) {
  const auto decide = [pair](const PlainPose& at) { return ReplyOf(pair.VerdictAt(PoseOf(at))); };
  const auto measure = [pair](const PlainPose& at) {
    return ReplyOf(pair.DistanceAt(PoseOf(at), kDistanceShare, 0));
  };
  return {{.name = "ours", .task = Task::kDecision, .origin = Origin::kOurs, .ask = decide},
          {.name = "ours", .task = Task::kDistance, .origin = Origin::kOurs, .ask = measure}};
}

PairMethods OurMeshCurves(const TwoTrees& trees) {
  const narrow_phase::BodySegment fitted = BodyOf(trees.fitted), octree = BodyOf(trees.octree);
  PairMethods methods;
  AddTree("fitted tree", fitted, &methods);
  AddTree("octree", octree, &methods);
  AddRefinement(fitted, &methods);
  methods.push_back(Ours("exact triangles", "", kByRounding));
  methods.back().ask = [fitted](const PlainPose& at) { return Bracket(fitted, at, 0); };
  methods.push_back(Ours("yes or no", "", kByRounding));
  methods.back().task = Task::kDecision;
  methods.back().ask = [fitted](const PlainPose& at) { return Decide(fitted, at); };
  return methods;
}

PairMethods OurConvexCurves(const ConvexPair& pair) {
  PairMethods methods;
  for (const double width : kWidths) {
    methods.push_back(Ours("convex routine, by width", SettingText("", width, "m"), kByWidth));
    methods.back().ask = [pair, width](const PlainPose& at) {
      return ReplyOf(pair.DistanceAt(PoseOf(at), 0, width));
    };
  }
  methods.push_back(Ours("convex routine, by width", "0 m", kByRounding));
  methods.back().ask = [pair](const PlainPose& at) {
    return ReplyOf(pair.DistanceAt(PoseOf(at), 0, 0));
  };
  for (const std::uint64_t units : {1, 2, 3, 4, 6, 8, 12, 16, 32, 64}) {
    methods.push_back(Ours("full search, by budget", Units(units), kByBudget));
    methods.back().ask = [pair, units](const PlainPose& at) {
      return ReplyOf(ByFullSearch(pair, at, units));
    };
  }
  methods.push_back(Ours("yes or no at a glance", "", kByRounding));
  methods.back().task = Task::kDecision;
  methods.back().ask = [pair](const PlainPose& at) { return ReplyOf(pair.VerdictAt(PoseOf(at))); };
  return methods;
}

}  // namespace collision::bench
