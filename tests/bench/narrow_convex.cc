// Capsules, boxes and hulls: the same contest against FCL's and Bullet's own.
#include "tests/bench/narrow_convex.h"

#include <algorithm>

#include "tests/bench/narrow_cell.h"
#include "tests/bench/narrow_convex_pair.h"
#include "tests/bench/narrow_ours.h"

namespace collision::bench {
namespace {

constexpr std::uint64_t kSeed = 5;

NarrowQueries OurConvexQueries(const ConvexPair& pair) {
  const auto decide = [pair](const PlainPose& at) -> Reply {
    switch (pair.VerdictAt(narrow_phase::PoseOf(at))) {
      case narrow_phase::Verdict::kApart:
        return Plain(0);
      case narrow_phase::Verdict::kTouching:
        return Plain(1);
      case narrow_phase::Verdict::kUndecided:
        break;
    }
    return {0, 1};
  };
  const auto measure = [pair](const PlainPose& at) -> Reply {
    const numeric::Interval distance = pair.DistanceAt(narrow_phase::PoseOf(at), kDistanceShare, 0);
    return {distance.lower, distance.upper};
  };
  return {{"ours", Task::kDecision, Who::kOurs, decide},
          {"ours", Task::kDistance, Who::kOurs, measure}};
}

void Contest(const NarrowSettings& settings, const PlainConvex& a, const PlainConvex& b,
             NarrowReport* report) {
  const ConvexPair pair{SolidOf(a), SolidOf(b)};
  NarrowQueries queries = OurConvexQueries(pair);
  for (NarrowQuery& query : ConvexPeerQueries(a, b)) queries.push_back(std::move(query));
  for (const GapClass& gap : GapClasses()) {
    Cell cell{"convex ", a.name + " " + b.name,
              std::max(a.hull.triangles.size(), b.hull.triangles.size()), 2, gap};
    NarrowQueries wanted;
    std::copy_if(queries.begin(), queries.end(), std::back_inserter(wanted),
                 [&](const NarrowQuery& query) { return Wanted(settings, RowOf(cell, query)); });
    if (wanted.empty()) continue;
    cell.sample = SamplePoses(OracleOf(pair), cell.diameter, gap, settings.poses(), kSeed);
    if (cell.sample.poses.empty()) continue;
    for (const PlainPose& pose : cell.sample.poses) {
      cell.distances.push_back(queries[1].ask(pose));
    }
    Measure(settings, cell, wanted, report);
  }
}

}  // namespace

void ConvexPart(const NarrowSettings& settings, NarrowReport* report) {
  const std::vector<PlainConvex> all = Convexes();
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t k = i; k < all.size(); ++k) Contest(settings, all[i], all[k], report);
  }
}

}  // namespace collision::bench
