#include "server/publish/reports.h"

#include <algorithm>

#include "idl/limits.h"

namespace collision::server {
namespace {

v1::StandingRefusal Encode(const Refusal& refusal) {
  v1::StandingRefusal wire;
  wire.set_reason(refusal.reason);
  wire.set_topic(refusal.topic);
  wire.set_slot(refusal.slot);
  wire.set_generation(refusal.generation);
  wire.set_field(refusal.field);
  wire.set_detail(refusal.detail);
  return wire;
}

v1::RunEnd EndOf(const World& world, const Simulator& simulator) {
  const auto cause = world.ended_runs().Find(simulator.id(), simulator.run());
  if (!cause) return v1::RUN_GOES_ON;
  switch (*cause) {
    case EndCause::kSilent:
      return v1::RUN_SILENT;
    case EndCause::kEvicted:
      return v1::RUN_EVICTED;
    case EndCause::kRestarted:
      return v1::RUN_RESTARTED;
    case EndCause::kRefused:
      return v1::RUN_REFUSED;
  }
  return v1::RUN_GOES_ON;
}

v1::SimulatorReport ReportOf(const Simulator& simulator, v1::RunEnd ended, Instant now) {
  v1::SimulatorReport report;
  report.set_simulator_id(simulator.id());
  report.set_now_ns(now.nanoseconds());
  report.set_run(simulator.run());
  report.set_incarnation(simulator.incarnation());
  report.set_name(simulator.name());
  report.set_alive(simulator.alive());
  report.set_ended(ended);
  report.set_descriptions_sequence(simulator.time().descriptions_arrived());
  report.set_states_sequence(simulator.time().states_seen());
  report.set_agents(static_cast<std::uint32_t>(simulator.agents().size()));
  report.set_agents_stated(static_cast<std::uint32_t>(simulator.agents().stated()));
  report.set_refused(simulator.refusals().count());
  for (const auto& [key, refusal] : simulator.refusals().listed()) {
    if (report.refusals_size() == wire::kReportRefusalsMax) break;
    *report.add_refusals() = Encode(refusal);
  }
  return report;
}

}  // namespace

Reports::Content Reports::ContentOf(const Simulator& simulator, v1::RunEnd ended) {
  return {simulator.run(),
          simulator.incarnation(),
          simulator.alive(),
          ended,
          simulator.time().descriptions_arrived(),
          simulator.time().states_seen(),
          simulator.agents().size(),
          simulator.agents().stated(),
          simulator.refusals().revision()};
}

std::vector<v1::SimulatorReport> Reports::TakeDue(const World& world) {
  std::vector<v1::SimulatorReport> due;
  next_ns_.reset();
  std::erase_if(told_,
                [&world](const auto& told) { return !world.simulators().contains(told.first); });
  for (const auto& [id, simulator] : world.simulators()) {
    const v1::RunEnd ended = EndOf(world, simulator);
    const Content content = ContentOf(simulator, ended);
    const auto [told, first] = told_.try_emplace(id);
    if (!first) {
      if (told->second.content == content) continue;
      const std::int64_t next_ns = told->second.at_ns + kReportPeriodNs;
      if (world.monotonic_ns() < next_ns) {
        next_ns_ = std::min(next_ns_.value_or(next_ns), next_ns);
        continue;
      }
    }
    told->second = {content, world.monotonic_ns()};
    due.push_back(ReportOf(simulator, ended, world.now()));
  }
  return due;
}

}  // namespace collision::server
