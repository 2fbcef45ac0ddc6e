#include "server/codec/hello.h"

#include <cmath>
#include <string>

#include "idl/hello_extensions.h"
#include "idl/identity.h"
#include "idl/limits.h"
#include "server/codec/field_check.h"

namespace collision::server {
namespace {

constexpr double kNanoseconds = 1e9;  // in a second

std::string ClockDetail(bool lock_step) {
  return lock_step ? "CLOCK_REAL_TIME; this world runs on simulated time: start the simulator in "
                     "lock-step, or the service with clock kind REAL_TIME"
                   : "CLOCK_LOCK_STEP; this world runs on the wall clock: start the simulator "
                     "without lock-step, or the service with clock kind LOCK_STEP";
}

void Extend(const std::string& key, const std::string& value, v1::ServiceHello* hello) {
  v1::KeyValue& extension = *hello->add_extensions();
  extension.set_key(key);
  extension.set_value(value);
}

/// All classes, if there is room for them.
void AddClasses(const v1::Config& config, v1::ServiceHello* hello) {
  if (config.classes_size() > wire::kHelloExtensionsMax - hello->extensions_size()) return;
  const v1::ServiceHello without = *hello;
  for (const v1::AgentClass& one : config.classes()) {
    std::string met;
    for (const std::string& name : one.meets()) met += (met.empty() ? "" : " ") + name;
    if (met.size() > wire::kExtensionValueMax) {
      *hello = without;
      return;
    }
    Extend(std::string(wire::kClassExtension) + one.name(), met, hello);
  }
}

/// The names of all levels, if there is room for them.
void AddLevels(const v1::Config& config, v1::ServiceHello* hello) {
  std::string names;
  for (const v1::Level& level : config.levels()) {
    names += (names.empty() ? "" : " ") + level.name();
  }
  const bool fits = hello->extensions_size() < wire::kHelloExtensionsMax &&
                    names.size() <= wire::kExtensionValueMax;
  if (fits) Extend(std::string(wire::kLevelsExtension), names, hello);
}

}  // namespace

v1::ServiceHello HelloOf(const v1::Config& config) {
  v1::ServiceHello hello;
  hello.set_wire_revision(wire::kWireRevision);
  hello.set_clock_kind(config.clock().kind() == v1::Clock::REAL_TIME ? v1::CLOCK_REAL_TIME
                                                                     : v1::CLOCK_LOCK_STEP);
  hello.set_skew_max_ns(std::llround(config.clock().skew_max_s() * kNanoseconds));
  hello.set_world(config.world().substr(0, wire::kNameMax));
  hello.set_frame(config.frame());
  hello.set_epoch_utc(config.epoch_utc());
  hello.add_regions(hello.region());
  Extend(std::string(wire::kExcludedExtension), std::to_string(config.excluded_size()), &hello);
  AddClasses(config, &hello);
  AddLevels(config, &hello);
  return hello;
}

std::optional<Refusal> CheckHello(const v1::SimulatorHello& hello,
                                  const v1::ServiceHello& service) {
  Refusal refusal{.reason = v1::REJECTED_MISMATCH,
                  .topic = v1::TOPIC_SIMULATOR_HELLO,
                  .simulator_id = hello.simulator_id(),
                  .incarnation = hello.incarnation()};
  const auto refuse = [&refusal](const char* field, std::string detail) {
    refusal.field = field;
    refusal.detail = std::move(detail);
    return refusal;
  };
  if (hello.wire_revision() != service.wire_revision()) {
    return refuse("wire_revision", std::to_string(hello.wire_revision()) +
                                       "; allowed: " + std::to_string(service.wire_revision()) +
                                       ", that of the service: use one version for both");
  }
  FieldCheck check(refusal);
  CheckSimulatorName(hello.simulator_name(), &check);
  check.Text("frame", hello.frame(), wire::kNameMax);
  if (!check.passed()) return check.refusal();
  if (hello.simulator_id() != SimulatorId(hello.simulator_name())) {
    refusal.reason = v1::REJECTED_ID_MISMATCH;
    return refuse("simulator_id", std::to_string(hello.simulator_id()) + "; its name has " +
                                      std::to_string(SimulatorId(hello.simulator_name())));
  }
  if (hello.clock_kind() != service.clock_kind()) {
    return refuse("clock_kind", ClockDetail(service.clock_kind() == v1::CLOCK_LOCK_STEP));
  }
  const bool both = !hello.frame().empty() && !service.frame().empty();
  if (both && hello.frame() != service.frame()) {
    return refuse("frame", "\"" + hello.frame() + "\"; allowed: \"" + service.frame() +
                               "\", the frame of the world, or none");
  }
  return std::nullopt;
}

}  // namespace collision::server
