// What the protection of a secured world costs.
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>

#include "client/programs/tools/certificates/authority.h"
#include "tests/bench/harness/measure.h"
#include "tests/bench/service/cell.h"
#include "tests/bench/service/driver.h"
#include "tests/bench/service/process.h"

namespace collision::bench {
namespace {

constexpr std::uint32_t kAgents = 1000;
constexpr int kPairs = 7;
constexpr std::int64_t kDay = 86400;

/// Removed, with what is in it, at the end.
class Folder {
 public:
  Folder() : path_((std::filesystem::temp_directory_path() / "collision-bench-XXXXXX").string()) {
    if (mkdtemp(path_.data()) == nullptr) throw std::runtime_error(path_ + ": cannot be made");
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

Access AccessTo(const std::string& world, std::uint32_t domain, const std::string& protection,
                const Folder& folder) {
  const std::int64_t now = WallNs() / 1'000'000'000;
  const auto authority = client::Authority::Make(
      folder.path(), {world, domain, client::ProtectionOf(protection).value()}, now);
  const client::Period period{now - kDay, now + kDay};
  return {authority.Issue({DdsRole::kService, "service"}, period),
          authority.Issue({DdsRole::kSimulator, ServiceDriver::kSimulator}, period)};
}

/// Without a protection the world is not secured.
std::optional<Cell> MeasureWith(const ServiceSettings& settings,
                                const std::optional<std::string>& protection) {
  const std::string world = "bench-" + std::to_string(getpid()) + "-" + protection.value_or("open");
  if (!protection) return MeasureCell(settings, "ours", world, kAgents);
  const Folder folder;
  return MeasureCell(settings, "ours", world, kAgents,
                     AccessTo(world, settings.domain, *protection, folder));
}

struct Ratios {
  std::vector<double> latency, updates, cpu;
};

double CpuPerUpdate(const Cell& cell) {
  return cell.cpu / (kAgents * static_cast<double>(cell.rounds.size()));
}

void Add(const Cell& open, const Cell& secured, Ratios* ratios) {
  ratios->latency.push_back(Quantile(secured.latencies, 0.5) / Quantile(open.latencies, 0.5));
  ratios->updates.push_back(UpdatesPerSecond(secured, kAgents) / UpdatesPerSecond(open, kAgents));
  ratios->cpu.push_back(CpuPerUpdate(secured) / CpuPerUpdate(open));
}

void Tell(const std::string& protection, const Ratios& ratios, ServiceReport* report) {
  const double latency = Quantile(ratios.latency, 0.5), updates = Quantile(ratios.updates, 0.5),
               cpu = Quantile(ratios.cpu, 0.5);
  report->Add(
      {Padded("security/" + protection, 34) + Padded("p50 x " + Format("%.3g", latency), 16) +
           Padded("updates/s x " + Format("%.3g", updates), 22) + "CPU x " + Format("%.3g", cpu),
       {Text("part", "security"), Text("protection", protection),
        Number("pairs", static_cast<double>(ratios.latency.size())),
        Number("event_p50_ratio", latency), Number("updates_ratio", updates),
        Number("cpu_ratio", cpu)}});
  report->Figure("secured_event_p50_ratio_" + protection, latency);
  report->Figure("secured_updates_ratio_" + protection, updates);
}

}  // namespace

// Pairs of short cells, and the medians of their ratios: what disturbs the machine for longer meets
// both of a pair.
void SecurityPart(const ServiceSettings& settings, ServiceReport* report) {
  ServiceSettings of_a_cell = settings;
  of_a_cell.quick = true;
  for (const char* protection : kProtections) {
    if (!settings.Wants(std::string("security/") + protection)) continue;
    std::fprintf(stderr, "bench: %u agents, not secured and with %s\n", kAgents, protection);
    Ratios ratios;
    for (int pair = 0; pair < (settings.quick ? 1 : kPairs); ++pair) {
      const auto open = MeasureWith(of_a_cell, std::nullopt);
      const auto secured = MeasureWith(of_a_cell, protection);
      if (open && secured) Add(*open, *secured, &ratios);
    }
    if (ratios.latency.empty()) {
      report->Add({std::string("security/") + protection + ": no answer in time"});
    } else {
      Tell(protection, ratios, report);
    }
  }
}

}  // namespace collision::bench
