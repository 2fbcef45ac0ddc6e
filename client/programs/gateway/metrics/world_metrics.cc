#include "client/programs/gateway/metrics/world_metrics.h"

#include <limits>
#include <set>
#include <string_view>

#include "client/programs/gateway/metrics/metrics_text.h"
#include "client/programs/tools/collisionctl/status/verdict.h"
#include "idl/histogram.h"

namespace collision::gateway {
namespace {

using Type = MetricsText::Type;

constexpr double kNanosecond = 1e-9, kMicrosecond = 1e-6;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::string_view kRejected = "rejected_", kEvents = "events_";

/// Counters of the status that go up and down; all others only grow.
bool IsGauge(const std::string& name) {
  static const std::set<std::string> gauges = {"simulators_unlisted",
                                               "unproven_inputs",
                                               "shapes",
                                               "shapes_gathering",
                                               "shape_bytes",
                                               "tree_nodes",
                                               "tree_bytes",
                                               "trees_coarse",
                                               "trees_building",
                                               "tree_cache_bytes",
                                               "queued",
                                               "queries_per_second",
                                               "pairs_waiting",
                                               "levels_pairs_tracked",
                                               "levels_pairs_waiting",
                                               "hypothetical_agents",
                                               "screening_pairs_tracked"};
  return gauges.count(name) > 0;
}

void AddGateway(const GatewayMeasures& measures, MetricsText* text) {
  text->Begin("collision_gateway_info", Type::kGauge, "Version of the gateway and its world.");
  text->Add(1, {{"version", measures.version}, {"world", measures.world}});
  text->Begin("collision_service_up", Type::kGauge, "Whether the service of the world is heard.");
  text->Add(measures.service_up ? 1 : 0);
  text->Begin("collision_gateway_viewers", Type::kGauge, "Viewers that are connected.");
  text->Add(measures.viewers);
  text->Begin("collision_gateway_contacts_missed_total", Type::kCounter,
              "Contacts that the network lost on their way to the gateway.");
  text->Add(static_cast<double>(measures.contacts_missed));
}

void AddService(const v1::ServiceStatus& status, const client::WorldView& view, MetricsText* text) {
  text->Begin("collision_service_info", Type::kGauge, "Version and build of the service.");
  text->Add(1, {{"version", status.version()}, {"build", status.build()}});
  text->Begin("collision_service_well", Type::kGauge,
              "Whether nothing waits, fails or is refused, as collisionctl status says.");
  text->Add(client::Verdict(view).front().starts_with("WELL") ? 1 : 0);
  const auto gauge = [text](const char* name, const char* help, double value) {
    text->Begin(name, Type::kGauge, help);
    text->Add(value);
  };
  gauge("collision_world_time_seconds", "The time of the world.",
        kNanosecond * static_cast<double>(status.now_ns()));
  gauge("collision_service_term", "Grows when another service takes over.", status.stamp().term());
  gauge("collision_service_start_time_seconds", "When the service started, since 1970.",
        kNanosecond * static_cast<double>(status.started_ns()));
  gauge("collision_service_memory_bytes", "Resident memory of the service.",
        static_cast<double>(status.memory_bytes()));
  gauge("collision_agents", "Agents in the world.", status.agents());
  gauge("collision_pairs_tracked", "Pairs that are tracked.", status.pairs_tracked());
  gauge("collision_standby_services", "Services that stand by.",
        static_cast<double>(view.Standbys().size()));
  text->Begin("collision_service_cpu_seconds_total", Type::kCounter,
              "Processor time of the service.");
  text->Add(kMicrosecond * static_cast<double>(status.cpu_us()));
}

void AddSimulators(const v1::ServiceStatus& status, MetricsText* text) {
  const auto each = [&](const char* name, Type type, const char* help, auto value) {
    text->Begin(name, type, help);
    for (const v1::SimulatorStatus& one : status.simulators()) {
      text->Add(static_cast<double>(value(one)), {{"simulator", one.name()}});
    }
  };
  using Simulator = const v1::SimulatorStatus&;
  each("collision_simulator_alive", Type::kGauge, "Whether the simulator is heard.",
       [](Simulator one) { return one.alive() ? 1 : 0; });
  each("collision_simulator_agents", Type::kGauge, "Agents of the simulator.",
       [](Simulator one) { return one.agents(); });
  each("collision_simulator_clock_seconds", Type::kGauge, "The last clock of the simulator.",
       [](Simulator one) { return kNanosecond * static_cast<double>(one.clock_ns()); });
  each("collision_simulator_states_total", Type::kCounter, "States accepted of the simulator.",
       [](Simulator one) { return one.states(); });
  each("collision_simulator_rejected_total", Type::kCounter, "Samples refused of the simulator.",
       [](Simulator one) { return one.rejected(); });
  each("collision_simulator_refused", Type::kGauge, "Things of the simulator refused now.",
       [](Simulator one) { return one.refused_now(); });
  for (const bool is_limit : {false, true}) {
    text->Begin(is_limit ? "collision_simulator_quota_limit" : "collision_simulator_quota_used",
                Type::kGauge,
                is_limit ? "What the simulator may have of a limit of the world."
                         : "What the simulator has of a limit of the world.");
    for (const v1::SimulatorStatus& one : status.simulators()) {
      for (const v1::QuotaUse& use : one.quotas()) {
        text->Add(static_cast<double>(is_limit ? use.most() : use.used()),
                  {{"simulator", one.name()}, {"resource", use.resource()}});
      }
    }
  }
}

void AddCounters(const v1::ServiceStatus& status, MetricsText* text) {
  const auto group = [&](std::string_view prefix, const char* name, const char* label,
                         const char* help) {
    text->Begin(name, Type::kCounter, help);
    for (const v1::Counter& counter : status.counters()) {
      if (!counter.name().starts_with(prefix)) continue;
      text->Add(static_cast<double>(counter.value()),
                {{label, counter.name().substr(prefix.size())}});
    }
  };
  group(kRejected, "collision_rejected_total", "reason", "Samples refused, by reason.");
  group(kEvents, "collision_events_total", "status", "Events that came to be so.");
  for (const v1::Counter& counter : status.counters()) {
    const std::string& name = counter.name();
    if (name.starts_with(kRejected) || name.starts_with(kEvents)) continue;
    const bool is_time = name.ends_with("_us");
    const std::string stem =
        "collision_" + (is_time ? name.substr(0, name.size() - 3) + "_seconds" : name);
    const bool is_gauge = IsGauge(name);
    text->Begin(is_gauge ? stem : stem + "_total", is_gauge ? Type::kGauge : Type::kCounter,
                "The counter " + name + " of the status.");
    text->Add(static_cast<double>(counter.value()) * (is_time ? kMicrosecond : 1));
  }
}

/// The name of a histogram ends in its unit.
void AddHistograms(const v1::ServiceStatus& status, MetricsText* text) {
  for (const v1::Histogram& histogram : status.histograms()) {
    const std::string& name = histogram.name();
    const bool is_us = name.ends_with("_us");
    const double in_a_second = is_us ? 1e6 : 1e9;
    text->Begin("collision_" + name.substr(0, name.size() - 3) + "_seconds", Type::kHistogram,
                "The histogram " + name + " of the status.");
    std::uint64_t so_far = 0;
    for (int i = 0; i < histogram.counts_size(); ++i) {
      so_far += histogram.counts(i);
      if (i + 1 == wire::kHistogramCountsMax) break;
      const auto end = static_cast<double>(wire::ClassEnd(static_cast<std::size_t>(i)));
      text->AddBucket(end / in_a_second, so_far);
    }
    text->AddBucket(kInfinity, so_far);
    text->AddCount(so_far);
  }
}

}  // namespace

std::string WorldMetrics(const client::WorldView& view, const GatewayMeasures& measures) {
  MetricsText text;
  AddGateway(measures, &text);
  if (!view.status() || !measures.service_up) return text.text();
  AddService(*view.status(), view, &text);
  AddSimulators(*view.status(), &text);
  AddCounters(*view.status(), &text);
  AddHistograms(*view.status(), &text);
  return text.text();
}

}  // namespace collision::gateway
