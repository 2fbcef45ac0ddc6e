// Goal:   every method answers a query about a bound that it does not hold as the canonical
//         routine does, pair by pair, and is left as it was.
// Method: all scenes of the methods; one agent's bound is not set but queried; the next
//         query about a held agent is answered as before.
#include <gtest/gtest.h>

#include "collision_core/broad_phase/adaptive_broad_phase.h"
#include "tests/collision_core/broad_phase/method_scenes.h"

namespace collision::broad_phase {
namespace {

constexpr int kScenes = 12;

using Answer = std::vector<std::pair<std::uint32_t, double>>;

Answer AnswerOf(const std::vector<Neighbour>& neighbours) {
  Answer answer;
  for (const Neighbour& neighbour : neighbours)
    answer.emplace_back(neighbour.partner, neighbour.time.seconds);
  return answer;
}

Answer Expected(const SceneAgents& agents, std::uint32_t guest, Instant from, Instant until) {
  Answer answer;
  for (std::uint32_t other = 0; other < agents.size(); ++other) {
    if (other == guest || other % 5 == 3) continue;
    const intersection::IntersectionTime time =
        EarliestIntersection(*agents[guest], *agents[other], from);
    if (time.instant() <= until && !time.instant().is_never()) {
      answer.emplace_back(other, time.seconds);
    }
  }
  return answer;
}

Answer AnswerFor(SweepingIndex* method, const AgentBound& bound, Instant from, Instant until) {
  std::vector<Neighbour> neighbours;
  const auto skip = [](std::uint32_t other) { return other % 5 == 3; };
  method->FindNeighbours(bound, from, until, skip, &neighbours);
  return AnswerOf(neighbours);
}

Answer AnswerForHeld(SweepingIndex* method, std::uint32_t agent, Instant from, Instant until) {
  std::vector<Neighbour> neighbours;
  const auto none = [](std::uint32_t) { return false; };
  method->FindNeighbours(agent, {from, until, until}, none, &neighbours);
  return AnswerOf(neighbours);
}

class NeighboursOfABound : public testing::TestWithParam<NamedMethod> {};

TEST_P(NeighboursOfABound, AreThoseOfTheCanonicalRoutine) {
  for (const NamedScene& scene : kMethodScenes) {
    for (int seed = 0; seed < kScenes; ++seed) {
      Random random(4000 + seed);
      const SceneAgents agents = scene.make(&random);
      const auto method = GetParam().make();
      const auto guest = static_cast<std::uint32_t>(random.Below(agents.size()));
      for (std::uint32_t a = 0; a < agents.size(); ++a) {
        if (a != guest) method->Set(a, *agents[a]);
      }
      const auto held = guest == 0 ? 1u : 0u;
      for (int query = 0; query < 3; ++query) {
        const Instant from = numeric::AddRoundedUp(kMethodStart, random.Uniform(-0.5, 1));
        const Instant until = numeric::AddRoundedUp(from, random.LogUniform(1e-3, 10));
        const Answer before = AnswerForHeld(method.get(), held, from, until);
        ASSERT_EQ(AnswerFor(method.get(), *agents[guest], from, until),
                  Expected(agents, guest, from, until))
            << scene.name << ", seed " << seed << ", bound of " << guest;
        ASSERT_EQ(AnswerForHeld(method.get(), held, from, until), before) << scene.name;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, NeighboursOfABound,
                         testing::Values(kMethods[0], kMethods[1], kMethods[2],
                                         NamedMethod{"Adaptive", &MakeMethod<AdaptiveBroadPhase>}),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace collision::broad_phase
