#include <algorithm>
#include <cstdarg>
#include <cstdio>

#include "client/programs/scene_runner/metrics.h"

namespace collision::client {
namespace {

[[gnu::format(printf, 2, 3)]] void Row(std::string* text, const char* format, ...) {
  char line[256];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  *text += line;
  *text += '\n';
}

void WidthRow(std::string* text, const char* what, const v1::Quantiles& widths) {
  if (widths.count() == 0) return Row(text, "  %-30s –", what);
  Row(text, "  %-30s p50 %.3g ms, p99 %.3g ms, max %.3g ms (%llu)", what, widths.p50() * 1e3,
      widths.p99() * 1e3, widths.max() * 1e3, static_cast<unsigned long long>(widths.count()));
}

void LengthRow(std::string* text, const char* what, const v1::Quantiles& lengths) {
  if (lengths.count() == 0) return Row(text, "  %-30s –", what);
  Row(text, "  %-30s p50 %.3g mm, p99 %.3g mm, max %.3g mm (%llu)", what, lengths.p50() * 1e3,
      lengths.p99() * 1e3, lengths.max() * 1e3, static_cast<unsigned long long>(lengths.count()));
}

double Percent(std::size_t part, std::size_t whole) {
  return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0;
}

unsigned long long CounterOf(const v1::RunReport& report, const char* name) {
  for (const v1::Counter& counter : report.counters()) {
    if (counter.name() == name) return counter.value();
  }
  return 0;
}

// The service's own counts.
void TreeRows(std::string* text, const v1::RunReport& report) {
  Row(text, "  %-30s %llu shapes, %llu spheres, %.3g MB, built in %.3g s", "sphere trees",
      CounterOf(report, "shapes"), CounterOf(report, "tree_nodes"),
      static_cast<double>(CounterOf(report, "tree_bytes")) * 1e-6,
      static_cast<double>(CounterOf(report, "tree_build_us")) * 1e-6);
  Row(text, "  %-30s %llu", "work units, in all", CounterOf(report, "work_units"));
}

void ShapeRows(std::string* text, const v1::RunReport& report, const checker::Evidence& evidence) {
  const auto& motions = evidence.motions();
  if (std::none_of(motions.begin(), motions.end(),
                   [](const checker::AgentMotion& motion) { return !motion.body().IsBall(); })) {
    return;
  }
  const ShapeFigures figures = FiguresOfShapes(evidence);
  Row(text, "  %-30s %.1f %% confirmed, %.1f %% undecided, %.1f %% dismissed (%zu)",
      "events about shapes", Percent(figures.confirmed, figures.decided()),
      Percent(figures.undecided, figures.decided()), Percent(figures.dismissed, figures.decided()),
      figures.decided());
  LengthRow(text, "separation bracket", report.separation_width_m());
  LengthRow(text, "contact point, error", report.point_error_m());
  const v1::Quantiles& normals = report.normal_error_rad();
  Row(text, "  %-30s p50 %.3g rad, p99 %.3g rad (%llu)", "normal, error", normals.p50(),
      normals.p99(), static_cast<unsigned long long>(normals.count()));
  const v1::Quantiles& work = report.work_units();
  Row(text, "  %-30s p50 %.0f, p99 %.0f, max %.0f (%llu)", "work units, of a closed event",
      work.p50(), work.p99(), work.max(), static_cast<unsigned long long>(work.count()));
  TreeRows(text, report);
}

void RatioRows(std::string* text, const v1::RunReport& report, bool lock_step) {
  if (report.contacts_true() == 0) {
    Row(text, "  %-30s –", "false alarms per contact");
    Row(text, "  %-30s –", "clear time / true time, median");
    Row(text, "  %-30s –", "contacts announced before");
  } else {
    Row(text, "  %-30s %.3g", "false alarms per contact", report.false_alarms_per_contact());
    Row(text, "  %-30s %.3f", "clear time / true time, median",
        report.clearance_tightness_median());
    Row(text, "  %-30s p50 %.3g s, of which clear %.5f in the median", "contacts announced before",
        report.announcement_lead_s().p50(), report.announcement_tightness_median());
  }
  if (report.latency_p99_s() > 0) {
    // In lock-step an update is judged when the others have told their part of the round.
    const char* until = lock_step ? ", the rest of the round included" : "";
    Row(text, "  %-30s p50 %.3g ms, p99 %.3g ms%s", "update to event", report.latency_p50_s() * 1e3,
        report.latency_p99_s() * 1e3, until);
  } else {
    Row(text, "  %-30s –", "update to event");
  }
}

void LevelRows(std::string* text, const checker::Evidence& evidence) {
  for (const checker::Evidence& level : evidence.levels()) {
    const auto& histories = level.histories();
    const auto told = std::count_if(histories.begin(), histories.end(),
                                    [](const auto& history) { return history.confirmed; });
    Row(text, "  %-30s %zu true crossings, %td told", ("level " + level.level()->name()).c_str(),
        level.contacts_certain(), told);
  }
}

void TrafficRows(std::string* text, const v1::RunReport& report) {
  const auto count = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
  if (report.states_sent() == 0) return;
  Row(text, "  %-30s %llu sent; a fixed stream sends %llu, %.1f times as many", "states",
      count(report.states_sent()), count(report.states_set()), report.message_ratio());
  Row(text, "  %-30s %llu of %.3g MB in all; the stream %llu of %.3g MB", "their samples",
      count(report.samples_sent()), static_cast<double>(report.sample_bytes()) * 1e-6,
      count(report.stream_samples()), static_cast<double>(report.stream_bytes()) * 1e-6);
}

}  // namespace

std::string SummaryTable(const v1::RunReport& report, const checker::Evidence& evidence) {
  const auto count = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
  std::string text;
  Row(&text, "\n%s", report.scene().c_str());
  Row(&text, "  %-30s %.1f s in %.1f s", "flown in real time", report.simulated_seconds(),
      report.wall_seconds());
  if (report.real_time_fraction() > 0) {
    Row(&text, "  %-30s %.3g of real time", "", report.real_time_fraction());
  }
  Row(&text, "  %-30s %u", "agents", report.agents());
  TrafficRows(&text, report);
  Row(&text, "  %-30s %llu, unannounced %llu", "true contacts", count(report.contacts_true()),
      count(report.contacts_unannounced()));
  Row(&text, "  %-30s %llu possible, %llu confirmed, %llu ended", "events",
      count(report.events_possible()), count(report.events_confirmed()),
      count(report.events_ended()));
  Row(&text, "  %-30s %llu dismissed, %llu undecided, %llu withdrawn", "",
      count(report.events_dismissed()), count(report.events_undecided()),
      count(report.events_withdrawn()));
  LevelRows(&text, evidence);
  RatioRows(&text, report, evidence.facts().transit_ns == 0);
  WidthRow(&text, "begin bracket at confirmation", report.begin_width_s());
  WidthRow(&text, "begin bracket, final", QuantilesOf(BeginWidthsFinal(evidence)));
  WidthRow(&text, "end bracket, final", report.end_width_s());
  ShapeRows(&text, report, evidence);
  Row(&text, "  %-30s %.3g s", "CPU per simulated second",
      report.cpu_seconds_per_simulated_second());
  return text;
}

}  // namespace collision::client
