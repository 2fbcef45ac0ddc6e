#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "tests/bench/harness/measure.h"
#include "tests/bench/service/crowd.h"
#include "tests/bench/service/driver.h"
#include "tests/bench/service/parts.h"
#include "tests/bench/service/process.h"

namespace collision::bench {
namespace {

constexpr std::uint32_t kBeside = 100;
constexpr double kJoinSeconds = 20;
constexpr double kAnswerSeconds = 5;
constexpr double kCrowdMeetsSeconds = 5;
constexpr double kSettleSeconds = 2.5;
constexpr int kLaps = 15;  // of 50 events: p99 is the eighth of the slowest

struct Latency {
  double p50 = 0, p99 = 0;
  std::size_t events = 0;
};

std::optional<Latency> Measure(const ServiceSettings& settings, bool crowded) {
  const std::string world = "bench-" + std::to_string(WallNs() % 1'000'000'000);
  ServiceProcess service("ours", world, settings.domain);
  ServiceDriver driver(world, settings.domain, kBeside);
  if (!driver.Join(kJoinSeconds)) return std::nullopt;
  std::optional<ServiceProcess> crowd;
  if (crowded) crowd.emplace(kCrowd, world, settings.domain);
  driver.Idle(kCrowdMeetsSeconds);
  std::vector<double> seconds;
  const double cpu = service.CpuSeconds();
  const Stopwatch watch;
  for (int lap = 0; lap < (settings.quick ? 1 : kLaps); ++lap) {
    for (std::uint32_t pair = 0; pair < driver.pairs(); ++pair) {
      if (const auto event = driver.JumpToEvent(pair, kAnswerSeconds)) seconds.push_back(*event);
      driver.Idle(0.001 * (1 + pair % 17));  // at any time within a step
    }
    driver.Idle(kSettleSeconds);
  }
  if (seconds.empty()) return std::nullopt;
  std::fprintf(stderr, "bench: %s: processor %.0f %%\n", crowded ? "crowded" : "alone",
               100 * (service.CpuSeconds() - cpu) / watch.seconds());
  return Latency{Quantile(seconds, 0.5), Quantile(seconds, 0.99), seconds.size()};
}

void Tell(const char* name, const Latency& latency, ServiceReport* report) {
  report->Add({Padded("crowd/" + std::string(name), 26) +
                   Padded("p50 " + SecondsText(latency.p50), 15) +
                   Padded("p99 " + SecondsText(latency.p99), 15) + std::to_string(latency.events) +
                   " events",
               {Text("part", "crowd"), Text("beside", name), Number("event_p50_s", latency.p50),
                Number("event_p99_s", latency.p99),
                Number("events", static_cast<double>(latency.events))}});
}

}  // namespace

void CrowdPart(const ServiceSettings& settings, ServiceReport* report) {
  if (!settings.Wants("crowd")) return;
  std::fprintf(stderr, "bench: a crowd of %u meshes\n", kCrowdAgents);
  const auto alone = Measure(settings, false), beside = Measure(settings, true);
  if (!alone || !beside) return report->Add({"crowd: no answer in time"});
  Tell("alone", *alone, report);
  Tell("beside", *beside, report);
  report->Figure("crowd_event_p50_ratio", beside->p50 / alone->p50);
  report->Figure("crowd_event_p99_ratio", beside->p99 / alone->p99);
}

}  // namespace collision::bench
