// Scenes in which methods of the broad phase might differ, and the methods.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "collision_core/broad_phase/face_sweep/face_sweep.h"
#include "collision_core/broad_phase/index/all_pairs.h"
#include "collision_core/broad_phase/index/exhaustive_index.h"
#include "collision_core/broad_phase/index/spatial_index.h"
#include "tests/collision_core/broad_phase/draw_filter.h"
#include "tests/support/random.h"

namespace collision::broad_phase {

inline constexpr Instant kMethodStart = Instant::FromNanoseconds(1'000'000'000'000);

struct NamedMethod {
  const char* name;
  std::unique_ptr<SweepingIndex> (*make)();
};

template <typename Method>
std::unique_ptr<SweepingIndex> MakeMethod() {
  return std::make_unique<Method>();
}

/// A face sweep answers one query about all agents; an exhaustive index beside it, over the same
/// bounds, rules and half-spaces, answers the others.
class SweepBesideIndex : public SweepingIndex {
 public:
  void Set(std::uint32_t agent, const AgentBound& bound) override {
    mutable_half_spaces().Remove(agent);
    sweep_.Set(agent, bound);
    index_.Set(agent, bound);
  }
  void Remove(std::uint32_t agent) override {
    mutable_half_spaces().Remove(agent);
    sweep_.Remove(agent);
    index_.Remove(agent);
  }
  bool SetHalfSpace(std::uint32_t agent, const HalfSpace& half_space) override {
    const bool taken = sweep_.SetHalfSpace(agent, half_space);
    return index_.SetHalfSpace(agent, half_space) && taken &&
           mutable_half_spaces().Set(agent, half_space);
  }
  void FindNeighbours(std::uint32_t agent, const NeighbourWindow& window, const Skip& skip,
                      std::vector<Neighbour>* neighbours) override {
    index_.FindNeighbours(agent, window, skip, neighbours);
  }
  void FindNeighbours(const AgentBound& bound, Instant from, Instant until, const Skip& skip,
                      std::vector<Neighbour>* neighbours) override {
    index_.FindNeighbours(bound, from, until, skip, neighbours);
  }
  std::optional<intersection::IntersectingPair> EarliestOf(
      std::uint32_t agent, const intersection::BroadQuery& query) override {
    return index_.EarliestOf(agent, query);
  }
  void FindNearPairs(const intersection::BroadQuery& query, std::vector<NearPair>* pairs) override {
    index_.FindNearPairs(query, pairs);
  }
  std::optional<intersection::IntersectingPair> Earliest(
      const intersection::BroadQuery& query) override {
    return sweep_.Earliest(query);
  }
  bool Contains(std::uint32_t agent) const override { return index_.Contains(agent); }
  void Validate() const override {
    sweep_.Validate();
    index_.Validate();
  }
  BroadPhaseWork work() const override {
    const BroadPhaseWork a = sweep_.work(), b = index_.work();
    return {a.pair_queries + b.pair_queries, a.filter_tests + b.filter_tests, a.visits + b.visits,
            a.rebuilds + b.rebuilds};
  }

 private:
  FaceSweep sweep_{shared_rules()};
  ExhaustiveIndex index_{shared_rules()};
};

inline const NamedMethod kMethods[] = {{"AllPairs", &MakeMethod<AllPairs>},
                                       {"SpatialIndex", &MakeMethod<SpatialIndex>},
                                       {"FaceSweep", &MakeMethod<SweepBesideIndex>}};

inline motion::SpaceTimeBound BoundIn(double extent, double radius, double speed,
                                      double acceleration_max, Random* random) {
  motion::SpaceTimeBound bound;
  bound.state.stamp = kMethodStart;
  for (int axis = 0; axis < 3; ++axis) bound.state.p_WA[axis] = random->Uniform(-extent, extent);
  bound.state.v_WA = random->UnitVector() * (speed * random->Uniform(0, 1));
  bound.limits.radius = radius;
  bound.limits.acceleration_max = acceleration_max;
  return bound;
}

using SceneAgents = BoundList;

template <typename Make>
SceneAgents Several(int least, int most, Random* random, Make make) {
  SceneAgents agents;
  const int count = least + static_cast<int>(random->Below(most - least + 1));
  for (int i = 0; i < count; ++i) agents.push_back(make(i));
  return agents;
}

struct NamedScene {
  const char* name;
  bool changes;  ///< Suits a long history.
  SceneAgents (*make)(Random* random);
};

inline const NamedScene kMethodScenes[] = {
    {"uniform", true,
     [](Random* r) { return Several(2, 90, r, [&](int) { return BoundIn(20, 0.5, 5, 2, r); }); }},
    {"dense", true,
     [](Random* r) { return Several(40, 90, r, [&](int) { return BoundIn(3, 0.5, 5, 2, r); }); }},
    {"without acceleration", true,
     [](Random* r) { return Several(2, 90, r, [&](int) { return BoundIn(30, 0.5, 5, 0, r); }); }},
    {"clusters with outliers", true,
     [](Random* r) {
       return Several(40, 120, r, [&](int i) {
         motion::SpaceTimeBound bound = BoundIn(i % 9 == 0 ? 1e7 : 5, 0.2, 3, 1, r);
         if (i % 3 == 1) bound.state.p_WA.x() += 1e5;
         return bound;
       });
     }},
    {"all sizes", true,
     [](Random* r) {
       return Several(40, 120, r, [&](int) {
         return BoundIn(1e3, r->LogUniform(1e-3, 1e3), r->LogUniform(1e-3, 1e2), 1, r);
       });
     }},
    {"all accelerations", true,
     [](Random* r) {
       return Several(40, 90, r,
                      [&](int) { return BoundIn(50, 0.5, 2, r->LogUniform(1e-6, 1e6), r); });
     }},
    {"one point", true,
     [](Random* r) { return Several(10, 60, r, [&](int) { return BoundIn(0, 0.5, 5, 2, r); }); }},
    {"identical", true,
     [](Random* r) {
       const motion::SpaceTimeBound bound = BoundIn(3, 0.5, 5, 2, r);
       return Several(2, 40, r, [&](int) { return bound; });
     }},
    {"lattice", true,
     [](Random* r) {
       return Several(64, 125, r, [&](int i) {
         motion::SpaceTimeBound bound = BoundIn(0, 0.25, 0, 1, r);
         bound.state.p_WA = {2.0 * (i % 5), 2.0 * (i / 5 % 5), 2.0 * (i / 25)};
         return bound;
       });
     }},
    {"convoy", true,
     [](Random* r) {
       return Several(40, 90, r, [&](int) {
         motion::SpaceTimeBound bound = BoundIn(30, 0.5, 1, 0.5, r);
         bound.state.v_WA.x() += 1e4;
         return bound;
       });
     }},
    {"one fast among still ones", true,
     [](Random* r) {
       return Several(40, 120, r, [&](int i) {
         return i == 7 ? BoundIn(50, 0.5, 1e4, 10, r) : BoundIn(50, 0.5, 0, 0, r);
       });
     }},
    {"plane", true,
     [](Random* r) {
       return Several(40, 120, r, [&](int) {
         motion::SpaceTimeBound bound = BoundIn(60, 0.5, 5, 1, r);
         bound.state.p_WA.z() = bound.state.v_WA.z() = 0;
         return bound;
       });
     }},
    {"line", true,
     [](Random* r) {
       return Several(40, 120, r, [&](int) {
         motion::SpaceTimeBound bound = BoundIn(300, 0.5, 5, 1, r);
         bound.state.p_WA.tail<2>().setZero();
         return bound;
       });
     }},
    {"empty space", true,
     [](Random* r) { return Several(1, 3, r, [&](int) { return BoundIn(1e9, 0.5, 5, 1, r); }); }},
    {"far from the origin", true,
     [](Random* r) {
       return Several(40, 90, r, [&](int) {
         motion::SpaceTimeBound bound = BoundIn(20, 0.5, 5, 1, r);
         bound.state.p_WA.array() += 1e12;
         return bound;
       });
     }},
    {"tiny", false,
     [](Random* r) {
       return Several(40, 90, r, [&](int) { return BoundIn(2e-11, 1e-12, 1e-12, 1e-12, r); });
     }},
    {"known accelerations", true,
     [](Random* r) {
       return Several(40, 90, r, [&](int) {
         motion::SpaceTimeBound bound = BoundIn(30, 0.5, 5, r->Uniform(0, 0.5), r);
         bound.state.a_WA = r->LogUniform(1e-2, 10) * r->UnitVector();
         return bound;
       });
     }},
    {"known and changing accelerations", false,
     [](Random* r) {
       return Several(40, 90, r, [&](int i) {
         motion::SpaceTimeBound bound = BoundIn(200, 0.5, 5, 0, r);
         if (i % 3 != 0) bound.state.a_WA = r->LogUniform(1e-2, 10) * r->UnitVector();
         if (i % 4 != 0) bound.limits.jerk_max = r->LogUniform(1e-3, 1);
         return bound;
       });
     }},
    {"all fall together", true,
     [](Random* r) {
       return Several(40, 90, r, [&](int) {
         motion::SpaceTimeBound bound = BoundIn(100, 0.5, 5, 0.01, r);
         bound.state.a_WA = {0, 0, -9.81};
         return bound;
       });
     }},
    {"other stamps", false,
     [](Random* r) {
       return Several(10, 60, r, [&](int) {
         motion::SpaceTimeBound bound = BoundIn(20, 0.5, 5, 2, r);
         bound.state.stamp = numeric::AddRoundedUp(kMethodStart, -r->LogUniform(1e-6, 100));
         return bound;
       });
     }},
    {"errors, skew, steps", true,
     [](Random* r) {
       return Several(10, 60, r, [&](int) {
         motion::SpaceTimeBound bound = BoundIn(30, 0.5, 5, 2, r);
         bound.state.position_error = r->Uniform(0, 0.2);
         bound.state.velocity_error = r->Uniform(0, 0.2);
         bound.limits.time_step = 0.01;
         bound.skew = 0.02;
         return bound;
       });
     }},
    {"masks and expiries", true,
     [](Random* r) {
       return Several(10, 90, r, [&](int) {
         AgentBound agent = BoundIn(15, 0.5, 5, 2, r);
         agent.filter.group = 1u << r->Below(4);
         agent.filter.mask = static_cast<std::uint32_t>(r->Below(16));
         if (r->Chance(0.5))
           agent.bound.state.expiry = numeric::AddRoundedUp(kMethodStart, r->Uniform(0, 3));
         return agent;
       });
     }},
    {"assemblies and lists", true,
     [](Random* r) {
       return Several(40, 90, r, [&](int) {
         AgentBound agent = BoundIn(6, 0.5, 5, 2, r);
         agent.filter = DrawFilter(r);
         return agent;
       });
     }},
    {"directions", true,
     [](Random* r) {
       return Several(10, 90, r, [&](int) {
         motion::SpaceTimeBound bound = BoundIn(20, 0.5, 5, 5, r);
         bound.state.direction = r->UnitVector();
         if (r->Chance(0.5))
           bound.state.direction_until = numeric::AddRoundedUp(kMethodStart, r->Uniform(0, 3));
         return bound;
       });
     }},
    {"beyond all measure", false,
     [](Random* r) {
       return Several(10, 60, r, [&](int i) {
         motion::SpaceTimeBound bound = BoundIn(20, 0.5, 5, 1, r);
         if (i % 5 == 0) bound.limits.radius = r->LogUniform(1, 1e300);
         if (i % 5 == 1) bound.state.p_WA.x() = r->LogUniform(1, 1e300);
         if (i % 5 == 2) bound.limits.acceleration_max = r->LogUniform(1e-300, 1e18);
         if (i % 5 == 3) bound.state.v_WA.y() = r->LogUniform(1, 1e200);
         return bound;
       });
     }},
};

}  // namespace collision::broad_phase
