// What each simulator may have of the limits of the world.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "collision_core/base/shared_limit.h"
#include "idl/config.pb.h"

namespace collision::server {

/// What simulators share. Tracked pairs are shared out by the detector (Detector::SetPairShare()).
enum class Resource { kAgents, kPairs, kShapes, kShapeBytes, kTreeBytes, kRejections };
inline constexpr std::size_t kResources = 6;

/// "agents", as in the name of the limit.
const char* Name(Resource resource);

/// The limit of the whole world.
std::uint64_t LimitOf(const v1::Config& config, Resource resource);

/// The part of the simulator of this name: what the first block of `limits` that fits the name
/// says, otherwise all of the limit, with limit / (simulators_max + 1) guaranteed.
Share ShareOf(const v1::Config& config, const std::string& name, Resource resource);

/// The simulators that blocks of `limits` name without `*`.
std::set<std::uint64_t> ExpectedIds(const v1::Config& config);

/// Shares the limits of the world out among its simulators (SharedLimit): a simulator may have what
/// is free, less what the other simulators of the world have not used of what they are guaranteed.
/// A simulator that a block of `limits` names without `*` counts as one of the world from the
/// start. What several simulators use together counts for each of them. One thread.
class SimulatorQuotas {
 public:
  explicit SimulatorQuotas(const v1::Config& config);

  /// The simulator is one of the world.
  void Enter(std::uint64_t id, const std::string& name);

  /// Those for which `is_there` says no are simulators of the world no more. They still use what
  /// they have not given back.
  void Keep(const std::function<bool(std::uint64_t id)>& is_there);

  /// How much the simulator may still have, if the world has room for `free`.
  std::uint64_t RoomFor(std::uint64_t id, Resource resource, std::uint64_t free) const;

  void Take(std::uint64_t id, Resource resource, std::uint64_t amount);

  /// Requires that the simulator has taken as much.
  void GiveBack(std::uint64_t id, Resource resource, std::uint64_t amount);

  std::uint64_t Used(std::uint64_t id, Resource resource) const;

  /// The part of a simulator of the world.
  Share ShareOf(std::uint64_t id, Resource resource) const;

 private:
  using Limit = SharedLimit<std::uint64_t>;

  const Limit& Of(Resource resource) const { return limits_[static_cast<std::size_t>(resource)]; }
  Limit& Of(Resource resource) { return limits_[static_cast<std::size_t>(resource)]; }

  const v1::Config config_;
  std::array<Limit, kResources> limits_;
  std::map<std::uint64_t, bool> present_;  ///< By id; whether it stays so although it has left.
};

}  // namespace collision::server
