// A level of the configuration: how near is worth telling.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "collision_core/broad_phase/collision_filter.h"
#include "collision_core/detection/events/collision_event.h"
#include "idl/config.pb.h"

namespace collision::server {

/// Two agents cross a level where they come within its margin of each other. SI units.
struct Level {
  std::string name;
  double margin = 0;      ///< Beside the margins of the agents themselves [m], > 0.
  double look_ahead = 0;  ///< A crossing that is possible within this is announced [s].
  double hysteresis = 0;  ///< How much farther apart a pair gets before it is told again [m].
  v1::Level::Basis basis = v1::Level::POSSIBLE;
  /// For each group of agents those that it is watched with, both as in CollisionFilter.
  std::map<std::uint32_t, std::uint32_t> partners = {};
  bool between_all = true;  ///< In place of `partners`: all that can meet are watched.

  /// The filter of an agent in this level, given its own: it is watched with those that it can meet
  /// and that the level names.
  broad_phase::CollisionFilter FilterOf(broad_phase::CollisionFilter own) const;

  /// Whether a revision is worth telling, by the level's basis.
  bool Tells(const detection::CollisionEvent& event) const;
};

/// The levels in their order. Requires a complete and valid configuration.
std::vector<Level> LevelsOf(const v1::Config& config);

}  // namespace collision::server
