#include "server/publish/status.h"

#include <gtest/gtest.h>

#include <set>

#include "server/config/config_digest.h"
#include "tests/server/messages.h"
#include "tests/server/scripted_bus.h"

namespace collision::server {
namespace {

v1::Config Harbour() {
  v1::Config config = Simulated();
  config.set_world("harbour");
  return config;
}

// Goal:   a status names the world, its simulators, what was counted, the method and the event
//         log, each counter once, within the bounds of collision.idl.
TEST(Status, TellsWhatTheServiceKnows) {
  ScriptedDaemon daemon(Harbour());
  daemon.Step({From(1, Description("alpha", 0)), From(1, State(0, 0, 1), "alpha"),
               From(1, ClockOf("alpha", 0))});
  const v1::ServiceStatus status = daemon.status();
  EXPECT_EQ(status.world(), "harbour");
  EXPECT_TRUE(status.simulated_clock());
  EXPECT_EQ(status.agents(), 1u);
  EXPECT_EQ(status.service_id(), 1u);
  EXPECT_FALSE(status.version().empty());
  EXPECT_FALSE(status.broad_phase().empty());
  ASSERT_EQ(status.simulators_size(), 1);
  EXPECT_EQ(status.simulators(0).name(), "alpha");
  EXPECT_TRUE(status.simulators(0).alive());
  EXPECT_EQ(status.simulators(0).agents(), 1u);
  EXPECT_EQ(status.simulators(0).states(), 1u);
  EXPECT_EQ(status.simulators(0).granted_until_ns(), 10'000'000'000);
  EXPECT_LE(status.counters_size(), 96);
  std::set<std::string> names;
  for (const v1::Counter& counter : status.counters()) {
    EXPECT_TRUE(names.insert(counter.name()).second) << counter.name();
    EXPECT_LE(counter.name().size(), 64u);
  }
  for (const char* name : {"events_possible",
                           "events_ended",
                           "rejected_not_finite",
                           "breaches",
                           "states_older",
                           "states_repeated",
                           "queries",
                           "batches",
                           "shapes",
                           "shapes_refused",
                           "shape_bytes",
                           "tree_nodes",
                           "tree_bytes",
                           "trees_building",
                           "trees_coarse",
                           "tree_build_us",
                           "work_units",
                           "queued",
                           "queries_per_second",
                           "updates_kept",
                           "filter_tests",
                           "method_changes",
                           "tree_cache_hits",
                           "tree_cache_misses",
                           "tree_cache_discarded",
                           "tree_cache_stored",
                           "tree_cache_failed",
                           "tree_cache_removed",
                           "tree_cache_bytes"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
  ASSERT_EQ(status.extensions_size(), 4);
  EXPECT_EQ(status.extensions(0).key(), "event_log_count");
  EXPECT_EQ(status.extensions(1).value(), "cbf29ce484222325");
  EXPECT_EQ(status.extensions(2).key(), "tree_builder");
  EXPECT_TRUE(status.extensions(2).value() == "octree" || status.extensions(2).value() == "fitted");
  EXPECT_EQ(Extension(status, "lease_s"), "2");
  EXPECT_EQ(status.configuration(), ConfigurationDigest(CompleteConfig(Harbour())));
}

// Goal:   what the network did not deliver stands among the counters, as the bus tells it.
TEST(Status, TellsTheNetworksCounters) {
  ScriptedDaemon daemon(Harbour());
  v1::Counter& lost = daemon.bus().counters.emplace_back();
  lost.set_name("network_samples_lost");
  for (const std::uint64_t value : {3, 4}) {
    lost.set_value(value);
    EXPECT_EQ(daemon.counter("network_samples_lost"), value);
  }
}

// Goal:   a status says where its service runs, and who writes more than it may.
TEST(Status, NamesItsProcessAndThoseThatFlood) {
  ScriptedDaemon daemon(Harbour(), DaemonParts{.process = "pid 7 on host-a"});
  EXPECT_EQ(Extension(daemon.status(), "process"), "pid 7 on host-a");
  EXPECT_EQ(Extension(daemon.status(), "flooding"), "");
  daemon.bus().floods = {"simulator \"a\": 5 messages dropped; 0 wait", "another one"};
  EXPECT_EQ(Extension(daemon.status(), "flooding"),
            "simulator \"a\": 5 messages dropped; 0 wait, another one");
}

// Goal:   the method is the one that the configuration asks for, and says so; AUTO says why by the
//         number of agents. Queries, queued agents and kept updates are counted.
TEST(Status, TellsTheMethodAndWhatItCost) {
  const std::pair<v1::Config::BroadPhase, const char*> methods[] = {
      {v1::Config::AUTO, "all pairs"},
      {v1::Config::ALL_PAIRS, "all pairs"},
      {v1::Config::SPATIAL_INDEX, "spatial index"}};
  for (const auto& [method, name] : methods) {
    v1::Config config = Harbour();
    config.set_broad_phase(method);
    ScriptedDaemon daemon(config);
    daemon.Step({From(1, Description("alpha", 0)), From(1, State(0, 0, 1), "alpha"),
                 From(1, ClockOf("alpha", 0))});
    EXPECT_EQ(daemon.status().broad_phase(), name);
    EXPECT_EQ(daemon.status().broad_phase_why(), method == v1::Config::AUTO
                                                     ? "1 agents: up to 128 it costs least"
                                                     : "1 agents; the configuration asks for it");
    EXPECT_EQ(daemon.counter("queries"), 1u);
    EXPECT_EQ(daemon.counter("queries_per_second"), 0u) << "nothing to compare with yet";
    EXPECT_EQ(daemon.counter("queued"), 1u);
    EXPECT_EQ(daemon.counter("updates_kept"), 0u);
  }
}

TEST(Status, ARateIsPerSecondSinceTheLastCall) {
  Rate rate;
  EXPECT_EQ(rate.Take(50, 7'000'000'000), 0u);
  EXPECT_EQ(rate.Take(60, 7'500'000'000), 20u);
  EXPECT_EQ(rate.Take(60, 8'500'000'000), 0u);
  EXPECT_EQ(rate.Take(64, 8'500'000'000), 0u) << "no time has passed";
}

// Goal:   of more simulators than a status can list, those left out are counted.
TEST(Status, CountsTheSimulatorsItCannotList) {
  v1::Config config = Harbour();
  config.set_simulators_max(100);
  ScriptedDaemon daemon(config);
  for (std::uint64_t i = 1; i <= 67; ++i) {
    if (i == 65) {
      EXPECT_EQ(daemon.counter("simulators_unlisted"), 0u);
    }
    daemon.Step({From(i, Description("simulator-" + std::to_string(i), 0))});
  }
  EXPECT_EQ(daemon.status().simulators_size(), 64);
  EXPECT_EQ(daemon.counter("simulators_unlisted"), 3u);
}

// Goal:   a status comes at once when a simulator comes or goes, else once per period.
TEST(Status, ComesWhenSomethingChangesAndOncePerPeriod) {
  ScriptedDaemon daemon(Harbour());
  const auto count = [&daemon] {
    int statuses = 0;
    for (const v1::Output& output : daemon.bus().outputs) statuses += output.has_service_status();
    return statuses;
  };
  daemon.Step({});
  EXPECT_EQ(count(), 1);
  daemon.Step({}, 0.4);
  EXPECT_EQ(count(), 1);
  daemon.Step({From(1, Description("alpha", 0))});
  EXPECT_EQ(count(), 2);
  daemon.Step({From(1, State(0, 0, 1), "alpha")}, 0.4);
  EXPECT_EQ(count(), 2);
  daemon.Step({Liveliness(1, "alpha", false)});
  EXPECT_EQ(count(), 3);
  daemon.Step({}, 0.5);
  EXPECT_EQ(count(), 4);
}

}  // namespace
}  // namespace collision::server
