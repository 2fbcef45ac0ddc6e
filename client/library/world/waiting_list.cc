#include "client/library/world/waiting_list.h"

#include <algorithm>

#include "idl/limits.h"

namespace collision::client {

void WaitingList::Take(const v1::ServiceStatus& status) {
  names_.clear();
  TakeLaggard(status);
  for (const v1::KeyValue& extension : status.extensions()) {
    if (extension.key() != "waiting_for") continue;
    const std::string& text = extension.value();
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find(", ", begin), text.size());
      const std::string name = text.substr(begin, end - begin);
      // How many do not fit is no name: "+7 more". A shape is "shape 1a2b3c4d", and how many must
      // come before time begins "simulators to come: 1".
      const bool is_other = name.starts_with("shape ") || name.starts_with("simulators to come: ");
      if (wire::IsName(name) || is_other) names_.push_back(name);
      begin = end + 2;
    }
  }
}

void WaitingList::TakeLaggard(const v1::ServiceStatus& status) {
  laggard_.reset();
  for (const v1::SimulatorStatus& simulator : status.simulators()) {
    if (simulator.simulator_id() == simulator_id_) continue;
    if (laggard_ && laggard_->clock_ns <= simulator.clock_ns()) continue;
    laggard_ = {simulator.name(), simulator.clock_ns()};
  }
}

bool WaitingList::TakeChange() {
  if (names_ == told_) return false;
  told_ = names_;
  return true;
}

}  // namespace collision::client
