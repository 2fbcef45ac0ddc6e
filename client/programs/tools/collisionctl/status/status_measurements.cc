#include "client/programs/tools/collisionctl/status/status_measurements.h"

#include <cstdint>
#include <ctime>
#include <numeric>

#include "client/programs/tools/collisionctl/pages/text_pages.h"
#include "client/programs/tools/collisionctl/status/status_fields.h"
#include "idl/histogram.h"

namespace collision::client {
namespace {

/// Source: ISO 8601.
std::string UtcText(std::int64_t ns) {
  const std::time_t seconds = ns / 1'000'000'000;
  std::tm utc{};
  char text[32];
  if (gmtime_r(&seconds, &utc) == nullptr) return std::to_string(seconds);
  return {text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc)};
}

std::string UsageText(const v1::ServiceStatus& status) {
  const double up_s = 1e-9 * static_cast<double>(status.uptime_ns());
  const double cpu_s = 1e-6 * static_cast<double>(status.cpu_us());
  std::string text = NumberText(cpu_s, "%.1f s of CPU");
  if (up_s > 0) text += NumberText(100 * cpu_s / up_s, " (%.1f %% of one core)");
  return text + NumberText(1e-6 * static_cast<double>(status.memory_bytes()), ", %.1f MB");
}

/// "1234: half up to 20, 99 % up to 200, all up to 5000 us".
std::string HistogramText(const v1::Histogram& histogram) {
  const auto& counts = histogram.counts();
  const std::uint64_t all = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  if (all == 0) return "none so far";
  const auto up_to = [&](double share) {
    return " up to " + std::to_string(wire::QuantileAtMost(counts, share));
  };
  const std::string& name = histogram.name();
  const std::string unit = name.substr(name.rfind('_') + 1);
  return std::to_string(all) + ": half" + up_to(0.5) + ", 99 %" + up_to(0.99) + ", all" + up_to(1) +
         " " + unit;
}

/// As short as labels are; a histogram that is not known here keeps its name.
std::string LabelOf(const v1::Histogram& histogram) {
  if (histogram.name() == "step_us") return "steps";
  if (histogram.name() == "update_to_contact_us") return "to contact";
  if (histogram.name() == "contact_bracket_ns") return "brackets";
  return histogram.name() + "  ";
}

}  // namespace

std::string DurationText(std::int64_t ns) {
  constexpr struct {
    const char* name;
    std::int64_t seconds;
  } kUnits[] = {{"d", 86400}, {"h", 3600}, {"min", 60}, {"s", 1}};
  std::int64_t rest = ns / 1'000'000'000;
  std::string text;
  int units = 0;
  for (const auto& [name, seconds] : kUnits) {
    const std::int64_t count = rest / seconds;
    rest -= count * seconds;
    if (count > 0 && units < 2)
      text += (text.empty() ? "" : " ") + std::to_string(count) + " " + name;
    if (!text.empty()) ++units;
  }
  return text.empty() ? "0 s" : text;
}

std::string MeasurementLines(const v1::ServiceStatus& status) {
  std::string lines;
  if (!status.build().empty()) {
    lines += Line("build", status.build());
    lines +=
        Line("up", DurationText(status.uptime_ns()) + ", since " + UtcText(status.started_ns()));
    lines += Line("used", UsageText(status));
  }
  for (const v1::Histogram& histogram : status.histograms())
    lines += Line(LabelOf(histogram), HistogramText(histogram));
  return lines;
}

}  // namespace collision::client
