// A greedy simulator: many agents with one mesh, all at one place.
#pragma once

#include <cstdint>
#include <string>

namespace collision::bench {

/// The process of the crowd, for ServiceProcess.
inline constexpr const char* kCrowd = "crowd";

/// More agents than that have as many pairs as the service tracks.
inline constexpr std::uint32_t kCrowdAgents = 363;

/// Flies the crowd until the process is ended: each agent swings about its place, so that each pair
/// overlaps, and sends 60 states a second.
void FlyCrowd(const std::string& world, std::uint32_t domain);

}  // namespace collision::bench
