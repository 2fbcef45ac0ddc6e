#include "server/world/rejections.h"

#include <spdlog/fmt/fmt.h>

#include <utility>

#include "idl/identity.h"
#include "server/process/logging.h"

namespace collision::server {

std::uint64_t Rejections::CountOne(const Refusal& refusal) {
  ++counts_[static_cast<std::size_t>(refusal.reason)];
  Simulator* simulator = world_.Find(refusal.simulator_id);
  return simulator != nullptr ? simulator->CountRefusal() : ++of_unknown_;
}

bool Rejections::MayTell(std::uint64_t simulator_id) {
  SimulatorQuotas& quotas = world_.quotas();
  const std::int64_t second = world_.monotonic_ns() / 1'000'000'000;
  if (std::exchange(second_, second) != second) {
    for (const auto& [id, told] : std::exchange(told_to_, {})) {
      quotas.GiveBack(id, Resource::kRejections, told);
    }
    told_in_second_ = 0;
  }
  const std::uint64_t free = per_second_max_ - told_in_second_;
  if (quotas.RoomFor(simulator_id, Resource::kRejections, free) == 0) return false;
  quotas.Take(simulator_id, Resource::kRejections, 1);
  ++told_to_[simulator_id];
  ++told_in_second_;
  return true;
}

void Rejections::Count(const Refusal& refusal) {
  CountOne(refusal);
  ++suppressed_;
}

void Rejections::Add(const Refusal& refusal) {
  const std::uint64_t count = CountOne(refusal);
  Simulator* simulator = world_.Find(refusal.simulator_id);
  const bool stands = simulator != nullptr && StandingRefusals::Stands(refusal.reason);
  if (stands) simulator->refusals().Add(refusal);
  const std::string& reason = v1::RejectionReason_Name(refusal.reason);
  LogAbout(
      spdlog::level::warn, "input refused", simulator ? simulator->name() : "",
      fmt::format("{} simulator {} \"{}\" run {} slot {} generation {}: {}: {}", reason,
                  IdText(refusal.simulator_id), simulator ? simulator->name() : "", refusal.run,
                  refusal.slot, refusal.generation, refusal.field, refusal.detail));
  if (!MayTell(refusal.simulator_id)) {
    ++suppressed_;
    return;
  }
  v1::Rejection& wire = pending_.emplace_back();
  wire.set_simulator_id(refusal.simulator_id);
  wire.set_now_ns(world_.now().nanoseconds());
  wire.set_run(refusal.run);
  wire.set_run_in_force(simulator != nullptr ? simulator->run() : 0);
  wire.set_reason(refusal.reason);
  wire.set_topic(refusal.topic);
  wire.set_slot(refusal.slot);
  wire.set_generation(refusal.generation);
  wire.set_field(refusal.field);
  wire.set_detail(refusal.detail);
  wire.set_count(count);
  wire.set_incarnation(stands ? simulator->incarnation() : refusal.incarnation);
}

std::vector<v1::Rejection> Rejections::Take() { return std::exchange(pending_, {}); }

}  // namespace collision::server
