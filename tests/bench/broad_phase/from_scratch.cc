// Earliest of all from scratch: every bound is new, and nothing is known before.
#include <algorithm>
#include <cmath>
#include <map>

#include "tests/baselines/scenes.h"
#include "tests/bench/broad_phase/methods.h"
#include "tests/bench/broad_phase/parts.h"
#include "tests/bench/harness/measure.h"

namespace collision::bench {
namespace {

/// From here on a repetition takes seconds.
constexpr std::size_t kManyAgents = 500'000;

constexpr std::size_t kRepetitionsMin = 3, kRepetitionsMax = 51;

std::vector<double> Repeat(const Settings& settings, const baselines::BallScene& scene,
                           const Entrant& entrant) {
  KeepMemory();
  const auto contestant = entrant.make();
  // The first run finds its memory; it counts only if it is slow enough for that not to matter.
  Timed timed = contestant->Ask(scene, baselines::kHorizon);
  std::vector<double> totals, fills;
  const Stopwatch watch;
  while (totals.size() < kRepetitionsMin ||
         (totals.size() < kRepetitionsMax && watch.seconds() < settings.patience())) {
    timed = contestant->Ask(scene, baselines::kHorizon);
    totals.push_back(timed.total()), fills.push_back(timed.fill);
    if (timed.total() > settings.patience()) break;
  }
  const Answer& answer = timed.answer;
  return {Median(totals),
          Quantile(totals, 0),
          Median(fills),
          static_cast<double>(totals.size()),
          static_cast<double>(answer.found),
          static_cast<double>(answer.lower),
          static_cast<double>(answer.higher),
          static_cast<double>(answer.time_ns)};
}

}  // namespace

bool WantsAny(const Settings& settings, const std::string& part, const std::string& scene,
              std::size_t agents) {
  Row row;
  row.part = part, row.scene = scene, row.agents = agents;
  for (const Entrant& entrant : Entrants()) {
    row.contestant = entrant.name;
    if (settings.Wants(row.path())) return true;
  }
  return false;
}

Row MeasureFromScratch(const Settings& settings, const NamedScene& named, const Entrant& entrant,
                       Report* report) {
  const std::string &part = named.part, &name = named.name;
  const baselines::BallScene& scene = named.balls;
  Row row;
  row.part = part, row.scene = name, row.agents = scene.size(), row.contestant = entrant.name;
  row.cut_off = settings.cut_off();
  if (!settings.Wants(row.path())) return row;
  // What was too slow with fewer agents is not tried again: no method's time grows less than their
  // number. Nor are windows that did not help.
  static std::map<std::string, std::pair<std::size_t, double>> least;
  const std::string cell = part + "/" + name + "/";
  auto& [agents_before, seconds_before] = least[cell + entrant.name];
  const double growth =
      agents_before == 0 ? 0 : static_cast<double>(row.agents) / static_cast<double>(agents_before);
  const bool too_slow = growth >= 1 && seconds_before * growth > row.cut_off;
  const bool no_help = growth >= 1 && row.agents >= kManyAgents && !entrant.instead_of.empty() &&
                       seconds_before > least[cell + entrant.instead_of].second;
  if (too_slow || no_help) {
    row.remark =
        too_slow ? "not tried: too slow with fewer agents" : "not tried: no help with fewer agents";
    row.cut_off = std::min(row.cut_off, seconds_before * growth);
    report->Add(row);
    return row;
  }
  const ApartResult result =
      RunApart(settings.cut_off(), [&] { return Repeat(settings, scene, entrant); });
  row.failed = result.status == ApartStatus::kFailed;
  if (result.status == ApartStatus::kCutOff) {
    agents_before = row.agents, seconds_before = row.cut_off;
  }
  if (result.status == ApartStatus::kDone) {
    const auto& v = result.values;
    row.seconds = v[0];
    agents_before = row.agents, seconds_before = v[0];
    row.answer = Answer{v[4] != 0, static_cast<std::uint32_t>(v[5]),
                        static_cast<std::uint32_t>(v[6]), static_cast<std::int64_t>(v[7])};
    row.more = {Number("least_s", v[1]), Number("fill_s", v[2]), Number("repetitions", v[3])};
  }
  report->Add(row);
  return row;
}

std::vector<Row> MeasureAll(const Settings& settings, const NamedScene& scene, Report* report) {
  std::vector<Row> rows;
  std::optional<Answer> reference;
  for (const Entrant& entrant : Entrants()) {
    Row row = MeasureFromScratch(settings, scene, entrant, report);
    if (row.answer && !reference) reference = row.answer;
    const bool same =
        !row.answer || (entrant.ours ? *row.answer == *reference : Agree(*row.answer, *reference));
    if (!same) report->Mark("ANSWERS DIFFER");
    rows.push_back(std::move(row));
  }
  return rows;
}

std::optional<double> PeerOverOurs(const std::vector<Row>& rows) {
  std::optional<double> ours, peer;
  for (const Row& row : rows) {
    if (!row.seconds) continue;
    if (row.contestant == OurChoice().name) ours = row.seconds;
    if (!IsOurs(row.contestant)) peer = std::min(peer.value_or(*row.seconds), *row.seconds);
  }
  if (!ours || !peer) return std::nullopt;
  return *peer / *ours;
}

/// The slope of log time against log agents, by least squares; nullopt: fewer than three sizes.
std::optional<double> GrowthExponent(const std::vector<std::pair<double, double>>& times) {
  if (times.size() < 3) return std::nullopt;
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const auto& [agents, seconds] : times) {
    const double u = std::log(agents), v = std::log(seconds);
    n += 1, x += u, y += v, xx += u * u, xy += u * v;
  }
  return (n * xy - x * y) / (n * xx - x * x);
}

void ScratchPart(const Settings& settings, Report* report) {
  using baselines::FirstHit;
  std::map<FirstHit, std::vector<std::pair<double, double>>> times;
  for (const std::uint32_t count : {100u, 1000u, 10'000u, 100'000u, 1'000'000u}) {
    if (settings.quick && count > 100'000) continue;
    for (const FirstHit hit : {FirstHit::kAtOnce, FirstHit::kHalf, FirstHit::kNever}) {
      const std::string name = std::string("uniform ") + baselines::Name(hit);
      if (!WantsAny(settings, "scratch", name, count)) continue;
      const auto rows =
          MeasureAll(settings, {"scratch", name, baselines::FirstHitScene(count, hit)}, report);
      for (const Row& row : rows) {
        // Below a thousand it is all pairs in any case.
        if (count >= 1000 && row.contestant == OurChoice().name && row.seconds) {
          times[hit].emplace_back(count, *row.seconds);
        }
      }
      if (count < 100'000) continue;
      const std::string size = count == 100'000 ? "100k" : "1m";
      report->Figure("scratch_" + size + "_" + baselines::Name(hit), PeerOverOurs(rows));
    }
  }
  std::optional<double> growth;
  for (const auto& [hit, of_hit] : times) {
    const auto exponent = GrowthExponent(of_hit);
    if (exponent) growth = std::max(growth.value_or(*exponent), *exponent);
  }
  report->Figure("growth_exponent", growth);
}

void ScenesPart(const Settings& settings, Report* report) {
  std::optional<double> worst;
  for (const std::string& name : baselines::SceneNames()) {
    for (const std::uint32_t count : {10'000u, 100'000u}) {
      if (settings.quick && count > 10'000) continue;
      const auto rows =
          MeasureAll(settings, {"scenes", name, baselines::MakeScene(name, count, 3)}, report);
      std::optional<double> ours, other;
      for (const Row& row : rows) {
        if (!row.seconds) continue;
        auto& best = row.contestant == OurChoice().name ? ours : other;
        best = std::min(best.value_or(*row.seconds), *row.seconds);
      }
      if (ours && other) worst = std::min(worst.value_or(*other / *ours), *other / *ours);
    }
  }
  report->Figure("worst_scene_ratio", worst);
}

}  // namespace collision::bench
