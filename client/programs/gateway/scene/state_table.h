// The newest states of all agents, packed for the page.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "idl/messages.pb.h"

namespace collision::gateway {

/// Agents by number: the place of a simulator's slot in this table, for as long as the program
/// runs. One thread.
class StateTable {
 public:
  /// A chunk is sent as a whole when one of its agents has changed.
  static constexpr std::uint32_t kStatesOfAChunk = 512;

  /// Agents beyond it are not shown.
  static constexpr std::uint32_t kAgentsMax = 1 << 20;

  /// The number of this slot; nullopt: there are too many.
  std::optional<std::uint32_t> NumberOf(std::uint64_t simulator, std::uint32_t slot);

  void Take(const v1::AgentStates& states);
  void Take(const v1::Clearance& clearance);

  /// The agent has left: what is told of its number from now on is about another one.
  void Clear(std::uint64_t simulator, std::uint32_t slot);

  /// The agents from number * kStatesOfAChunk on, as bytes; little-endian:
  ///   u32 number of the first agent, u32 agents, f64 base time [s], f64 origin x y z [m],
  ///   f64 step of a position [m], f64 unit of accelerations [m/s²], of angular velocities [rad/s];
  /// then each agent in 64 bytes:
  ///   u32 flags (1 it has a state, 2 not clear, 4 saturated, 8 discontinuity),
  ///   i32 stamp from the base time on [µs], i32 position x y z from the origin on [steps],
  ///   f32 velocity x y z [m/s], i16 acceleration x y z, i16 angular velocity x y z [units],
  ///   i16 orientation w x y z [1/32000], f32 error of the position [m], of the velocity [m/s],
  ///   f32 clear until, from the base time on [s]; -inf: no promise.
  /// Rounded to nearest: for eyes, not for proofs.
  struct Chunk {
    std::uint32_t number = 0;
    std::string bytes;
  };

  /// Packs all chunks that have changed since the last call.
  std::vector<Chunk> TakeChanged();

 private:
  struct Agent {
    std::uint32_t run = 0, generation = 0;  ///< Of the state.
    bool has_state = false;
    std::int64_t stamp_ns = 0;
    std::array<double, 3> p{}, v{}, a{}, w{};
    std::array<double, 4> q{1, 0, 0, 0};
    double position_error = 0, velocity_error = 0;
    bool discontinuity = false, not_clear = false, saturated = false, is_promised = false;
    std::int64_t clear_until_ns = 0;
  };

  struct Slot {
    std::uint64_t simulator = 0;
    std::uint32_t slot = 0;
    friend bool operator==(const Slot&, const Slot&) = default;
  };
  struct SlotHash {
    std::size_t operator()(const Slot& key) const {
      return std::hash<std::uint64_t>()(key.simulator ^ (key.slot * 0x9e3779b97f4a7c15ull));
    }
  };

  Agent* Find(std::uint64_t simulator, std::uint32_t slot);
  void MarkChanged(std::uint32_t number);
  std::string Pack(std::uint32_t chunk) const;

  std::unordered_map<Slot, std::uint32_t, SlotHash> numbers_;
  std::vector<Agent> agents_;
  std::vector<bool> changed_;  ///< By chunk.
};

}  // namespace collision::gateway
