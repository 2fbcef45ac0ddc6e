#include "server/claim/quarantine.h"

#include <fcntl.h>
#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <span>
#include <stdexcept>
#include <utility>

#include "idl/identity.h"
#include "idl/limits.h"
#include "server/process/write_all.h"

namespace collision::server {
namespace {

constexpr char kQuarantineMagic[8] = {'C', 'Q', 'U', 'A', 'R', 'A', 'N', 1};

/// Of Page::applying: the messages of the step are applied, all of them.
constexpr std::uint32_t kAllApplied = ~std::uint32_t{0};

std::uint64_t Mixed(std::uint64_t hash, std::uint64_t value) {
  hash = (hash ^ value) * 0x9e3779b97f4a7c15;
  return hash ^ (hash >> 32);
}

std::uint64_t ContentOf(const v1::AgentStates& chunk) {
  std::uint64_t hash = Mixed(chunk.run(), static_cast<std::uint64_t>(chunk.states_size()));
  for (const v1::AgentState& state : chunk.states()) {
    hash = Mixed(hash, (std::uint64_t{state.slot()} << 32) | state.generation());
    hash = Mixed(hash, static_cast<std::uint64_t>(state.stamp_ns()));
    for (const auto& vector : {state.position_m(), state.velocity_m_s()}) {
      for (const double number : {vector.x(), vector.y(), vector.z()}) {
        hash = Mixed(hash, std::bit_cast<std::uint64_t>(number));
      }
    }
  }
  return hash;
}

std::uint64_t ContentOf(v1::AgentDescription description) {
  description.clear_sequence();  // of the writing, not of the content
  description.clear_states_sequence();
  return Fnv1a(description.SerializeAsString());
}

}  // namespace

struct Quarantine::Page {
  char magic[sizeof(kQuarantineMagic)];
  std::uint32_t in_step;
  std::uint32_t applied;   // messages of the step that were begun; of the last ones there are marks
  std::uint32_t applying;  // the index of one of them, or kAllApplied
  std::uint32_t suspected;
  std::uint32_t quarantined;
  std::uint32_t reserved;
  MessageMark marks[kMarksMax];
  MessageMark suspects[kMarksMax];
  MessageMark refused[kQuarantinedMax];
};

MessageMark MarkOf(const v1::Input& input) {
  const auto kind = static_cast<std::uint32_t>(input.message_case());
  switch (input.message_case()) {
    case v1::Input::kAgentDescription: {
      const v1::AgentDescription& wire = input.agent_description();
      return {wire.simulator_id(), ContentOf(wire), kind, wire.slot()};
    }
    case v1::Input::kShapePart: {
      const v1::ShapePart& wire = input.shape_part();
      return {wire.simulator_id(), Fnv1a(wire.content_hash()), kind, 0};
    }
    case v1::Input::kAgentStates: {
      const v1::AgentStates& wire = input.agent_states();
      return {wire.simulator_id(), ContentOf(wire), kind, wire.chunk()};
    }
    case v1::Input::kSimulatorClock: {
      const v1::SimulatorClock& wire = input.simulator_clock();
      const std::uint64_t clock = Mixed(wire.run(), static_cast<std::uint64_t>(wire.clock_ns()));
      return {wire.simulator_id(), Mixed(clock, static_cast<std::uint64_t>(wire.next_ns())), kind,
              0};
    }
    default:
      return {};
  }
}

Quarantine::Quarantine(const std::string& folder, const std::string& world, std::uint32_t domain,
                       const Roster& roster)
    : path_(fmt::format("{}/{}.{}.quarantine", folder, world, domain)) {
  for (const auto& [id, simulator] : roster) KeepName(id, simulator.name);
  const int file = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644);
  if (file < 0) throw std::runtime_error(path_ + ": cannot be written: " + CauseOf(errno));
  // All of it is there from now on: a store into a mapped file cannot report a full disk.
  int failure = posix_fallocate(file, 0, sizeof(Page));
  void* const page = failure != 0
                         ? MAP_FAILED
                         : mmap(nullptr, sizeof(Page), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (failure == 0 && page == MAP_FAILED) failure = errno;
  close(file);
  if (failure != 0) throw std::runtime_error(path_ + ": cannot be written: " + CauseOf(failure));
  page_ = static_cast<Page*>(page);
  if (std::memcmp(page_->magic, kQuarantineMagic, sizeof kQuarantineMagic) != 0 ||
      page_->suspected > kMarksMax || page_->quarantined > kQuarantinedMax) {
    Begin();
  }
  if (page_->in_step != 0) TakeUnfinishedStep();
}

Quarantine::~Quarantine() {
  if (page_->in_step == 0) page_->suspected = 0;
  munmap(page_, sizeof(Page));
}

void Quarantine::Begin() {
  std::memset(static_cast<void*>(page_), 0, sizeof(Page));
  std::memcpy(page_->magic, kQuarantineMagic, sizeof kQuarantineMagic);
}

void Quarantine::TakeUnfinishedStep() {
  const std::uint32_t kept = std::min(page_->applied, kMarksMax);
  if (page_->applying != kAllApplied) {
    if (kept > 0) Suspect(page_->marks[page_->applying % kMarksMax], true);
  } else {
    for (std::uint32_t i = 0; i < kept; ++i) Suspect(page_->marks[i], kept == 1);
  }
  page_->in_step = 0;
  LogSuspicion();
}

void Quarantine::LogSuspicion() const {
  const std::uint32_t suspected = page_->suspected;
  std::string what = page_->quarantined > 0
                         ? "no message is suspected beside those that are refused from now on"
                         : "no message is suspected: none that comes back was being applied";
  if (suspected > 0) {
    what =
        fmt::format("suspected, and applied in steps of their own: {}", TextOf(*page_->suspects));
    if (suspected > 1) what += fmt::format(", and {} more of that step", suspected - 1);
  }
  spdlog::warn("{}: the service ended in the middle of a step; {}", path_, what);
  for (std::uint32_t i = 0; i < page_->quarantined; ++i) {
    spdlog::warn(
        "{}: refused as long as its content is the same: {} (to end that, remove the file while "
        "the service is stopped)",
        path_, TextOf(page_->refused[i]));
  }
}

std::string Quarantine::TextOf(const MessageMark& mark) const {
  const char* kind = mark.kind == v1::Input::kAgentDescription ? "description of slot"
                     : mark.kind == v1::Input::kShapePart      ? "shape"
                     : mark.kind == v1::Input::kAgentStates    ? "states of chunk"
                                                               : "clock";
  const auto name = names_.find(mark.simulator);
  const std::string simulator = name == names_.end() ? "" : " \"" + name->second + "\"";
  return fmt::format("simulator {}{}, {} {}, content {:016x}", IdText(mark.simulator), simulator,
                     kind, mark.place, mark.content);
}

void Quarantine::KeepName(std::uint64_t simulator, const std::string& name) {
  if (SimulatorId(name) != simulator || !wire::IsName(name)) return;
  if (names_.size() == kNamesMax) return;
  names_.try_emplace(simulator, name);
}

// `convicts`: nothing else of the step can have been the cause.
void Quarantine::Suspect(const MessageMark& mark, bool convicts) {
  if (mark.kind == 0 || IsQuarantined(mark)) return;
  if (!IsSuspected(mark)) {
    if (page_->suspected < kMarksMax) page_->suspects[page_->suspected++] = mark;
    return;
  }
  if (!convicts) return;
  Acquit(mark);
  if (page_->quarantined == kQuarantinedMax) {
    std::copy(std::begin(page_->refused) + 1, std::end(page_->refused), page_->refused);
    --page_->quarantined;
  }
  page_->refused[page_->quarantined++] = mark;
}

bool Quarantine::IsSuspected(const MessageMark& mark) const {
  return std::ranges::count(std::span(page_->suspects, page_->suspected), mark) > 0;
}

bool Quarantine::IsQuarantined(const MessageMark& mark) const {
  return std::ranges::count(std::span(page_->refused, page_->quarantined), mark) > 0;
}

void Quarantine::Acquit(const MessageMark& mark) {
  MessageMark* const end = page_->suspects + page_->suspected;
  page_->suspected =
      static_cast<std::uint32_t>(std::remove(page_->suspects, end, mark) - page_->suspects);
}

void Quarantine::AcquitReplaced(const MessageMark& newer) {
  const auto replaced = [&newer](const MessageMark& mark) {
    return mark.simulator == newer.simulator && mark.kind == newer.kind &&
           mark.place == newer.place && mark.content != newer.content;
  };
  MessageMark* const end = page_->suspects + page_->suspected;
  page_->suspected =
      static_cast<std::uint32_t>(std::remove_if(page_->suspects, end, replaced) - page_->suspects);
}

void Quarantine::Screen(std::vector<v1::Input>* batch) {
  if (!holds() && page_->suspected == 0 && page_->quarantined == 0) return;
  for (v1::Input& input : *batch) {
    const MessageMark mark = MarkOf(input);
    KeepName(mark.simulator, input.has_agent_description()
                                 ? input.agent_description().simulator_name()
                                 : input.simulator_clock().simulator_name());
    input.set_quarantined(IsQuarantined(mark));
    if (mark.kind != v1::Input::kShapePart) AcquitReplaced(mark);
    const bool suspected = IsSuspected(mark);
    input.set_suspected(suspected);
    if (suspected) {
      suspected_waiting_.push_back(std::move(input));
    } else {
      waiting_.push_back(std::move(input));
    }
  }
  batch->clear();
  if (suspected_waiting_.empty()) {
    *batch = std::exchange(waiting_, {});
    return;
  }
  batch->push_back(std::move(suspected_waiting_.front()));
  suspected_waiting_.pop_front();
  on_trial_ = MarkOf(batch->front());
}

// What the page says must be true at each moment: its fields are stored in this order.
void Quarantine::BeginStep() {
  page_->applied = 0;
  page_->applying = kAllApplied;
  std::atomic_signal_fence(std::memory_order_seq_cst);
  page_->in_step = 1;
}

void Quarantine::Apply(const v1::Input& input) {
  page_->marks[page_->applied % kMarksMax] = MarkOf(input);
  std::atomic_signal_fence(std::memory_order_seq_cst);
  page_->applying = page_->applied++;
  std::atomic_signal_fence(std::memory_order_seq_cst);
}

void Quarantine::EndMessages() { page_->applying = kAllApplied; }

void Quarantine::AbandonStep() { std::atomic_ref(page_->in_step).store(0); }

void Quarantine::EndStep() {
  std::atomic_signal_fence(std::memory_order_seq_cst);
  page_->in_step = 0;
  // The part that completes a shape may still come.
  if (on_trial_ && on_trial_->kind != v1::Input::kShapePart) Acquit(*on_trial_);
  on_trial_.reset();
}

std::uint32_t Quarantine::suspected() const { return page_->suspected; }

std::uint32_t Quarantine::quarantined() const { return page_->quarantined; }

std::string Quarantine::Summary() const {
  std::string text;
  if (page_->suspected > 0) {
    text = fmt::format("{} suspected, the first: {}", page_->suspected, TextOf(*page_->suspects));
  }
  if (page_->quarantined > 0) {
    text += fmt::format("{}{} refused, the last: {}", text.empty() ? "" : "; ", page_->quarantined,
                        TextOf(page_->refused[page_->quarantined - 1]));
  }
  return text;
}

}  // namespace collision::server
