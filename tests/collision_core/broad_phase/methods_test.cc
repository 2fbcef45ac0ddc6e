// Goal:   every method gives the same answer to the same query: same pair, same bits.
// Method: thousands of seeded scenes, ordinary and adversarial, and long histories of admissions,
//         removals, teleports, widenings and kept states; the oracle asks the canonical routine for
//         every pair.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "collision_core/numeric/seconds.h"
#include "tests/collision_core/broad_phase/method_scenes.h"
#include "tests/support/sanitized.h"

namespace collision::broad_phase {
namespace {

constexpr int kScenes = kSanitized ? 6 : 60;

using Agents = SceneAgents;

std::optional<intersection::IntersectingPair> Oracle(const Agents& agents,
                                                     const intersection::BroadQuery& query,
                                                     int only = -1) {
  std::optional<intersection::IntersectingPair> best;
  for (std::uint32_t a = 0; a < agents.size(); ++a) {
    for (std::uint32_t b = a + 1; b < agents.size(); ++b) {
      if (!agents[a] || !agents[b]) continue;
      if (only >= 0 && a != static_cast<std::uint32_t>(only) &&
          b != static_cast<std::uint32_t>(only))
        continue;
      const intersection::IntersectingPair meeting{
          a, b, EarliestIntersectionOf(query, *agents[a], *agents[b])};
      if (!meeting.time.instant().is_never() && (!best || meeting < *best)) best = meeting;
    }
  }
  return best;
}

std::string Text(const std::optional<intersection::IntersectingPair>& meeting) {
  if (!meeting) return "none";
  return std::to_string(meeting->lower) + " x " + std::to_string(meeting->higher) + " at " +
         std::to_string(meeting->time.base.nanoseconds()) + " ns + " +
         testing::PrintToString(meeting->time.seconds) + " s";
}

void ExpectSame(const std::optional<intersection::IntersectingPair>& got,
                const std::optional<intersection::IntersectingPair>& expected,
                const std::string& what) {
  ASSERT_EQ(Text(got), Text(expected)) << what;
  if (got) {
    ASSERT_EQ(got->time.seconds, expected->time.seconds) << what;
  }
}

/// Partners by `until`, and of the later ones the first up to `horizon`, in the order of indices.
std::vector<std::string> ExpectedMeetings(const Agents& agents, std::uint32_t agent, Instant from,
                                          Instant until, Instant horizon) {
  std::vector<std::pair<std::uint32_t, intersection::IntersectionTime>> all;
  std::optional<std::pair<std::uint32_t, intersection::IntersectionTime>> next;
  for (std::uint32_t other = 0; other < agents.size(); ++other) {
    if (other == agent || !agents[other]) continue;
    const intersection::IntersectionTime time =
        EarliestIntersection(*agents[agent], *agents[other], from);
    if (time.instant() <= until) {
      all.emplace_back(other, time);
    } else if (!time.instant().is_never() && time.instant() <= horizon &&
               (!next || time.instant() < next->second.instant())) {
      next = {other, time};
    }
  }
  if (next) all.push_back(*next);
  std::vector<std::string> texts;
  std::sort(all.begin(), all.end(), [](auto& a, auto& b) { return a.first < b.first; });
  for (const auto& [other, time] : all) {
    texts.push_back(std::to_string(other) + " at " + testing::PrintToString(time.seconds));
  }
  return texts;
}

std::vector<std::string> MeetingsOf(SweepingIndex& method, std::uint32_t agent, Instant from,
                                    Instant until, Instant horizon) {
  std::vector<Neighbour> meetings;
  method.FindNeighbours(
      agent, {from, until, horizon}, [](std::uint32_t) { return false; }, &meetings);
  std::vector<std::string> texts;
  for (const Neighbour& meeting : meetings) {
    texts.push_back(std::to_string(meeting.partner) + " at " +
                    testing::PrintToString(meeting.time.seconds));
  }
  return texts;
}

class Methods : public testing::TestWithParam<NamedMethod> {};

TEST_P(Methods, FindTheSameEarliestMeetingInEveryScene) {
  for (const NamedScene& scene : kMethodScenes) {
    for (int seed = 0; seed < kScenes; ++seed) {
      Random random(1000 + seed);
      const Agents agents = scene.make(&random);
      const auto method = GetParam().make();
      for (std::uint32_t a = 0; a < agents.size(); ++a) method->Set(a, *agents[a]);
      const std::string what = std::string(scene.name) + ", seed " + std::to_string(seed);
      for (const intersection::BoundKind bound :
           {intersection::BoundKind::kHorn, intersection::BoundKind::kHypertrapezoid}) {
        const double horizon = random.LogUniform(1e-3, 10);
        const intersection::BroadQuery query{bound, kMethodStart,
                                             numeric::AddRoundedUp(kMethodStart, horizon)};
        ExpectSame(method->Earliest(query), Oracle(agents, query), what);
        const auto one = static_cast<std::uint32_t>(random.Below(agents.size()));
        ExpectSame(method->EarliestOf(one, query), Oracle(agents, query, static_cast<int>(one)),
                   what + ", agent " + std::to_string(one));
      }
      const intersection::BroadQuery forever{intersection::BoundKind::kHorn, kMethodStart,
                                             Instant::Never()};
      ExpectSame(method->Earliest(forever), Oracle(agents, forever), what + ", for ever");
      if (HasFatalFailure()) return;
    }
  }
}

TEST_P(Methods, TellTheSameMeetingsOfOneAgent) {
  for (const NamedScene& scene : kMethodScenes) {
    for (int seed = 0; seed < kScenes; ++seed) {
      Random random(2000 + seed);
      const Agents agents = scene.make(&random);
      const auto method = GetParam().make();
      for (std::uint32_t a = 0; a < agents.size(); ++a) method->Set(a, *agents[a]);
      for (int query = 0; query < 4; ++query) {
        const auto agent = static_cast<std::uint32_t>(random.Below(agents.size()));
        const Instant from = numeric::AddRoundedUp(kMethodStart, random.Uniform(-0.5, 1));
        const Instant until = numeric::AddRoundedUp(from, random.LogUniform(1e-3, 10));
        const Instant horizon = random.Chance(0.5)
                                    ? Instant::Never()
                                    : numeric::AddRoundedUp(until, random.LogUniform(0.01, 100));
        ASSERT_EQ(MeetingsOf(*method, agent, from, until, horizon),
                  ExpectedMeetings(agents, agent, from, until, horizon))
            << scene.name << ", seed " << seed << ", agent " << agent;
      }
    }
  }
}

/// A state that keeps the contract of `bound`, some time later.
motion::SpaceTimeBound Later(const motion::SpaceTimeBound& bound, Instant stamp, Random* random) {
  motion::SpaceTimeBound next = bound;
  const double s = numeric::SecondsBetween(bound.state.stamp, stamp).lower;
  const double acceleration_max = bound.limits.acceleration_max;
  next.state.stamp = stamp;
  next.state.p_WA += bound.state.v_WA * s + random->UnitVector() * (0.45 * acceleration_max * s *
                                                                    s * random->Uniform(0, 1));
  next.state.v_WA += random->UnitVector() * (0.9 * acceleration_max * s * random->Uniform(0, 1));
  return next;
}

TEST_P(Methods, StayRightThroughLongHistories) {
  for (const NamedScene& scene : kMethodScenes) {
    if (!scene.changes) continue;
    for (int seed = 0; seed < kScenes / 6; ++seed) {
      Random random(3000 + seed);
      Agents agents = scene.make(&random);
      const auto method = GetParam().make();
      for (std::uint32_t a = 0; a < agents.size(); ++a) method->Set(a, *agents[a]);
      Instant now = kMethodStart;
      for (int step = 0; step < 60; ++step) {
        now = numeric::AddRoundedUp(now, random.Uniform(0, 0.05));
        for (int change = 0; change < 6; ++change) {
          const auto agent = static_cast<std::uint32_t>(random.Below(agents.size()));
          const double kind = random.Uniform(0, 1);
          if (!agents[agent] || kind < 0.1) {  // admission, teleport
            agents[agent] = *scene.make(&random).front();
            agents[agent]->bound.state.stamp = now;
            method->Set(agent, *agents[agent]);
          } else if (kind < 0.15) {
            agents[agent].reset();
            method->Remove(agent);
          } else if (kind < 0.3) {  // widening
            agents[agent]->bound.limits.acceleration_max *= 1.5;
            method->Set(agent, *agents[agent]);
          } else if (agents[agent]->bound.state.stamp < now) {
            agents[agent]->bound = Later(agents[agent]->bound, now, &random);
            method->Tighten(agent, *agents[agent]);
          }
        }
        const intersection::BroadQuery query{
            intersection::BoundKind::kHorn, now,
            numeric::AddRoundedUp(now, random.LogUniform(0.01, 5))};
        const std::string what = std::string(scene.name) + ", seed " + std::to_string(seed) +
                                 ", step " + std::to_string(step);
        method->Validate();
        if (step % 10 == 0) ExpectSame(method->Earliest(query), Oracle(agents, query), what);
        const auto one = static_cast<std::uint32_t>(random.Below(agents.size()));
        if (!agents[one]) continue;
        ExpectSame(method->EarliestOf(one, query), Oracle(agents, query, static_cast<int>(one)),
                   what);
        const Instant from = random.Chance(0.3) ? numeric::AddRoundedUp(now, -0.2) : now;
        ASSERT_EQ(MeetingsOf(*method, one, from, query.until, Instant::Never()),
                  ExpectedMeetings(agents, one, from, query.until, Instant::Never()))
            << what;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Methods, testing::ValuesIn(kMethods),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace collision::broad_phase
