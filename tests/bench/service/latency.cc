// Update to event, and updates per second.
#include <unistd.h>

#include <cstdio>
#include <stdexcept>

#include "tests/bench/harness/measure.h"
#include "tests/bench/service/cell.h"
#include "tests/bench/service/driver.h"
#include "tests/bench/service/parts.h"

namespace collision::bench {
namespace {

constexpr double kJoinSeconds = 20;
constexpr double kAnswerSeconds = 2;
/// Until all is over between a pair that met, so that its next meeting is news: the service waits
/// announce_within_s (2 s) for states that may tell more of the last one.
constexpr double kSettleSeconds = 2.5;

/// The cell's share of the whole time [s].
double Budget(const ServiceSettings& settings) { return settings.quick ? 0.7 : 15; }

}  // namespace

std::optional<Cell> MeasureCell(const ServiceSettings& settings, const std::string& contestant,
                                const std::string& world, std::uint32_t agents,
                                const CellFolders& folders) {
  ServiceProcess service(contestant, world, settings.domain, folders.service);
  ServiceDriver driver(world, settings.domain, agents, folders.simulator_credentials);
  if (!driver.Join(kJoinSeconds)) return std::nullopt;
  Cell cell;
  const Stopwatch latency;
  double lap = 0;  // when the first pair jumped last
  for (std::uint32_t i = 0; latency.seconds() < Budget(settings); ++i) {
    if (i > 0 && i % driver.pairs() == 0) {
      const double next = lap + kSettleSeconds;
      if (next > Budget(settings)) break;
      driver.Idle(next - latency.seconds());
      lap = latency.seconds();
    }
    const auto seconds = driver.JumpToEvent(i % driver.pairs(), kAnswerSeconds);
    seconds ? cell.latencies.push_back(*seconds) : void(++cell.lost);
  }
  const double cpu = service.CpuSeconds();
  const Stopwatch throughput;
  while (throughput.seconds() < Budget(settings)) {
    const auto seconds = driver.Round(kJoinSeconds);
    if (!seconds) break;
    cell.rounds.push_back(*seconds);
  }
  cell.cpu = service.CpuSeconds() - cpu;
  if (cell.latencies.empty() || cell.rounds.empty()) return std::nullopt;
  return cell;
}

namespace {

double Sum(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum;
}

}  // namespace

double UpdatesPerSecond(const Cell& cell, std::uint32_t agents) {
  return agents * static_cast<double>(cell.rounds.size()) / Sum(cell.rounds);
}

namespace {

std::optional<Cell> Measure(const ServiceSettings& settings, const std::string& contestant,
                            std::uint32_t agents) {
  const std::string world = "bench-" + std::to_string(getpid()) + "-" + contestant;
  return MeasureCell(settings, contestant, world, agents);
}

/// Whatever takes more of the time.
std::string LimitOf(double ours, double network) {
  return network >= ours / 2 ? "network and driver" : "service";
}

void Tell(std::uint32_t agents, const std::string& contestant, const Cell& cell,
          const std::string& limit, ServiceReport* report) {
  const double p50 = Quantile(cell.latencies, 0.5), p99 = Quantile(cell.latencies, 0.99);
  const double updates = UpdatesPerSecond(cell, agents);
  report->Add(
      {Padded("latency/" + std::to_string(agents) + "/" + contestant, 26) +
           Padded("p50 " + SecondsText(p50), 15) + Padded("p99 " + SecondsText(p99), 15) +
           Padded(Format("%.3g", updates) + " updates/s", 22) + "limited by " + limit,
       {Text("part", "latency"), Text("contestant", contestant), Number("agents", agents),
        Number("events", static_cast<double>(cell.latencies.size())),
        Number("events_lost", cell.lost), Number("event_p50_s", p50), Number("event_p99_s", p99),
        Number("rounds", static_cast<double>(cell.rounds.size())),
        Number("round_p50_s", Quantile(cell.rounds, 0.5)),
        Number("round_p99_s", Quantile(cell.rounds, 0.99)), Number("updates_per_s", updates),
        Number("service_cpu_share", cell.cpu / Sum(cell.rounds)), Text("limited_by", limit)}});
}

void Compare(const ServiceSettings& settings, std::uint32_t agents, ServiceReport* report) {
  std::fprintf(stderr, "bench: %u agents, network and ours\n", agents);
  const auto network = Measure(settings, "network", agents);
  const auto ours = Measure(settings, "ours", agents);
  const std::string name = "_" + std::to_string(agents);
  if (!network || !ours) {
    report->Add({"latency/" + std::to_string(agents) + ": no answer in time"});
    return;
  }
  const double p50 = Quantile(ours->latencies, 0.5),
               p50_network = Quantile(network->latencies, 0.5);
  const double updates = UpdatesPerSecond(*ours, agents),
               updates_network = UpdatesPerSecond(*network, agents);
  Tell(agents, "network", *network, "network and driver", report);
  Tell(agents, "ours", *ours, LimitOf(1 / updates, 1 / updates_network), report);
  report->Figure("service_event_p50_s" + name, p50);
  report->Figure("service_event_p99_s" + name, Quantile(ours->latencies, 0.99));
  report->Figure("network_event_p50_s" + name, p50_network);
  report->Figure("network_event_p99_s" + name, Quantile(network->latencies, 0.99));
  report->Figure("service_event_p50_ratio" + name, p50 / p50_network);
  report->Figure("service_updates_per_s" + name, updates);
  report->Figure("network_updates_per_s" + name, updates_network);
  report->Figure("service_updates_ratio" + name, updates / updates_network);
}

}  // namespace

void LatencyPart(const ServiceSettings& settings, ServiceReport* report) {
  for (const std::uint32_t agents : {100u, 1000u, 10000u}) {
    if (settings.Wants("latency/" + std::to_string(agents))) Compare(settings, agents, report);
  }
}

}  // namespace collision::bench
