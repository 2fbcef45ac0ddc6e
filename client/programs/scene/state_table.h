// The newest states of all agents, packed for the page.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "idl/messages.pb.h"

namespace collision::client {

/// Agents by number: the place of a simulator's slot in this table, for as long as the program
/// runs. States that the service would refuse are not shown. One thread.
class StateTable {
 public:
  /// A chunk is sent as a whole when one of its agents has changed.
  static constexpr std::uint32_t kStatesOfAChunk = 512;
  static constexpr std::size_t kHeaderBytes = 8, kStateBytes = 96;
  static constexpr double kRateStepMax = 0x1p-10;  ///< Of velocities and the like [SI].

  /// Agents beyond it are not shown.
  static constexpr std::uint32_t kAgentsMax = 1 << 20;

  /// The number of this slot; nullopt: there are too many, or there is no such slot.
  std::optional<std::uint32_t> NumberOf(std::uint64_t simulator, std::uint32_t slot);

  /// Likewise, of a slot that has one.
  std::optional<std::uint32_t> Known(std::uint64_t simulator, std::uint32_t slot) const;

  void Take(const v1::AgentStates& states);
  void Take(const v1::Clearance& clearance);

  /// The agent has left: what is told of its number from now on is about another one.
  void Clear(std::uint64_t simulator, std::uint32_t slot);

  struct Agent {
    std::uint64_t simulator = 0;
    std::uint32_t slot = 0;
    std::uint32_t run = 0, generation = 0;  ///< Of the state.
    bool has_state = false;
    std::int64_t stamp_ns = 0;
    std::array<double, 3> p{}, v{}, a{}, w{};
    std::array<double, 4> q{1, 0, 0, 0};  ///< w x y z.
    double position_error = 0, velocity_error = 0;
    bool discontinuity = false, not_clear = false, saturated = false, is_promised = false;
    std::int64_t clear_until_ns = 0;
    std::uint64_t change = 0;  ///< The number of its newest.
  };

  /// By number.
  const std::vector<Agent>& agents() const { return agents_; }

  /// The chunks that have changed since the last call. Chunk `c` are the agents from
  /// c * kStatesOfAChunk on.
  std::vector<std::uint32_t> TakeChanged();

  /// A chunk as bytes; little-endian: u32 number of the first agent, u32 agents, then each in
  /// kStateBytes:
  ///   u32 flags (1 it has a state, 2 not clear, 4 saturated, 8 discontinuity), f32 clear until,
  ///   from the stamp on [s] (-inf: no promise), f64 stamp [s], f64 position x y z [m],
  ///   f32 velocity x y z [m/s], f32 acceleration x y z, f32 angular velocity x y z,
  ///   f32 error of the position [m], of the velocity [m/s], i16 orientation w x y z [1/32000],
  ///   u32 generation of the agent.
  /// Rounded to nearest: for eyes, not for proofs.
  std::string Pack(std::uint32_t chunk) const;

  /// All that have changed after the change `seen`, as bytes: for each agent u32 number, u32 0,
  /// then kStateBytes as above; of all these the first bytes, then the second ones, and so on:
  /// they compress to half. Numbers are rounded to multiples of `step`, a power of two [SI], those
  /// of motion of kRateStepMax at most; 0: as they are. Empty: none has changed.
  std::string PackAfter(std::uint64_t seen, double step = 0) const;

  /// The number of the newest change.
  std::uint64_t newest_change() const { return last_; }

 private:
  /// Numbers of neighbouring slots of a simulator; messages are about such.
  struct Page {
    static constexpr std::uint32_t kSlots = 64;
    static constexpr std::uint32_t kNone = ~0u;
    std::array<std::uint32_t, kSlots> numbers;
  };
  using PageKey = std::pair<std::uint64_t, std::uint32_t>;  ///< Simulator, slot / kSlots.

  /// Null: there is none.
  Page* FindPage(const PageKey& key) const;

  Agent* Find(std::uint64_t simulator, std::uint32_t slot);
  static void PackAgent(const Agent& agent, std::string* bytes);

  std::map<PageKey, std::unique_ptr<Page>> pages_;
  mutable std::pair<PageKey, Page*> last_page_{};  ///< That was found last.
  std::vector<Agent> agents_;
  std::vector<bool> changed_;  ///< By chunk.
  std::uint64_t last_ = 0;     ///< Number of the newest change.
};

}  // namespace collision::client
