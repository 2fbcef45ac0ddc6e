#include "client/library/network/clearance_gate.h"

#include <algorithm>
#include <utility>

namespace collision::client {

void ClearanceGate::Add(const v1::Clearance& clearance, Time now) {
  waiting_.push_back({clearance, now});
}

std::vector<v1::Clearance> ClearanceGate::Take(ContactSequence* contacts, const Newest& newest,
                                               Time now) {
  std::vector<v1::Clearance> passed;
  while (!waiting_.empty()) {
    auto& [clearance, since] = waiting_.front();
    const bool overdue = now - since >= patience_ || waiting_.size() > kWaitingMax;
    if (overdue) contacts->GiveUp(clearance.contacts_sequence());
    if (!contacts->HasAll(clearance.contacts_sequence())) break;
    const bool has_forecasts = clearance.forecasts_sequence() <= newest.forecast &&
                               clearance.screening_sequence() <= newest.screening;
    if (!overdue && !has_forecasts) break;
    passed.push_back(std::move(clearance));
    waiting_.pop_front();
  }
  return passed;
}

std::optional<std::chrono::nanoseconds> ClearanceGate::Remaining(Time now) const {
  if (waiting_.empty()) return std::nullopt;
  return std::max<std::chrono::nanoseconds>(waiting_.front().since + patience_ - now,
                                            std::chrono::nanoseconds(0));
}

}  // namespace collision::client
