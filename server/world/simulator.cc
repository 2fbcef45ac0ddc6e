#include "server/world/simulator.h"

namespace collision::server {

void Simulator::StartRun(std::uint64_t sender, std::uint32_t run,
                         const std::optional<PendingClock>& former) {
  agents_.Clear();
  time_ = former ? SimulatorTime::After(time_, *former) : SimulatorTime();
  sender_clock_ = {};
  sender_ = sender;
  run_ = run;
  incarnation_ = 0;
  screening_sequence_ = 0;
  standing_.Clear();
  contenders_.Clear();
  ended_ = false;
  SetAlive(true, 0);
}

void Simulator::LeaveEpoch() {
  agents_.Clear();
  time_ = {};
  standing_.Clear();
}

void Simulator::Release(std::int64_t monotonic_ns) {
  released_ = true;
  released_since_ns_ = monotonic_ns;
}

void Simulator::End() {
  agents_.Clear();
  time_.ForgetFormer();
  ended_ = true;
}

void Simulator::RestartTime() {
  time_.Restart();
  agents_.clearances().MarkGrantChanged();
}

void Simulator::SetAlive(bool alive, std::int64_t monotonic_ns) {
  if (alive || alive_) silent_since_ns_ = monotonic_ns;
  alive_ = alive;
  doubted_until_ns_.reset();
  if (alive) released_ = false;
}

}  // namespace collision::server
