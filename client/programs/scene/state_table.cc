#include "client/programs/scene/state_table.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "idl/limits.h"

namespace collision::client {
namespace {

constexpr double kSecondsOfNs = 1e-9;
constexpr double kOrientationOne = 32'000;

enum Flags : std::uint32_t {
  kHasState = 1,
  kNotClear = 2,
  kSaturated = 4,
  kDiscontinuity = 8,
};

template <class Value>
void Put(Value value, std::string* bytes) {
  const std::size_t at = bytes->size();
  bytes->resize(at + sizeof value);
  std::memcpy(bytes->data() + at, &value, sizeof value);
}

std::array<double, 3> ArrayOf(const v1::Vector3& v) { return {v.x(), v.y(), v.z()}; }

template <std::size_t kSize>
bool IsWithin(const std::array<double, kSize>& values, double greatest) {
  return std::ranges::all_of(values, [&](double x) { return std::abs(x) <= greatest; });
}

/// As the service asks; NaN is within nothing.
bool CanBe(const v1::AgentState& state) {
  constexpr double kMost = std::numeric_limits<float>::max();
  const v1::Quaternion& q = state.orientation();
  const std::array<double, 4> orientation{q.w(), q.x(), q.y(), q.z()};
  const std::array<double, 2> errors{state.position_error_m(), state.velocity_error_m_s()};
  return state.stamp_ns() <= wire::kInstantMax && state.stamp_ns() >= -wire::kInstantMax &&
         IsWithin(ArrayOf(state.position_m()), wire::kCoordinateMax) &&
         IsWithin(ArrayOf(state.velocity_m_s()), kMost) &&
         IsWithin(ArrayOf(state.acceleration_m_s2()), kMost) &&
         IsWithin(ArrayOf(state.angular_velocity_rad_s()), kMost) && IsWithin(orientation, 1.01) &&
         IsWithin(errors, kMost);
}

/// Positions to the step; rates grow with time, and turn large bodies visibly.
StateTable::Agent Rounded(StateTable::Agent agent, double step) {
  const auto round = [](double* x, double unit) { *x = unit * std::round(*x / unit); };
  const double rate_step = std::min(step, StateTable::kRateStepMax);
  for (double& x : agent.p) round(&x, step);
  for (auto* vector : {&agent.v, &agent.a, &agent.w}) {
    for (double& x : *vector) round(&x, rate_step);
  }
  round(&agent.position_error, step);
  round(&agent.velocity_error, rate_step);
  return agent;
}

}  // namespace

std::optional<std::uint32_t> StateTable::NumberOf(std::uint64_t simulator, std::uint32_t slot) {
  const auto next = static_cast<std::uint32_t>(agents_.size());
  const auto known = Known(simulator, slot);
  if (known || next == kAgentsMax || slot > wire::kSlotMax) return known;
  const PageKey key{simulator, slot / Page::kSlots};
  std::unique_ptr<Page>& page = pages_[key];
  if (!page) {
    page = std::make_unique<Page>();
    page->numbers.fill(Page::kNone);
  }
  page->numbers[slot % Page::kSlots] = next;
  agents_.push_back({.simulator = simulator, .slot = slot});
  if (next / kStatesOfAChunk >= changed_.size()) changed_.push_back(false);
  return next;
}

StateTable::Page* StateTable::FindPage(const PageKey& key) const {
  if (last_page_.second != nullptr && last_page_.first == key) return last_page_.second;
  const auto page = pages_.find(key);
  if (page == pages_.end()) return nullptr;
  last_page_ = {key, page->second.get()};
  return page->second.get();
}

std::optional<std::uint32_t> StateTable::Known(std::uint64_t simulator, std::uint32_t slot) const {
  const Page* page = FindPage({simulator, slot / Page::kSlots});
  if (page == nullptr) return std::nullopt;
  const std::uint32_t number = page->numbers[slot % Page::kSlots];
  return number == Page::kNone ? std::nullopt : std::optional(number);
}

StateTable::Agent* StateTable::Find(std::uint64_t simulator, std::uint32_t slot) {
  const auto number = NumberOf(simulator, slot);
  if (!number) return nullptr;
  changed_[*number / kStatesOfAChunk] = true;
  agents_[*number].change = ++last_;
  return &agents_[*number];
}

void StateTable::Take(const v1::AgentStates& states) {
  for (const v1::AgentState& state : states.states()) {
    if (!CanBe(state)) continue;
    Agent* agent = Find(states.simulator_id(), state.slot());
    if (agent == nullptr || states.run() < agent->run) continue;
    agent->run = states.run();
    agent->generation = state.generation();
    agent->has_state = true;
    agent->stamp_ns = state.stamp_ns();
    agent->p = ArrayOf(state.position_m());
    agent->v = ArrayOf(state.velocity_m_s());
    agent->a = ArrayOf(state.acceleration_m_s2());
    agent->w = ArrayOf(state.angular_velocity_rad_s());
    const v1::Quaternion& q = state.orientation();
    agent->q = {q.w(), q.x(), q.y(), q.z()};
    agent->position_error = state.position_error_m();
    agent->velocity_error = state.velocity_error_m_s();
    agent->discontinuity = state.discontinuity();
  }
}

void StateTable::Take(const v1::Clearance& clearance) {
  for (const v1::AgentClearance& one : clearance.agents()) {
    Agent* agent = Find(clearance.simulator_id(), one.slot());
    if (agent == nullptr) continue;
    agent->is_promised = one.clear_until_ns() != std::numeric_limits<std::int64_t>::min();
    agent->clear_until_ns = one.clear_until_ns();
    agent->not_clear = one.not_clear();
    agent->saturated = one.saturated();
  }
}

void StateTable::Clear(std::uint64_t simulator, std::uint32_t slot) {
  if (Agent* agent = Find(simulator, slot))
    *agent = {.simulator = simulator, .slot = slot, .change = last_};
}

std::vector<std::uint32_t> StateTable::TakeChanged() {
  std::vector<std::uint32_t> chunks;
  for (std::uint32_t chunk = 0; chunk < changed_.size(); ++chunk) {
    if (changed_[chunk]) chunks.push_back(chunk);
    changed_[chunk] = false;
  }
  return chunks;
}

std::string StateTable::Pack(std::uint32_t chunk) const {
  const std::uint32_t first = chunk * kStatesOfAChunk;
  const std::uint32_t count =
      std::min(kStatesOfAChunk, static_cast<std::uint32_t>(agents_.size()) - first);
  std::string bytes;
  bytes.reserve(kHeaderBytes + kStateBytes * count);
  Put(first, &bytes);
  Put(count, &bytes);
  for (std::uint32_t i = first; i < first + count; ++i) PackAgent(agents_[i], &bytes);
  return bytes;
}

std::string StateTable::PackAfter(std::uint64_t seen, double step) const {
  std::string rows;
  for (std::uint32_t number = 0; number < agents_.size(); ++number) {
    if (agents_[number].change <= seen) continue;
    Put(number, &rows);
    Put(std::uint32_t{0}, &rows);
    PackAgent(step > 0 ? Rounded(agents_[number], step) : agents_[number], &rows);
  }
  constexpr std::size_t kRow = kHeaderBytes + kStateBytes;
  std::string planes(rows.size(), '\0');
  const std::size_t count = rows.size() / kRow;
  for (std::size_t row = 0; row < count; ++row) {
    for (std::size_t k = 0; k < kRow; ++k) planes[k * count + row] = rows[row * kRow + k];
  }
  return planes;
}

void StateTable::PackAgent(const Agent& agent, std::string* bytes) {
  std::uint32_t flags = 0;
  if (agent.has_state) flags |= kHasState;
  if (agent.not_clear) flags |= kNotClear;
  if (agent.saturated) flags |= kSaturated;
  if (agent.discontinuity) flags |= kDiscontinuity;
  Put(flags, bytes);
  const double clear_s = kSecondsOfNs * (static_cast<double>(agent.clear_until_ns) -
                                         static_cast<double>(agent.stamp_ns));
  Put(agent.is_promised ? static_cast<float>(clear_s) : -std::numeric_limits<float>::infinity(),
      bytes);
  Put(kSecondsOfNs * static_cast<double>(agent.stamp_ns), bytes);
  for (const double x : agent.p) Put(x, bytes);
  for (const auto& vector : {agent.v, agent.a, agent.w}) {
    for (const double x : vector) Put(static_cast<float>(x), bytes);
  }
  Put(static_cast<float>(agent.position_error), bytes);
  Put(static_cast<float>(agent.velocity_error), bytes);
  for (const double x : agent.q) {
    Put(static_cast<std::int16_t>(std::lround(x * kOrientationOne)), bytes);
  }
  Put(agent.generation, bytes);
}

}  // namespace collision::client
