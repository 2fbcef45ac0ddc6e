#include "client/programs/gateway/scene/state_table.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace collision::gateway {
namespace {

constexpr double kSecondsOfNs = 1e-9;
constexpr double kStepsMax = 2'000'000'000;  // of a position, from the chunk's origin
constexpr double kShortMax = 32'000;         // of an acceleration or an angular velocity

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

template <class Whole>
Whole Rounded(double value) {
  constexpr double kLeast = std::numeric_limits<Whole>::min();
  constexpr double kGreatest = std::numeric_limits<Whole>::max();
  return static_cast<Whole>(std::clamp(std::nearbyint(value), kLeast, kGreatest));
}

std::array<double, 3> ArrayOf(const v1::Vector3& v) { return {v.x(), v.y(), v.z()}; }

double Greatest(const std::array<double, 3>& v) {
  return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
}

/// The unit in which a whole number up to `most` holds all of `greatest`.
double UnitOf(double greatest, double most) { return greatest > 0 ? greatest / most : 1; }

}  // namespace

std::optional<std::uint32_t> StateTable::NumberOf(std::uint64_t simulator, std::uint32_t slot) {
  const auto next = static_cast<std::uint32_t>(agents_.size());
  if (next == kAgentsMax) {
    const auto known = numbers_.find({simulator, slot});
    return known == numbers_.end() ? std::nullopt : std::optional(known->second);
  }
  const auto [place, is_new] = numbers_.try_emplace({simulator, slot}, next);
  if (is_new) {
    agents_.emplace_back();
    if (next / kStatesOfAChunk >= changed_.size()) changed_.push_back(false);
  }
  return place->second;
}

StateTable::Agent* StateTable::Find(std::uint64_t simulator, std::uint32_t slot) {
  const auto number = NumberOf(simulator, slot);
  if (!number) return nullptr;
  MarkChanged(*number);
  return &agents_[*number];
}

void StateTable::MarkChanged(std::uint32_t number) { changed_[number / kStatesOfAChunk] = true; }

void StateTable::Take(const v1::AgentStates& states) {
  for (const v1::AgentState& state : states.states()) {
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
  if (Agent* agent = Find(simulator, slot)) *agent = {};
}

std::vector<StateTable::Chunk> StateTable::TakeChanged() {
  std::vector<Chunk> chunks;
  for (std::uint32_t chunk = 0; chunk < changed_.size(); ++chunk) {
    if (!changed_[chunk]) continue;
    changed_[chunk] = false;
    chunks.push_back({chunk, Pack(chunk)});
  }
  return chunks;
}

std::string StateTable::Pack(std::uint32_t chunk) const {
  const auto begin = agents_.begin() + chunk * kStatesOfAChunk;
  const auto end = agents_.begin() +
                   std::min<std::ptrdiff_t>((chunk + 1) * kStatesOfAChunk, std::ssize(agents_));
  std::array<double, 3> low{}, high{};
  double acceleration = 0, rotation = 0;
  std::int64_t base_ns = std::numeric_limits<std::int64_t>::min();
  for (auto agent = begin; agent != end; ++agent) {
    if (!agent->has_state) continue;
    const bool is_first = base_ns == std::numeric_limits<std::int64_t>::min();
    base_ns = std::max(base_ns, agent->stamp_ns);
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = is_first ? agent->p[i] : std::min(low[i], agent->p[i]);
      high[i] = is_first ? agent->p[i] : std::max(high[i], agent->p[i]);
    }
    acceleration = std::max(acceleration, Greatest(agent->a));
    rotation = std::max(rotation, Greatest(agent->w));
  }
  if (base_ns == std::numeric_limits<std::int64_t>::min()) base_ns = 0;
  std::array<double, 3> origin{}, half{};
  for (std::size_t i = 0; i < 3; ++i) {
    origin[i] = low[i] + (high[i] - low[i]) / 2;
    half[i] = high[i] - origin[i];
  }
  const double step = UnitOf(Greatest(half), kStepsMax);
  const double acceleration_unit = UnitOf(acceleration, kShortMax);
  const double rotation_unit = UnitOf(rotation, kShortMax);

  std::string bytes;
  bytes.reserve(64 + 64 * static_cast<std::size_t>(end - begin));
  Put(chunk * kStatesOfAChunk, &bytes);
  Put(static_cast<std::uint32_t>(end - begin), &bytes);
  Put(kSecondsOfNs * static_cast<double>(base_ns), &bytes);
  for (const double x : origin) Put(x, &bytes);
  for (const double unit : {step, acceleration_unit, rotation_unit}) Put(unit, &bytes);
  for (auto agent = begin; agent != end; ++agent) {
    std::uint32_t flags = 0;
    if (agent->has_state) flags |= kHasState;
    if (agent->not_clear) flags |= kNotClear;
    if (agent->saturated) flags |= kSaturated;
    if (agent->discontinuity) flags |= kDiscontinuity;
    Put(flags, &bytes);
    Put(Rounded<std::int32_t>(1e-3 * static_cast<double>(agent->stamp_ns - base_ns)), &bytes);
    for (std::size_t i = 0; i < 3; ++i) {
      Put(Rounded<std::int32_t>(agent->has_state ? (agent->p[i] - origin[i]) / step : 0), &bytes);
    }
    for (const double x : agent->v) Put(static_cast<float>(x), &bytes);
    for (const double x : agent->a) Put(Rounded<std::int16_t>(x / acceleration_unit), &bytes);
    for (const double x : agent->w) Put(Rounded<std::int16_t>(x / rotation_unit), &bytes);
    for (const double x : agent->q) Put(Rounded<std::int16_t>(x * kShortMax), &bytes);
    Put(static_cast<float>(agent->position_error), &bytes);
    Put(static_cast<float>(agent->velocity_error), &bytes);
    const double clear_s =
        kSecondsOfNs * (static_cast<double>(agent->clear_until_ns) - static_cast<double>(base_ns));
    Put(agent->is_promised ? static_cast<float>(clear_s) : -std::numeric_limits<float>::infinity(),
        &bytes);
  }
  return bytes;
}

}  // namespace collision::gateway
