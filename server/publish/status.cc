#include "server/publish/status.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "idl/limits.h"
#include "server/process/version.h"
#include "server/publish/text/names_text.h"
#include "server/publish/text/wait_text.h"

namespace collision::server {
namespace {

std::string LowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return text;
}

void Count(const std::string& name, std::uint64_t value, v1::ServiceStatus* status) {
  v1::Counter& counter = *status->add_counters();
  counter.set_name(name);
  counter.set_value(value);
}

/// What a simulator may have as things are, beside what it has.
struct QuotaOf {
  Resource resource;
  std::uint64_t used, most;
};

std::vector<QuotaOf> QuotasOf(const StatusSources& sources, std::uint64_t simulator) {
  const ShapeCounters shapes = sources.shapes.counters();
  const std::pair<Resource, std::uint64_t> used_by_all[] = {
      {Resource::kAgents, sources.detectors.agents()},
      {Resource::kShapes, shapes.places},
      {Resource::kShapeBytes, shapes.bytes},
      {Resource::kTreeBytes, shapes.tree_bytes}};
  const SimulatorQuotas& quotas = sources.world.quotas();
  std::vector<QuotaOf> all;
  for (const auto& [resource, of_all] : used_by_all) {
    const std::uint64_t used = quotas.Used(simulator, resource);
    const std::uint64_t limit = LimitOf(sources.config, resource);
    const std::uint64_t free = limit - std::min(limit, of_all);
    if (used > 0) all.push_back({resource, used, used + quotas.RoomFor(simulator, resource, free)});
  }
  return all;
}

/// "OUT_OF_RANGE: states[2].velocity_m_s"; empty: nothing is refused.
std::string RefusalText(const StandingRefusals& refusals) {
  if (refusals.listed().empty()) return "";
  const Refusal& one = refusals.listed().begin()->second;
  const std::string reason =
      v1::RejectionReason_Name(one.reason).substr(std::string("REJECTED_").size());
  return (reason + ": " + one.field).substr(0, wire::kStatusRefusedWhyMax);
}

void AddSimulators(const StatusSources& sources, v1::ServiceStatus* status) {
  const World& world = sources.world;
  std::uint64_t unlisted = 0;
  for (const auto& [id, simulator] : world.simulators()) {
    if (simulator.has_left()) continue;
    if (status->simulators_size() == wire::kStatusSimulatorsMax) {
      ++unlisted;
      continue;
    }
    v1::SimulatorStatus& wire = *status->add_simulators();
    wire.set_simulator_id(id);
    wire.set_run(simulator.run());
    wire.set_name(simulator.name());
    wire.set_alive(simulator.alive());
    wire.set_clock_ns(simulator.time().clock().value_or(Instant::Always()).nanoseconds());
    wire.set_granted_until_ns(simulator.time().granted().value_or(Instant::Always()).nanoseconds());
    wire.set_agents(static_cast<std::uint32_t>(world.quotas().Used(id, Resource::kAgents)));
    wire.set_states(simulator.states());
    wire.set_rejected(simulator.refused());
    const OffsetBracket offset = simulator.sender_clock().offset(world.monotonic_ns());
    wire.mutable_clock_offset()->set_earliest_ns(offset.lower_ns);
    wire.mutable_clock_offset()->set_latest_ns(offset.upper_ns);
    for (const QuotaOf& quota : QuotasOf(sources, id)) {
      v1::QuotaUse& use = *wire.add_quotas();
      use.set_resource(Name(quota.resource));
      use.set_used(quota.used);
      use.set_most(quota.most);
    }
    wire.set_refused_now(static_cast<std::uint32_t>(simulator.refusals().count()));
    wire.set_refused_why(RefusalText(simulator.refusals()));
  }
  Count("simulators_unlisted", unlisted, status);
  Count("simulators_removed_silent", world.ended_runs().count(EndCause::kSilent), status);
  Count("simulators_evicted", world.ended_runs().count(EndCause::kEvicted), status);
}

void AddIntake(const StatusSources& sources, v1::ServiceStatus* status) {
  const IntakeCounters& intake = sources.intake.counters();
  const AgentCounters& agents = sources.intake.agent_counters();
  Count("batches", sources.steps.batches, status);
  Count("inputs", sources.steps.inputs, status);
  Count("clock_steps", sources.steps.clock_steps, status);
  Count("agents_admitted", agents.admitted, status);
  Count("agents_removed", agents.removed, status);
  Count("descriptions_received", intake.descriptions_received, status);
  Count("clocks_received", intake.clocks_received, status);
  Count("states_received", agents.states_received, status);
  Count("states_accepted", agents.states_accepted, status);
  Count("states_older", agents.states_older, status);
  Count("states_repeated", agents.states_repeated, status);
  for (int reason = 0; reason < v1::RejectionReason_ARRAYSIZE; ++reason) {
    const auto value = static_cast<v1::RejectionReason>(reason);
    Count(LowerCase(v1::RejectionReason_Name(value)), sources.rejections.count(value), status);
  }
  Count("removals_ignored", intake.removals_ignored, status);
  Count("unproven_inputs", sources.intake.unproven().size(), status);
  Count("unproven_dropped", sources.intake.unproven().dropped(), status);
  Count("rejections_suppressed", sources.rejections.suppressed(), status);
}

void AddShapes(const ShapeCounters& shapes, v1::ServiceStatus* status) {
  Count("shapes", shapes.visible, status);
  Count("shapes_gathering", shapes.gathering, status);
  Count("shapes_refused", shapes.refused, status);
  Count("shape_parts_received", shapes.parts_received, status);
  Count("shape_bytes", shapes.bytes, status);
  Count("tree_nodes", shapes.tree_nodes, status);
  Count("tree_bytes", shapes.tree_bytes, status);
  Count("trees_coarse", shapes.coarse, status);
  Count("tree_build_us", shapes.builder.microseconds, status);
  Count("trees_building", shapes.builder.building, status);
  const TreeCacheCounters& cache = shapes.builder.cache;
  Count("tree_cache_hits", cache.hits, status);
  Count("tree_cache_misses", cache.misses, status);
  Count("tree_cache_discarded", cache.discarded, status);
  Count("tree_cache_stored", cache.stored, status);
  Count("tree_cache_failed", cache.failed, status);
  Count("tree_cache_removed", cache.removed, status);
  Count("tree_cache_bytes", cache.bytes, status);
}

void AddDetection(const StatusSources& sources, v1::ServiceStatus* status) {
  const detection::DetectorCounters detector = sources.detectors.counted();
  const EventCounters events = sources.publisher.event_counters();
  for (int kind = 0; kind < v1::EventStatus_ARRAYSIZE; ++kind) {
    std::string name = LowerCase(v1::EventStatus_Name(static_cast<v1::EventStatus>(kind)));
    name.replace(0, std::string("event").size(), "events");
    Count(name, detector.events[kind], status);
  }
  Count(std::string(wire::kContactsCounter), events.contacts, status);
  Count("forecasts_published", events.forecasts, status);
  Count("forecasts_withheld", events.forecasts_withheld, status);
  Count("updates_kept", detector.updates_kept, status);
  Count("discontinuities", detector.jumps, status);
  Count("widenings", detector.widenings, status);
  Count("breaches", detector.breaches, status);
  Count("queued", sources.detectors.contacts().queued(), status);
  Count("queries", detector.queries, status);
  Count("queries_per_second", sources.queries_per_second, status);
  Count("pair_queries", detector.pair_queries, status);
  Count("filter_tests", detector.filter_tests, status);
  Count("method_changes", detector.method_changes, status);
  Count("segments", detector.segments, status);
  Count("work_units", detector.work_units, status);
  Count("pairs_waiting", sources.detectors.contacts().pairs_waiting(), status);
  Count("evaluations_cut_short", detector.evaluations_cut_short, status);
  Count("saturations", detector.saturations, status);
}

/// What the levels cost, and what their hysteresis held back. Nothing where there are none.
void AddLevels(const Detectors& detectors, v1::ServiceStatus* status) {
  if (detectors.levels().empty()) return;
  std::uint64_t pairs = 0, work = 0, withheld = 0, waiting = 0;
  for (const LevelDetector& level : detectors.levels()) {
    withheld += level.withheld();
    level.Each([&](const GrownDetector& one) {
      pairs += one.detector().pairs_tracked();
      waiting += one.detector().pairs_waiting();
      work += one.detector().counters().work_units;
    });
  }
  Count("levels_pairs_tracked", pairs, status);
  Count("levels_pairs_waiting", waiting, status);
  Count("levels_work_units", work, status);
  Count("levels_withheld", withheld, status);
}

/// What the screening of hypothetical agents costs. Nothing where there are none.
void AddScreening(const Detectors& detectors, v1::ServiceStatus* status) {
  if (detectors.screening() == nullptr) return;
  const detection::Detector& detector = detectors.screening()->detector();
  Count("hypothetical_agents", detectors.screening()->hypothetical(), status);
  Count("screening_pairs_tracked", detector.pairs_tracked(), status);
  Count("screening_pair_queries", detector.counters().pair_queries, status);
  Count("screening_work_units", detector.counters().work_units, status);
}

void AddExtension(const std::string& key, std::string value, v1::ServiceStatus* status) {
  v1::KeyValue& extension = *status->add_extensions();
  extension.set_key(key);
  extension.set_value(std::move(value));
}

void AddNames(const std::string& key, const std::vector<std::string>& names,
              v1::ServiceStatus* status) {
  if (!names.empty()) AddExtension(key, NamesText(names, wire::kExtensionValueMax), status);
}

/// Whom the world's time waits for: the names for programs, and for people why and how long.
void AddWaiting(const StatusSources& sources, v1::ServiceStatus* status) {
  std::vector<std::string> names, reasons;
  for (const Awaited& one : sources.world.Waited()) {
    names.push_back(one.name);
    reasons.push_back(WaitText(one, sources.world));
  }
  if (const std::size_t to_come = sources.world.SimulatorsToCome(); to_come > 0) {
    names.push_back(fmt::format("simulators to come: {}", to_come));
    reasons.push_back(names.back() + " before time begins (clock.simulators_awaited)");
  }
  for (const std::string& shape : sources.intake.AwaitedShapes()) {
    names.push_back(shape);
    reasons.push_back(shape + ": not there yet or still being built");
  }
  AddNames("waiting_for", names, status);
  AddNames("waiting_why", reasons, status);
}

/// What simulators have used up of their quotas, or nearly so.
void AddQuotas(const StatusSources& sources, v1::ServiceStatus* status) {
  constexpr double kNearlyUsedUp = 0.8;
  std::vector<std::string> texts;
  for (const auto& [id, simulator] : sources.world.simulators()) {
    for (const auto& [resource, used, most] : QuotasOf(sources, id)) {
      if (static_cast<double>(used) < kNearlyUsedUp * static_cast<double>(most)) continue;
      texts.push_back(fmt::format("{}: {} {} of {}", simulator.name(), Name(resource), used, most));
    }
  }
  AddNames("quotas", texts, status);
}

/// Simulators that an operator removed and that have not come back.
void AddEvicted(const World& world, v1::ServiceStatus* status) {
  std::vector<std::string> names;
  for (const auto& [id, simulator] : world.simulators()) {
    if (world.ended_runs().Find(id, simulator.run()) == EndCause::kEvicted) {
      names.push_back(simulator.name());
    }
  }
  AddNames("evicted", names, status);
}

}  // namespace

void AddText(const std::string& key, const std::string& text,
             std::vector<v1::KeyValue>* extensions) {
  if (text.empty()) return;
  v1::KeyValue& extension = extensions->emplace_back();
  extension.set_key(key);
  extension.set_value(text.substr(0, wire::kExtensionValueMax));
}

v1::ServiceStatus MakeStatus(const StatusSources& sources) {
  v1::ServiceStatus status;
  status.set_version(Version());
  status.set_world(sources.config.world().substr(0, wire::kNameMax));
  status.set_simulated_clock(sources.world.simulated());
  status.set_frame(sources.config.frame());
  status.set_epoch_utc(sources.config.epoch_utc());
  status.set_now_ns(sources.world.now().nanoseconds());
  status.set_granted_until_ns(sources.world.granted().nanoseconds());
  status.set_lease_ns(wire::kServiceLease);
  status.set_agents(static_cast<std::uint32_t>(sources.detectors.agents()));
  status.set_configuration(sources.configuration);
  status.set_pairs_tracked(
      static_cast<std::uint32_t>(sources.detectors.contacts().pairs_tracked()));
  AddSimulators(sources, &status);
  AddIntake(sources, &status);
  AddShapes(sources.shapes.counters(), &status);
  AddDetection(sources, &status);
  AddLevels(sources.detectors, &status);
  AddScreening(sources.detectors, &status);
  for (const v1::Counter& counter : sources.bus.network_counters())
    *status.add_counters() = counter;
  const detection::Detector::Profile profile = sources.detectors.contacts().profile();
  status.set_broad_phase(profile.broad_phase.substr(0, wire::kStatusBroadPhaseMax));
  status.set_broad_phase_why(profile.why.substr(0, wire::kStatusBroadPhaseWhyMax));
  for (const std::string& text : profile.left_out) {
    if (status.left_out_size() < wire::kStatusLeftOutMax)
      status.add_left_out(text.substr(0, wire::kStatusLeftOutTextMax));
  }
  const EventLog& log = sources.publisher.event_log();
  const EventLog& screening_log = sources.publisher.screening_log();
  AddExtension("event_log_count", std::to_string(log.count()), &status);
  AddExtension("event_log_hash", fmt::format("{:016x}", log.hash()), &status);
  if (screening_log.count() > 0) {
    AddExtension("screening_log_hash", fmt::format("{:016x}", screening_log.hash()), &status);
  }
  AddExtension("tree_builder",
               LowerCase(v1::Config::TreeBuilder_Name(sources.config.tree_builder())), &status);
  if (!sources.steps.last_clock_step.empty()) {
    AddExtension("clock_step", sources.steps.last_clock_step, &status);
  }
  AddWaiting(sources, &status);
  AddEvicted(sources.world, &status);
  AddQuotas(sources, &status);
  status.set_followers(static_cast<std::uint32_t>(sources.world.followers()));
  AddNames("flooding", sources.bus.flooding(), &status);
  AddNames("unfit", sources.intake.Unfit(), &status);
  for (const v1::KeyValue& extension : sources.extensions) *status.add_extensions() = extension;
  sources.measurements.AddTo(&status);
  return status;
}

std::string StepText(const ClockStep& step) {
  return fmt::format("by {:+.6f} s, to {:.6f} s, {}", 1e-9 * static_cast<double>(step.by_ns),
                     1e-9 * static_cast<double>(step.to.nanoseconds()),
                     step.breaks ? "by more than clock.skew_max_s: all promises are void"
                                 : "within clock.skew_max_s: promises hold");
}

std::uint64_t Rate::Take(std::uint64_t count, std::int64_t monotonic_ns) {
  const double seconds = 1e-9 * static_cast<double>(monotonic_ns - at_ns_);
  const double more = static_cast<double>(count - count_);
  const bool known = taken_ && seconds > 0;
  taken_ = true;
  count_ = count;
  at_ns_ = monotonic_ns;
  return known ? static_cast<std::uint64_t>(std::llround(more / seconds)) : 0;
}

bool StatusSchedule::Take(const World& world) {
  std::vector<std::uint64_t> presence;
  for (const auto& [id, simulator] : world.simulators()) {
    presence.insert(presence.end(), {id, simulator.run(), simulator.alive(), simulator.released()});
  }
  if (world.monotonic_ns() < next_ns_ && presence == presence_) return false;
  presence_ = std::move(presence);
  next_ns_ = world.monotonic_ns() + period_ns_;
  return true;
}

}  // namespace collision::server
