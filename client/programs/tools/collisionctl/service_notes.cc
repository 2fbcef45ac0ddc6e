#include "client/programs/tools/collisionctl/service_notes.h"

#include <utility>

namespace collision::client {

std::optional<std::string> ServiceNotes::Take(bool present,
                                              const std::optional<v1::ServiceStatus>& status) {
  if (status) {
    const Sample sample{status->service_id(), status->stamp().term(), status->stamp().sequence()};
    const std::optional<Sample> before = std::exchange(heard_, sample);
    const bool is_another = before && std::get<0>(*before) != status->service_id();
    if (is_another) {
      gone_ = false;
      return "another service speaks: id " + std::to_string(status->service_id()) + ", term " +
             std::to_string(status->stamp().term()) + "; before, id " +
             std::to_string(std::get<0>(*before)) + ", term " +
             std::to_string(std::get<1>(*before));
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
