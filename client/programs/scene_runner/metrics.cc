#include "client/programs/scene_runner/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace collision::client {
namespace {

double Width(const v1::TimeBracket& bracket) {
  return (static_cast<double>(bracket.latest_ns()) - static_cast<double>(bracket.earliest_ns())) *
         1e-9;
}

bool IsOpen(const v1::TimeBracket& bracket) {
  return bracket.latest_ns() == std::numeric_limits<std::int64_t>::max();
}

// Counts the contacts that ever had, or ended with, a status.
void CountEvents(const checker::Evidence& evidence, v1::RunReport* report) {
  for (const checker::EventHistory& history : evidence.histories()) {
    const auto possible =
        std::any_of(history.revisions.begin(), history.revisions.end(),
                    [](const auto& e) { return e.status() == v1::EVENT_POSSIBLE; });
    const v1::EventStatus last = history.last().status();
    report->set_events_possible(report->events_possible() + possible);
    report->set_events_confirmed(report->events_confirmed() + history.confirmed.has_value());
    report->set_events_dismissed(report->events_dismissed() + (last == v1::EVENT_DISMISSED));
    report->set_events_undecided(report->events_undecided() + (last == v1::EVENT_UNDECIDED));
    report->set_events_withdrawn(report->events_withdrawn() + (last == v1::EVENT_WITHDRAWN));
    report->set_events_ended(report->events_ended() + (last == v1::EVENT_ENDED));
  }
}

}  // namespace

double Quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto rank =
      static_cast<std::ptrdiff_t>(std::floor(share * static_cast<double>(values.size() - 1) + 0.5));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[rank];
}

v1::Quantiles QuantilesOf(const std::vector<double>& values) {
  v1::Quantiles quantiles;
  quantiles.set_p50(Quantile(values, 0.5));
  quantiles.set_p99(Quantile(values, 0.99));
  quantiles.set_max(Quantile(values, 1));
  quantiles.set_count(values.size());
  return quantiles;
}

std::vector<double> BeginWidthsAtConfirmation(const checker::Evidence& evidence) {
  std::vector<double> widths;
  for (const checker::EventHistory& history : evidence.histories()) {
    for (const v1::CollisionEvent& event : history.revisions) {
      if (event.status() != v1::EVENT_CONFIRMED && event.status() != v1::EVENT_ENDED) continue;
      widths.push_back(Width(event.begin()));
      break;
    }
  }
  return widths;
}

std::vector<double> BeginWidthsFinal(const checker::Evidence& evidence) {
  std::vector<double> widths;
  for (const checker::EventHistory& history : evidence.histories()) {
    if (history.confirmed && !IsOpen(history.last().begin())) {
      widths.push_back(Width(history.last().begin()));
    }
  }
  return widths;
}

std::vector<double> EndWidthsFinal(const checker::Evidence& evidence) {
  std::vector<double> widths;
  for (const checker::EventHistory& history : evidence.histories()) {
    if (history.last().status() == v1::EVENT_ENDED && !IsOpen(history.last().end())) {
      widths.push_back(Width(history.last().end()));
    }
  }
  return widths;
}

namespace {

void AddFinite(double value, std::vector<double>* values) {
  if (std::isfinite(value)) values->push_back(value);
}

// Adds what an event claims about the bodies at one instant.
void AddClaim(const v1::CollisionEvent& event, ShapeFigures* figures) {
  if (!event.has_proximity()) return;
  const v1::PairProximity& proximity = event.proximity();
  AddFinite(proximity.separation_m().upper() - proximity.separation_m().lower(),
            &figures->separation_widths_m);
  AddFinite(proximity.point_error_m(), &figures->point_errors_m);
  if (proximity.has_normal()) {
    AddFinite(proximity.normal().error_rad(), &figures->normal_errors_rad);
  }
}

bool HasClaim(const v1::CollisionEvent& event) {
  return event.status() == v1::EVENT_CONFIRMED || event.status() == v1::EVENT_ENDED ||
         event.status() == v1::EVENT_UNDECIDED;
}

void FillShapes(const checker::Evidence& evidence, v1::RunReport* report) {
  const ShapeFigures figures = FiguresOfShapes(evidence);
  *report->mutable_separation_width_m() = QuantilesOf(figures.separation_widths_m);
  *report->mutable_point_error_m() = QuantilesOf(figures.point_errors_m);
  *report->mutable_normal_error_rad() = QuantilesOf(figures.normal_errors_rad);
  *report->mutable_work_units() = QuantilesOf(figures.work_units);
  *report->mutable_counters() = evidence.observations().status.counters();
}

void FillAnnouncements(const checker::Evidence& evidence, v1::RunReport* report) {
  std::vector<double> leads, tightness;
  for (const checker::Announcement& announcement : checker::Announcements(evidence)) {
    leads.push_back(announcement.lead_s);
    tightness.push_back(announcement.tightness);
  }
  *report->mutable_announcement_lead_s() = QuantilesOf(leads);
  report->set_announcement_tightness_median(Quantile(tightness, 0.5));
}

// In each step, a stream at the simulators' rate sends complete chunks of 64 for all agents.
void AddStream(const v1::SimulatorTraffic& traffic, std::uint64_t agents, v1::RunReport* report) {
  constexpr std::uint64_t kChunk = 64, kSampleBytes = 20, kStateBytes = 200;  // idl/PROTOCOL.md
  if (agents == 0) return;
  const std::uint64_t steps = (traffic.states_set() + agents - 1) / agents;
  const std::uint64_t samples = steps * ((agents + kChunk - 1) / kChunk);
  report->set_stream_samples(report->stream_samples() + samples);
  report->set_stream_bytes(report->stream_bytes() + samples * kSampleBytes +
                           traffic.states_set() * kStateBytes);
}

void FillTraffic(const checker::Evidence& evidence, const Measured& measured,
                 v1::RunReport* report) {
  std::map<std::string, std::uint64_t> agents;
  for (const checker::AgentMotion& motion : evidence.motions()) ++agents[motion.simulator];
  for (const v1::SimulatorTraffic& traffic : measured.traffic) {
    *report->add_traffic() = traffic;
    report->set_states_set(report->states_set() + traffic.states_set());
    report->set_states_sent(report->states_sent() + traffic.states_sent());
    report->set_samples_sent(report->samples_sent() + traffic.samples_sent());
    report->set_sample_bytes(report->sample_bytes() + traffic.bytes_sent());
    AddStream(traffic, agents[traffic.simulator()], report);
  }
  if (report->states_sent() > 0) {
    report->set_message_ratio(static_cast<double>(report->states_set()) /
                              static_cast<double>(report->states_sent()));
  }
  if (measured.running_seconds > 0) {
    report->set_real_time_fraction(measured.simulated_seconds / measured.running_seconds);
  }
}

}  // namespace

ShapeFigures FiguresOfShapes(const checker::Evidence& evidence) {
  ShapeFigures figures;
  for (const checker::EventHistory& history : evidence.histories()) {
    if (!evidence.HasShape(history.a, history.b)) continue;
    const auto first = std::find_if(history.revisions.begin(), history.revisions.end(), HasClaim);
    if (first != history.revisions.end()) AddClaim(*first, &figures);
    const v1::EventStatus last = history.last().status();
    figures.confirmed += history.confirmed.has_value();
    figures.undecided += last == v1::EVENT_UNDECIDED;
    figures.dismissed += last == v1::EVENT_DISMISSED;
    if (history.closed && last != v1::EVENT_WITHDRAWN)
      figures.work_units.push_back(static_cast<double>(history.last().work_units()));
  }
  return figures;
}

v1::RunReport MakeReport(const std::string& scene, const checker::Evidence& evidence,
                         const checker::Violations& violations, const Measured& measured) {
  v1::RunReport report;
  report.set_scene(scene);
  report.set_simulated_seconds(measured.simulated_seconds);
  report.set_wall_seconds(measured.wall_seconds);
  report.set_agents(static_cast<std::uint32_t>(evidence.motions().size()));
  CountEvents(evidence, &report);
  report.set_contacts_true(evidence.contacts_certain());
  report.set_contacts_unannounced(checker::ContactsUnannounced(evidence));
  const auto contacts = static_cast<double>(std::max<std::uint64_t>(1, report.contacts_true()));
  report.set_false_alarms_per_contact(static_cast<double>(report.events_dismissed()) / contacts);
  report.set_clearance_tightness_median(Quantile(checker::ClearanceTightness(evidence), 0.5));
  FillAnnouncements(evidence, &report);
  report.set_latency_p50_s(Quantile(measured.latencies, 0.5));
  report.set_latency_p99_s(Quantile(measured.latencies, 0.99));
  *report.mutable_begin_width_s() = QuantilesOf(BeginWidthsAtConfirmation(evidence));
  *report.mutable_end_width_s() = QuantilesOf(EndWidthsFinal(evidence));
  FillShapes(evidence, &report);
  FillTraffic(evidence, measured, &report);
  if (measured.simulated_seconds > 0) {
    report.set_cpu_seconds_per_simulated_second(measured.service_cpu_seconds /
                                                measured.simulated_seconds);
  }
  for (const std::string& violation : violations) report.add_violations()->set_what(violation);
  const checker::Observations& seen = evidence.observations();
  report.mutable_events()->Assign(seen.events.begin(), seen.events.end());
  report.mutable_names()->Assign(seen.names.begin(), seen.names.end());
  return report;
}

}  // namespace collision::client
