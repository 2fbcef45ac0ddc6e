// One agent's new bound after the other; after each the earliest of all must be current.
#include <algorithm>

#include "tests/baselines/ball_bound.h"
#include "tests/baselines/lazy_earliest.h"
#include "tests/bench/broad_phase/methods.h"
#include "tests/bench/broad_phase/parts.h"
#include "tests/bench/broad_phase/updated.h"
#include "tests/bench/harness/allocation_counter.h"
#include "tests/bench/harness/measure.h"

namespace collision::bench {
namespace {

constexpr const char* kScene = "swinging";

/// Ours: the method is updated, and the queue repeats a query where it must.
class UpdatedMethod : public Updated, private baselines::AgentAsker {
 public:
  UpdatedMethod(const UpdateStream& stream, const Method& method)
      : method_(method.make()), earliest_(stream.start.size(), stream.horizon, this) {
    for (std::size_t i = 0; i < stream.start.size(); ++i) {
      method_->Set(static_cast<std::uint32_t>(i), baselines::BoundOf(stream.start[i]));
    }
    for (std::size_t i = 0; i < stream.start.size(); ++i) {
      earliest_.Ask(static_cast<std::uint32_t>(i), Instant());
    }
  }

  void Update(std::uint32_t agent, const baselines::BallAgent& state) override {
    const motion::SpaceTimeBound bound = baselines::BoundOf(state);
    now_ = bound.state.stamp;
    method_->Tighten(agent, bound);
    earliest_.Renewed(agent);
  }

  Answer Earliest() override {
    const auto found = earliest_.Earliest(now_);
    if (!found) return {};
    return {true, std::min(found->agent, found->partner), std::max(found->agent, found->partner),
            found->when.nanoseconds()};
  }

  std::uint64_t asked() const override { return earliest_.asked(); }

 private:
  std::optional<baselines::AgentMeeting> Ask(std::uint32_t agent, Instant from,
                                             Instant until) override {
    const auto meeting = method_->EarliestOf(agent, {intersection::BoundKind::kHorn, from, until});
    if (!meeting) return std::nullopt;
    return baselines::AgentMeeting{meeting->lower == agent ? meeting->higher : meeting->lower,
                                   meeting->time.instant()};
  }

  std::unique_ptr<broad_phase::SweepingIndex> method_;
  Instant now_;
  baselines::LazyEarliest earliest_;
};

using Make = std::function<std::unique_ptr<Updated>(const UpdateStream&)>;

/// Median of the blocks' means, p50 and p99 of single updates, allocations, bytes, asked again, and
/// the last answer.
std::vector<double> Measure(const UpdateStream& stream, const Make& make) {
  KeepMemory();
  const std::int64_t bytes_before = LiveBytes();
  const auto updated = make(stream);
  const auto bytes = static_cast<double>(LiveBytes() - bytes_before);
  constexpr std::size_t kBlocks = 20;
  const std::size_t block = (stream.updates.size() - stream.warm_up) / (2 * kBlocks);
  // First in blocks, without a clock between the updates; then each by itself.
  std::size_t next = 0;
  const auto step = [&] {
    const auto& update = stream.updates[next++];
    updated->Update(update.agent, update.state);
    return updated->Earliest();
  };
  std::vector<double> means, single;
  single.reserve(block * kBlocks);
  while (next < stream.warm_up) step();
  updated->WarmedUp();
  const std::uint64_t allocations_before = Allocations(), asked_before = updated->asked();
  const std::size_t first = next;
  for (std::size_t i = 0; i < kBlocks; ++i) {
    const CpuStopwatch watch;
    for (std::size_t k = 0; k < block; ++k) step();
    means.push_back(watch.seconds() / static_cast<double>(block));
  }
  const auto counted = static_cast<double>(next - first);
  const auto allocations = static_cast<double>(Allocations() - allocations_before);
  const auto asked = static_cast<double>(updated->asked() - asked_before);
  Answer answer;
  while (next < stream.updates.size()) {
    const Stopwatch watch;
    answer = step();
    single.push_back(watch.seconds());
  }
  return {Median(means),
          Median(single),
          Quantile(single, 0.99),
          allocations / counted,
          bytes / static_cast<double>(stream.start.size()),
          asked / counted,
          static_cast<double>(answer.found),
          static_cast<double>(answer.lower),
          static_cast<double>(answer.higher),
          static_cast<double>(answer.time_ns)};
}

Row MeasureRow(const Settings& settings, const std::string& name, const UpdateStream& stream,
               const Make& make, Report* report) {
  Row row;
  row.part = "incremental", row.scene = kScene, row.agents = stream.start.size();
  row.contestant = name, row.cut_off = 3 * settings.cut_off();
  if (!settings.Wants(row.path())) return row;
  const ApartResult result = RunApart(row.cut_off, [&] { return Measure(stream, make); });
  row.failed = result.status == ApartStatus::kFailed;
  if (result.status == ApartStatus::kDone) {
    const auto& v = result.values;
    row.seconds = v[0];
    row.answer = Answer{v[6] != 0, static_cast<std::uint32_t>(v[7]),
                        static_cast<std::uint32_t>(v[8]), static_cast<std::int64_t>(v[9])};
    row.more = {Number("p50_s", v[1]), Number("p99_s", v[2]),
                Number("allocations_per_update", v[3]), Number("bytes_per_agent", v[4]),
                Number("asked_again_per_update", v[5])};
    char text[120];
    std::snprintf(text, sizeof text,
                  "p50 %.0f ns, p99 %.0f ns, %.3f asked, %.3f allocations, %.0f B", v[1] * 1e9,
                  v[2] * 1e9, v[5], v[3], v[4]);
    row.remark = text;
  }
  report->Add(row);
  return row;
}

double ValueOf(const Row& row, const std::string& name) {
  for (const Field& field : row.more) {
    if (field.name == name) return std::stod(field.json);
  }
  return 0;
}

}  // namespace

void IncrementalPart(const Settings& settings, Report* report) {
  for (const std::uint32_t count : {1000u, 10'000u, 100'000u}) {
    if (!WantsAny(settings, "incremental", kScene, count)) continue;
    const std::size_t updates = settings.quick ? 50'000 : 200'000;
    const UpdateStream stream = MakeUpdates(count, updates);
    std::optional<Row> ours;
    std::optional<Answer> reference;
    const auto measure = [&](const std::string& name, bool is_ours, const Make& make) {
      const Row row = MeasureRow(settings, name, stream, make, report);
      if (row.answer && !reference) reference = row.answer;
      if (row.answer && !(is_ours ? *row.answer == *reference : Agree(*row.answer, *reference))) {
        report->Mark("ANSWERS DIFFER");
      }
      return row;
    };
    for (const Method& method : OurMethods()) {
      if (!method.make) continue;  // A sweep answers no query about one agent.
      const Row row = measure(method.name, true, [&method](const UpdateStream& s) {
        return std::make_unique<UpdatedMethod>(s, method);
      });
      if (method.name == OurChoice().name && row.seconds) ours = row;
    }
#ifdef COLLISION_HAS_BULLET
    const Row eager = measure("Bullet", false, [](const UpdateStream& s) {
      return MakeUpdatedBullet(s, BulletUse::kEager);
    });
    measure("Bullet, asked lazily", false,
            [](const UpdateStream& s) { return MakeUpdatedBullet(s, BulletUse::kLazy); });
    const std::string figure = count == 1000 ? "incremental_1k" : "incremental_100k";
    if (count != 10'000) {
      report->Figure(figure, ours && eager.seconds
                                 ? std::optional<double>(*eager.seconds / *ours->seconds)
                                 : std::nullopt);
    }
#endif
    if (count == 100'000 && ours) {
      report->Figure("bytes_per_agent", ValueOf(*ours, "bytes_per_agent"));
      report->Figure("allocations_per_update", ValueOf(*ours, "allocations_per_update"));
    }
  }
}

}  // namespace collision::bench
