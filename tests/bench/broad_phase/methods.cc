#include "tests/bench/broad_phase/methods.h"

#include <algorithm>

#include "collision_core/broad_phase/adaptive_broad_phase.h"
#include "collision_core/broad_phase/face_sweep/face_sweep.h"
#include "collision_core/broad_phase/index/all_pairs.h"
#include "collision_core/broad_phase/index/spatial_index.h"
#include "collision_core/numeric/seconds.h"
#include "tests/baselines/ball_bound.h"
#include "tests/bench/broad_phase/contestant.h"
#include "tests/bench/broad_phase/peers.h"
#include "tests/bench/harness/measure.h"

namespace collision::bench {
namespace {

template <typename Type>
Method MethodOf(const char* name) {
  const auto make = [] { return std::make_unique<Type>(); };
  return {name, make, make};
}

/// One object, as of the libraries: for each query every bound is put anew.
class MethodContestant : public Contestant {
 public:
  explicit MethodContestant(const Method& method) : method_(method.make_sweep()) {}

  Timed Ask(const baselines::BallScene& scene, double horizon) override {
    Timed timed;
    const CpuStopwatch filling;
    for (std::size_t i = 0; i < scene.size(); ++i) {
      method_->Set(static_cast<std::uint32_t>(i), baselines::BoundOf(scene[i]));
    }
    timed.fill = filling.seconds();
    const CpuStopwatch asking;
    intersection::BroadQuery query;
    query.until = numeric::AddRoundedDown(query.from, horizon);
    const auto meeting = method_->Earliest(query);
    timed.answer_in = asking.seconds();
    if (meeting) {
      timed.answer = {true, meeting->lower, meeting->higher, meeting->time.instant().nanoseconds()};
    }
    return timed;
  }

 private:
  std::unique_ptr<broad_phase::EarliestSweep> method_;
};

}  // namespace

const std::vector<Method>& OurMethods() {
  static const std::vector<Method> methods = {
      MethodOf<broad_phase::AllPairs>("all-pairs"),
      {"face-sweep", [] { return std::make_unique<broad_phase::FaceSweep>(); }, nullptr},
      MethodOf<broad_phase::SpatialIndex>("spatial-index"),
      MethodOf<broad_phase::AdaptiveBroadPhase>("chosen"),
  };
  return methods;
}

const Method& OurChoice() { return OurMethods().back(); }

bool IsOurs(const std::string& contestant) {
  return std::any_of(OurMethods().begin(), OurMethods().end(),
                     [&](const Method& method) { return method.name == contestant; });
}

std::vector<Entrant> Entrants() {
  std::vector<Entrant> entrants;
  for (const Method& method : OurMethods()) {
    entrants.push_back(
        {method.name, true, [&method] { return std::make_unique<MethodContestant>(method); }});
  }
  for (Entrant& peer : Peers()) entrants.push_back(std::move(peer));
  return entrants;
}

}  // namespace collision::bench
