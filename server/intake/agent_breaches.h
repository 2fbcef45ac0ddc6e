// What agents broke of what they declared: told to their owners, and logged.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "server/detectors/detectors.h"
#include "server/world/world.h"

namespace collision::server {

/// An agent is told of at most once in this period of the monotonic clock.
inline constexpr std::int64_t kBreachPeriodNs = 1'000'000'000;

/// Agents that are told of in a period: of all simulators, and of one. Each costs a search for the
/// bound that it broke; so a simulator that breaks everything at each step neither slows down the
/// others nor floods the network.
inline constexpr std::size_t kBreachesToldMax = 256;
inline constexpr std::size_t kBreachesOfOneToldMax = 64;

/// Keeps the messages about breaches until they are published. The first breach of an agent in a
/// period is explained and told at once; later ones are counted, and the last count is told when
/// the period is over. Beyond the limits an agent is told of with its next breach. One thread.
class AgentBreaches {
 public:
  /// Both outlive this.
  AgentBreaches(const World* world, const Detectors* detectors)
      : world_(*world), detectors_(*detectors) {}

  /// The detectors have just answered kBreached for this agent, for the `count`-th time.
  void Add(const Simulator& simulator, const detection::AgentId& agent, std::uint64_t count);

  /// The messages since the last call, without stamps.
  [[nodiscard]] std::vector<v1::AgentBreach> Take();

  /// When Take() may next have something without another Add().
  std::optional<std::int64_t> NextDue() const;

 private:
  struct Told {
    v1::AgentBreach message;
    std::uint64_t count = 0;  ///< The newest; told so far: that of the message.
  };

  /// Ends the period if it is over: what was only counted in it becomes due.
  void EndPeriod();
  bool MayTell(std::uint64_t simulator) const;
  v1::AgentBreach MessageOf(const Simulator& simulator, const detection::AgentId& agent,
                            std::uint64_t count) const;

  const World& world_;
  const Detectors& detectors_;
  std::int64_t period_ = -1;  ///< Number of the one that `told_` is of.
  std::map<std::pair<std::uint64_t, std::uint32_t>, Told> told_;  ///< By simulator and slot.
  std::map<std::uint64_t, std::size_t> told_of_;                  ///< How many, by simulator.
  bool is_behind_ = false;                                        ///< A count has not been told.
  std::vector<v1::AgentBreach> due_;
};

}  // namespace collision::server
