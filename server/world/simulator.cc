#include "server/world/simulator.h"

namespace collision::server {

void Simulator::StartRun(std::uint64_t sender, std::uint32_t run) {
  agents_.Clear();
  time_ = {};
  sender_clock_ = {};
  sender_ = sender;
  run_ = run;
  SetAlive(true, 0);
  succeeded_unheard_ = false;
}

void Simulator::LeaveEpoch() {
  agents_.Clear();
  time_ = {};
}

void Simulator::RestartTime() {
  time_.Restart();
  agents_.clearances().MarkGrantChanged();
}

void Simulator::SetAlive(bool alive, std::int64_t monotonic_ns) {
  alive_ = alive;
  silent_since_ns_ = monotonic_ns;
  if (alive) released_ = false;
}

}  // namespace collision::server
