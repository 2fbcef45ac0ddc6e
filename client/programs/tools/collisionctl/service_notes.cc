#include "client/programs/tools/collisionctl/service_notes.h"

#include <utility>

#include "idl/identity.h"

namespace collision::client {

std::optional<std::string> ServiceNotes::Take(bool present,
                                              const std::optional<v1::ServiceStatus>& status) {
  if (status) {
    const Sample sample{status->service_id(), status->stamp().term(), status->stamp().sequence()};
    const std::optional<Sample> before = std::exchange(heard_, sample);
    const bool is_another = before && std::get<0>(*before) != status->service_id();
    if (is_another) {
      gone_ = false;
      const auto name = [](const Sample& of) {
        return "service " + IdText(std::get<0>(of)) + ", term " + std::to_string(std::get<1>(of));
      };
      return "another service speaks: " + name(sample) + "; before, " + name(*before);
    }
    if (gone_ && present && before != sample) {
      gone_ = false;
      return "the service is back";
    }
  }
  if (present || gone_) return std::nullopt;
  gone_ = true;
  return "the service is gone; waiting for it";
}

}  // namespace collision::client
