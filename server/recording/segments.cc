#include "server/recording/segments.h"

#include <spdlog/spdlog.h>

#include <utility>

#include "idl/recording/entries.h"
#include "server/recording/recorded_claim.h"
#include "server/recording/recording.h"

namespace collision::server {
namespace {

constexpr std::size_t kFlushBytes = 1 << 20;

/// An input in a batch, and a batch in an entry, as protobuf writes them: tag, length, bytes.
constexpr char kInputTag = 3 << 3 | 2;
constexpr char kBatchTag = 2 << 3 | 2;

/// Beside the inputs of a batch: its times, tags, lengths, checksum.
constexpr std::uint64_t kOverhead = 256;

void AppendField(char tag, std::size_t length, std::string* bytes) {
  bytes->push_back(tag);
  for (; length > 0x7f; length >>= 7) bytes->push_back(static_cast<char>(length | 0x80));
  bytes->push_back(static_cast<char>(length));
}

void AppendInput(const std::string& serialised, std::string* inputs) {
  AppendField(kInputTag, serialised.size(), inputs);
  *inputs += serialised;
}

/// The end of the program that spoke for a simulator.
std::string EndOf(std::uint64_t simulator, std::uint64_t sender) {
  v1::Input input;
  input.set_sender(sender);
  input.mutable_liveliness()->set_simulator_id(simulator);
  return input.SerializeAsString();
}

}  // namespace

Segments::Segments(RollingPlace place, SegmentLimits limits, const v1::Config& config,
                   const ClaimOptions& claim, std::int64_t wall_ns)
    : files_(std::move(place)),
      limits_(limits),
      config_(config),
      newest_(NewestBytesMax(config)),
      wall_ns_(wall_ns) {
  if (files_.Begin(wall_ns)) {
    Append(HeaderOf(config_, claim, number_));
    Flush();
  } else {
    Fail();
  }
}

void Segments::Take(const v1::RecordedBatch& batch, const std::optional<Opening>& opening) {
  wall_ns_ = batch.wall_ns();
  monotonic_ns_ = batch.monotonic_ns();
  const bool is_due = wants_opening_ || !newest_.wants_census();
  if (opening && !(opening->serves && is_due)) {
    newest_.Keep(opening->simulators);
  } else if (opening) {
    Begin(batch, *opening);
  }
  std::string inputs;
  for (const v1::Input& input : batch.inputs()) {
    std::string serialised = input.SerializeAsString();
    if (files_.is_open()) {
      if (inputs.size() + serialised.size() + kOverhead > wire::kEntryBytesMax) {
        v1::RecordedBatch part;
        CopyTimes(batch, &part);
        part.set_continued(true);
        AppendBatch(part, std::exchange(inputs, {}));
      }
      AppendInput(serialised, &inputs);
    }
    newest_.Take(input, std::move(serialised));
  }
  if (files_.is_open()) {
    v1::RecordedBatch times;
    CopyTimes(batch, &times);
    AppendBatch(times, inputs);
  }
  const std::uint64_t bytes = files_.bytes() + unwritten_.size();
  const bool is_full = bytes >= limits_.bytes || monotonic_ns_ - began_ns_ >= limits_.age_ns;
  if (files_.is_open() ? is_full : monotonic_ns_ >= retry_ns_) wants_opening_ = true;
  if (files_.is_open() && bytes >= 2 * limits_.bytes) Close(false);
  if (unwritten_.size() >= kFlushBytes) Flush();
}

void Segments::Begin(const v1::RecordedBatch& batch, const Opening& opening) {
  Close(true);
  wants_opening_ = false;
  newest_.Keep(opening.simulators);
  TellWhatIsLeftOut();
  began_ns_ = monotonic_ns_;
  if (!files_.Begin(wall_ns_)) return Fail();
  Append(HeaderOf(config_, opening.claim, ++number_));
  AppendOpening(batch, opening);
  Flush();
  if (files_.is_open() && !std::exchange(failure_, {}).empty()) {
    spdlog::info("{}: the flight recorder goes on", files_.path());
  }
}

void Segments::TellWhatIsLeftOut() {
  if (newest_.left_out() == left_out_told_) return;
  left_out_told_ = newest_.left_out();
  spdlog::warn(
      "flight recorder: {} inputs had no room so far among the newest ones (of {} MB): a "
      "replay from a later segment may lack agents or shapes",
      left_out_told_, newest_.bytes_max() / 1'000'000);
}

void Segments::AppendOpening(const v1::RecordedBatch& batch, const Opening& opening) {
  v1::RecordedBatch times;
  CopyTimes(batch, &times);
  times.set_opening(true);
  std::string inputs;
  const auto append = [&](const std::string& serialised) {
    if (inputs.size() + serialised.size() + kOverhead > wire::kEntryBytesMax) {
      times.set_continued(true);
      AppendBatch(times, std::exchange(inputs, {}));
      times.set_continued(false);
    }
    AppendInput(serialised, &inputs);
  };
  newest_.Visit(append);
  for (const auto& [id, simulator] : opening.simulators) {
    if (!simulator.is_alive) append(EndOf(id, simulator.sender));
  }
  AppendBatch(times, std::exchange(inputs, {}));
  newest_.VisitReady(append);
  if (!inputs.empty()) AppendBatch(times, inputs);
}

/// `times`: the batch without its inputs, of which `inputs` are the bytes.
void Segments::AppendBatch(const v1::RecordedBatch& times, const std::string& inputs) {
  const std::string fields = times.SerializeAsString();
  std::string entry;
  AppendField(kBatchTag, fields.size() + inputs.size(), &entry);
  entry += fields;
  entry += inputs;
  wire::AppendEntry(entry, &unwritten_);
}

void Segments::Append(const v1::RecordingEntry& entry) { wire::AppendEntry(entry, &unwritten_); }

void Segments::Miss(NewestInputs* newest) {
  Close(false);
  newest_.Take(newest);
  spdlog::warn("flight recorder: the disk was too slow, batches are missing from here on");
}

void Segments::Flush() {
  const std::string bytes = std::exchange(unwritten_, {});
  if (bytes.empty() || !files_.is_open()) return;
  if (!files_.Append(bytes, wall_ns_)) Fail();
}

void Segments::Close(bool continues) {
  if (!files_.is_open()) return;
  v1::RecordingEntry entry;
  entry.mutable_end()->set_continues(continues);
  Append(entry);
  Flush();
  files_.Close();
  retry_ns_ = monotonic_ns_;
}

void Segments::SetLimits(RollingLimits all, SegmentLimits segment) {
  files_.SetLimits(all);
  limits_ = segment;
}

void Segments::End() { Close(false); }

void Segments::Fail() {
  const bool is_new = failure_.empty();
  failure_ = files_.error();
  files_.Close();
  unwritten_.clear();
  retry_ns_ = monotonic_ns_ + limits_.retry_ns;
  wants_opening_ = false;
  if (is_new) {
    spdlog::error("{}; the flight recorder tries again in {} s", failure_,
                  limits_.retry_ns / 1'000'000'000);
  }
}

}  // namespace collision::server
