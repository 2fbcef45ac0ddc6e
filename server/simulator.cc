#include "server/simulator.h"

#include <algorithm>

namespace collision::server {

void Simulator::OfferClock(const PendingClock& offered) {
  told = std::max(told, offered.clock);
  lock_step = offered.lock_step;
  if (pending.size() == kPendingClocksMax) pending.pop_back();
  pending.push_back(offered);
}

bool Simulator::TakeClock() {
  bool taken = false;
  while (!pending.empty() && pending.front().states_sequence <= states_seen &&
         pending.front().descriptions_sequence <= descriptions_seen) {
    clock = pending.front().clock;
    pending.pop_front();
    taken = true;
  }
  return taken;
}

void Simulator::StartRun(std::uint64_t new_sender, std::uint32_t new_run) {
  for (const auto& [slot, state] : slots) chunks_changed.insert(slot / kSlotsPerChunk);
  Simulator fresh;
  fresh.id = id;
  fresh.sender = new_sender;
  fresh.run = new_run;
  fresh.name = std::move(name);
  fresh.chunks_changed = std::move(chunks_changed);
  fresh.held = std::move(held);
  fresh.states = states;
  fresh.rejected = rejected;
  *this = std::move(fresh);
}

}  // namespace collision::server
