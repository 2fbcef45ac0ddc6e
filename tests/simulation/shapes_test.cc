// Goal:   of agents with shapes no contact comes unannounced and no promise outlasts one, on a
//         network that loses, repeats and delays, and across a restart of the service; and the log
//         is the same in every run and build.
// Method: meshes that move exactly and do not turn; the truth by brute force over all triangles, in
//         steps that no motion outruns.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "idl/shape_bytes.h"
#include "tests/simulation/scenario.h"
#include "tests/support/meshes.h"
#include "tests/support/truth/true_distance.h"

namespace collision::server {
namespace {

/// As in golden_test.cc: changes with the detector's answers, and only then.
struct Golden {
  v1::Config::TreeBuilder builder;
  std::uint64_t hash;
};
constexpr Golden kGolden[] = {{v1::Config::OCTREE, 0x8ee9be37c3e9d511},
                              {v1::Config::FITTED, 0xe026e864ed59c87e}};

constexpr std::int64_t kEnd = 8 * kSecond;

struct Kind {
  std::shared_ptr<const shape::Shape> shape;  // null: a ball
  std::string bytes;
};

const std::vector<Kind>& Kinds() {
  static const std::vector<Kind> kinds = [] {
    std::vector<Kind> made(1);
    for (const geometry::TriangleMesh& mesh : {LShape(), Rod(1.2, 0.15), Tetrahedron(0.6)}) {
      ShapeContent content;
      for (const auto& p : mesh.vertices) content.vertices.push_back({p.x(), p.y(), p.z()});
      content.triangles = mesh.triangles;
      made.push_back({shape::Shape::Build(mesh), EncodeShape(content)});
    }
    return made;
  }();
  return kinds;
}

struct Player {
  detection::AgentId id;
  SimulatedAgent agent;
  std::shared_ptr<const shape::Shape> shape;

  TrueBody At(std::int64_t t_ns) const {
    return {shape.get(), agent.radius, agent.motion.At(t_ns).TrueAt(t_ns)};
  }
};

std::vector<SimulatedAgent> Wanderers(int count, Random* random) {
  const WanderOptions options{.half_side = 4, .speed = 4, .acceleration_max = 2};
  std::vector<SimulatedAgent> agents;
  for (int i = 0; i < count; ++i) {
    const Kind& kind = Kinds()[random->Below(Kinds().size())];
    agents.push_back({.radius = kind.shape ? kind.shape->facts().radius : 0.5,
                      .acceleration_max = options.acceleration_max,
                      .motion = Wander(options, kEnd, random),
                      .shape_bytes = kind.bytes});
  }
  return agents;
}

std::vector<Player> PlayersOf(const Scenario& scenario) {
  std::vector<Player> players;
  for (const SimulatedSimulator* simulator : scenario.simulators()) {
    for (std::uint32_t slot = 0; slot < simulator->agents().size(); ++slot) {
      const SimulatedAgent& agent = simulator->agents()[slot];
      const auto kind = std::find_if(Kinds().begin(), Kinds().end(), [&](const Kind& candidate) {
        return candidate.bytes == agent.shape_bytes;
      });
      players.push_back({simulator->AgentAt(slot), agent, kind->shape});
    }
  }
  return players;
}

/// The first instant at which the two touch, late by a tenth of a millisecond at most; kEnd: they
/// do not.
std::int64_t FirstTouch(const Player& a, const Player& b) {
  constexpr Real kSpeed = 16;  // of both; wanderers brake above 4 m/s
  for (std::int64_t t = 0; t < kEnd;) {
    const Real distance = SolidDistance(a.At(t), b.At(t));
    if (distance == 0) return t;
    t += std::max<std::int64_t>(100'000, static_cast<std::int64_t>(distance / kSpeed * 1e9L));
  }
  return kEnd;
}

bool IsOf(const v1::AgentId& wire, const detection::AgentId& id) {
  return wire.simulator_id() == id.simulator && wire.slot() == id.slot;
}

// When an event of the pair first appeared, and whether the last revision of any of them contains
// the instant.
struct PairReport {
  std::int64_t first_ns = std::numeric_limits<std::int64_t>::max();
  bool holds = false;
};

PairReport PairReportOf(const Scenario& scenario, const Player& a, const Player& b,
                        std::int64_t t_ns) {
  PairReport report;
  for (const v1::CollisionEvent& event : scenario.events()) {
    const bool of_pair = (IsOf(event.lower(), a.id) && IsOf(event.higher(), b.id)) ||
                         (IsOf(event.lower(), b.id) && IsOf(event.higher(), a.id));
    if (!of_pair) continue;
    report.first_ns = std::min(report.first_ns, event.now_ns());
    const bool confirmed =
        event.status() == v1::EVENT_CONFIRMED || event.status() == v1::EVENT_ENDED;
    const std::int64_t latest = confirmed ? event.begin().latest_ns() : event.end().latest_ns();
    report.holds |= event.begin().earliest_ns() <= t_ns && t_ns - 200'000 <= latest;
    // What is certain is true.
    if (confirmed) {
      const std::int64_t at = event.begin().latest_ns();
      EXPECT_LE(static_cast<double>(SolidDistance(a.At(at), b.At(at))), 1e-7) << at;
    }
  }
  return report;
}

int CheckNeverLate(const Scenario& scenario) {
  const std::vector<Player> players = PlayersOf(scenario);
  std::map<detection::AgentId, std::int64_t> first_of;
  int contacts = 0;
  for (std::size_t i = 0; i < players.size(); ++i) {
    for (std::size_t k = i + 1; k < players.size(); ++k) {
      const Player &a = players[i], &b = players[k];
      const std::int64_t touch = FirstTouch(a, b);
      for (const detection::AgentId& id : {a.id, b.id}) {
        const auto [first, added] = first_of.try_emplace(id, touch);
        first->second = std::min(first->second, touch);
      }
      if (touch == 0 || touch >= kEnd) continue;
      ++contacts;
      const PairReport report = PairReportOf(scenario, a, b, touch);
      EXPECT_LE(report.first_ns, touch) << a.id.slot << " and " << b.id.slot;
      EXPECT_TRUE(report.holds) << a.id.slot << " and " << b.id.slot << " at " << touch;
    }
  }
  for (const v1::Output& output : scenario.published()) {
    if (!output.has_clearance()) continue;
    const v1::Clearance& sample = output.clearance();
    for (const v1::AgentClearance& agent : sample.agents()) {
      const detection::AgentId id{sample.simulator_id(), agent.slot(), sample.run(),
                                  agent.generation()};
      const auto first = first_of.find(id);
      const bool binds = first != first_of.end() && sample.now_ns() > 0 &&
                         sample.now_ns() < first->second && first->second < kEnd;
      if (binds) {
        EXPECT_LE(agent.clear_until_ns(), first->second) << agent.slot() << " " << sample.now_ns();
      }
    }
  }
  return contacts;
}

void AddTwo(std::uint64_t seed, Scenario* scenario) {
  Random random(seed);
  scenario->Add({.name = "alpha", .sender = 1, .period_ns = 50'000'000, .end_ns = kEnd},
                Wanderers(8, &random));
  scenario->Add(
      {.name = "beta", .sender = 2, .period_ns = 125'000'000, .end_ns = kEnd, .chunk_size = 2},
      Wanderers(8, &random));
}

TEST(SimulatedShapes, NeverLateAndTheSameEverywhere) {
  for (const auto& [builder, golden] : kGolden) {
    std::uint64_t hash = 0;
    for (const int run : {0, 1}) {
      v1::Config config = ConfigFor(2);
      config.set_tree_builder(builder);
      Scenario scenario(config, Lossy(3));
      AddTwo(21, &scenario);
      scenario.StartService();
      scenario.StartSimulators();
      scenario.Run();
      for (const SimulatedSimulator* simulator : scenario.simulators()) {
        EXPECT_TRUE(simulator->finished());
        EXPECT_FALSE(simulator->grant_withdrawn());
      }
      EXPECT_EQ(scenario.counter("breaches"), 0u);
      if (run == 1) {
        EXPECT_EQ(scenario.daemon().event_log().hash(), hash);
        continue;
      }
      hash = scenario.daemon().event_log().hash();
      EXPECT_EQ(hash, golden) << std::hex << hash;
      EXPECT_GE(CheckNeverLate(scenario), 5);
    }
  }
}

TEST(SimulatedShapes, NeverLateAcrossARestart) {
  for (const std::uint64_t seed : {22, 23}) {
    Scenario scenario(ConfigFor(2), Lossy(seed));
    AddTwo(seed, &scenario);
    scenario.StartService();
    scenario.StartSimulators();
    scenario.network().At(100'000'000, [] {});
    scenario.Run(100'000'000);
    EXPECT_GT(scenario.simulators().front()->clock_ns(), 0);
    EXPECT_LT(scenario.simulators().front()->clock_ns(), kEnd / 2);
    scenario.StartService();
    scenario.Run();
    for (const SimulatedSimulator* simulator : scenario.simulators()) {
      EXPECT_TRUE(simulator->finished()) << seed;
    }
    EXPECT_GE(CheckNeverLate(scenario), 4) << seed;
  }
}

}  // namespace
}  // namespace collision::server
