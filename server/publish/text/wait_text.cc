#include "server/publish/text/wait_text.h"

#include <spdlog/fmt/fmt.h>

#include "idl/identity.h"

namespace collision::server {

std::string WaitText(const Awaited& awaited, const World& world) {
  switch (awaited.reason) {
    case WaitReason::kEnded: {
      // A live process that stands still for longer than its lease looks the same as one that
      // has ended.
      const auto found = world.simulators().find(SimulatorId(awaited.name));
      if (found == world.simulators().end()) break;
      const std::int64_t silent_ns = world.monotonic_ns() - found->second.silent_since_ns();
      return fmt::format("{}: not heard for more than {} s", awaited.name,
                         silent_ns / 1'000'000'000);
    }
    case WaitReason::kStands:
      return awaited.name + ": was granted time and has not made its next step";
    case WaitReason::kHasNoClock:
      return awaited.name + ": has started again, and no clock of it has been accepted yet";
    case WaitReason::kDoesNotFollowYet:
      return awaited.name + ": has not heard this service yet (it has just begun to serve)";
    case WaitReason::kMissing:
      return awaited.name + ": not back since the service started again";
  }
  return awaited.name + ": not heard";
}

}  // namespace collision::server
