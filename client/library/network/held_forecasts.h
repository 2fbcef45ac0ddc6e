// Forecasts that wait for the step at which they are told.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "collision/types.h"
#include "idl/messages.pb.h"

namespace collision::client {

/// Lock-step: which revisions of a forecast arrive, and when, is a matter of the network: only the
/// newest of a pair is sure to come. So forecasts are told when the simulator takes a step or
/// polls, of each pair and level the newest. One thread; depends on nothing but the calls.
class HeldForecasts {
 public:
  /// A forecast about anybody's agents has come.
  void Hear(const v1::CollisionEvent& event) {
    newest_ = std::max(newest_, event.stamp().sequence());
  }

  /// It is about this simulator's agents: keeps it in place of an older one of its pair.
  void Hold(const v1::CollisionEvent& event);

  /// The highest stamp.sequence of a forecast that has come. The network keeps their order, so no
  /// lower one comes any more.
  std::uint64_t newest() const { return newest_; }

  /// Hands out what is held, in the order in which it was published.
  [[nodiscard]] std::vector<v1::CollisionEvent> Take();

 private:
  std::uint64_t newest_ = 0;
  /// By pair and level.
  std::map<std::tuple<AgentId, AgentId, std::string>, v1::CollisionEvent> by_pair_;
};

}  // namespace collision::client
