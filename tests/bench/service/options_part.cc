// What is paid for the protection of a secured world, and for the flight recorder.
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

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

CellFolders SecuredBy(const std::string& protection, const std::string& world, std::uint32_t domain,
                      const Folder& folder) {
  const std::int64_t now = WallNs() / 1'000'000'000;
  const auto authority = client::Authority::Make(
      folder.path(), {world, domain, client::ProtectionOf(protection).value()}, now);
  const client::Period period{now - kDay, now + kDay};
  return {{.credentials = authority.Issue({DdsRole::kService, "service"}, period)},
          authority.Issue({DdsRole::kSimulator, ServiceDriver::kSimulator}, period)};
}

constexpr char kRecorder[] = "recorder";

/// `option`: a protection, or kRecorder; null: the service without.
std::optional<Cell> MeasureWith(const ServiceSettings& settings, const char* option) {
  const std::string world =
      "bench-" + std::to_string(getpid()) + "-" + (option == nullptr ? "plain" : option);
  if (option == nullptr) return MeasureCell(settings, "ours", world, kAgents);
  const Folder folder;
  return MeasureCell(settings, "ours", world, kAgents,
                     option == std::string(kRecorder)
                         ? CellFolders{.service = {.state = folder.path()}}
                         : SecuredBy(option, world, settings.domain, folder));
}

struct Ratios {
  std::vector<double> latency, updates, cpu;
};

double CpuPerUpdate(const Cell& cell) {
  return cell.cpu / (kAgents * static_cast<double>(cell.rounds.size()));
}

void Add(const Cell& without, const Cell& with, Ratios* ratios) {
  ratios->latency.push_back(Quantile(with.latencies, 0.5) / Quantile(without.latencies, 0.5));
  ratios->updates.push_back(UpdatesPerSecond(with, kAgents) / UpdatesPerSecond(without, kAgents));
  ratios->cpu.push_back(CpuPerUpdate(with) / CpuPerUpdate(without));
}

/// How an option is named on the command line, and the figures of it.
struct OptionNames {
  std::string cell;            ///< "security/sign"
  std::string figures, after;  ///< "secured_", "_sign"
};

OptionNames NamesOf(const std::string& option) {
  if (option == kRecorder) return {"recorder/on", "recorder_", ""};
  return {"security/" + option, "secured_", "_" + option};
}

void Tell(const std::string& option, const Ratios& ratios, ServiceReport* report) {
  const double latency = Quantile(ratios.latency, 0.5), updates = Quantile(ratios.updates, 0.5),
               cpu = Quantile(ratios.cpu, 0.5);
  const OptionNames names = NamesOf(option);
  report->Add({Padded(names.cell, 34) + Padded("p50 x " + Format("%.3g", latency), 16) +
                   Padded("updates/s x " + Format("%.3g", updates), 22) + "CPU x " +
                   Format("%.3g", cpu),
               {Text("part", "options"), Text("option", option),
                Number("pairs", static_cast<double>(ratios.latency.size())),
                Number("event_p50_ratio", latency), Number("updates_ratio", updates),
                Number("cpu_ratio", cpu)}});
  report->Figure(names.figures + "event_p50_ratio" + names.after, latency);
  report->Figure(names.figures + "updates_ratio" + names.after, updates);
}

}  // namespace

// Pairs of short cells, and the medians of their ratios: what disturbs the machine for longer meets
// both of a pair.
void OptionsPart(const ServiceSettings& settings, ServiceReport* report) {
  ServiceSettings of_a_cell = settings;
  of_a_cell.quick = true;
  std::vector<const char*> options(std::begin(kProtections), std::end(kProtections));
  options.push_back(kRecorder);
  for (const char* option : options) {
    const std::string cell = NamesOf(option).cell;
    if (!settings.Wants(cell)) continue;
    std::fprintf(stderr, "bench: %u agents, without and with %s\n", kAgents, cell.c_str());
    Ratios ratios;
    for (int pair = 0; pair < (settings.quick ? 1 : kPairs); ++pair) {
      const auto without = MeasureWith(of_a_cell, nullptr);
      const auto with = MeasureWith(of_a_cell, option);
      if (without && with) Add(*without, *with, &ratios);
    }
    if (ratios.latency.empty()) {
      report->Add({cell + ": no answer in time"});
    } else {
      Tell(option, ratios, report);
    }
  }
}

}  // namespace collision::bench
