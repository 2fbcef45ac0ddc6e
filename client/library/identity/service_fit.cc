#include "client/library/identity/service_fit.h"

#include <utility>

#include "client/library/identity/library_version.h"
#include "idl/limits.h"

namespace collision::client {
namespace {

const char* KindText(bool lock_step) { return lock_step ? "lock-step" : "real time"; }

}  // namespace

v1::SimulatorHello HelloOf(const OwnFacts& own, std::uint64_t simulator_id,
                           std::uint32_t incarnation) {
  v1::SimulatorHello hello;
  hello.set_simulator_id(simulator_id);
  hello.set_incarnation(incarnation);
  hello.set_wire_revision(wire::kWireRevision);
  hello.set_clock_kind(own.lock_step ? v1::CLOCK_LOCK_STEP : v1::CLOCK_REAL_TIME);
  hello.set_simulator_name(own.simulator);
  hello.set_frame(own.frame);
  hello.set_version(LibraryVersion());
  return hello;
}

std::optional<Rejection> ServiceFit::Compare(const v1::ServiceHello& hello) const {
  Rejection rejection;
  rejection.reason = v1::RejectionReason_Name(v1::REJECTED_MISMATCH);
  rejection.topic = v1::InputTopic_Name(v1::TOPIC_SIMULATOR_HELLO);
  const auto refuse = [&rejection](const char* field, std::string detail) {
    rejection.field = field;
    rejection.detail = std::move(detail);
    return rejection;
  };
  if (hello.wire_revision() != wire::kWireRevision) {
    return refuse("wire_revision", std::to_string(wire::kWireRevision) + "; the service (version " +
                                       hello.version() + ") has " +
                                       std::to_string(hello.wire_revision()) +
                                       ": use one version for both");
  }
  const bool lock_step = hello.clock_kind() == v1::CLOCK_LOCK_STEP;
  if (lock_step != own_.lock_step) {
    return refuse("clock_kind", std::string(KindText(own_.lock_step)) + "; the world runs in " +
                                    KindText(lock_step) +
                                    ": start the simulator likewise, or the service otherwise");
  }
  if (!own_.frame.empty() && !hello.frame().empty() && own_.frame != hello.frame()) {
    return refuse("frame", "\"" + own_.frame + "\"; the world has \"" + hello.frame() + "\"");
  }
  return std::nullopt;
}

std::optional<Rejection> ServiceFit::Hear(const v1::ServiceHello& hello) {
  const std::uint64_t id = hello.service_id();
  if (regions_.size() >= kServicesMax && !regions_.contains(id)) regions_.erase(regions_.begin());
  regions_[id].assign(hello.regions().begin(), hello.regions().end());
  const std::optional<Rejection> rejection = Compare(hello);
  if (!rejection) {
    unfit_.erase(id);
    return std::nullopt;
  }
  if (unfit_.size() >= kServicesMax && !unfit_.contains(id)) unfit_.erase(unfit_.begin());
  if (!unfit_.insert_or_assign(id, *rejection).second) return std::nullopt;
  return rejection;
}

std::vector<Rejection> ServiceFit::Unfit() const {
  std::vector<Rejection> all;
  for (const auto& [id, rejection] : unfit_) all.push_back(rejection);
  return all;
}

std::string ServiceFit::Text() const {
  if (unfit_.empty()) return "";
  const Rejection& rejection = unfit_.begin()->second;
  return "\"" + own_.simulator + "\" does not fit the service: " + rejection.field + " " +
         rejection.detail;
}

const std::vector<std::uint32_t>& ServiceFit::RegionsOf(std::uint64_t service_id) const {
  static const std::vector<std::uint32_t> none;
  const auto found = regions_.find(service_id);
  return found != regions_.end() ? found->second : none;
}

}  // namespace collision::client
