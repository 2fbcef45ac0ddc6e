#include "server/world/clearances.h"

#include <utility>

namespace collision::server {

void Clearances::Set(std::uint32_t slot, const detection::AgentClearance& clearance) {
  clearances_.insert_or_assign(slot, clearance);
  MarkChanged(slot);
}

void Clearances::Forget(std::uint32_t slot) {
  clearances_.erase(slot);
  MarkChanged(slot);
}

std::set<std::uint32_t> Clearances::TakeChanged() { return std::exchange(changed_, {}); }

}  // namespace collision::server
