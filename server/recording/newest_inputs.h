// What a service that joined now would hear from the network.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "idl/config.pb.h"
#include "idl/messages.pb.h"
#include "server/claim/service_claim.h"

namespace collision::server {

/// A simulator that the service has, and who speaks for it.
struct PresentSimulator {
  std::uint64_t sender = 0;
  std::uint32_t run = 0;
  bool is_alive = true;
  bool is_in_time = false;                               ///< Its clock counts.
  std::uint64_t states_seen = 0, descriptions_seen = 0;  ///< The highest sequences so far.
  std::uint64_t descriptions_sequence = 0;               ///< The highest of `agents`.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> agents = {};  ///< Slots, ascending, and
                                                                     ///< generations.
};

/// What the service knows between two steps that no input says again.
struct Opening {
  ClaimOptions claim;  ///< With which a replay goes on from here: it serves at once.
  bool serves = true;  ///< False: another service has the world, and no segment begins here.
  std::map<std::uint64_t, PresentSimulator> simulators = {};  ///< By id.
};

/// The bytes that the newest inputs of a world within its limits take at most: shapes, and a
/// description and a state of each agent.
std::uint64_t NewestBytesMax(const v1::Config& config);

/// The newest input of every key (idl/README.md), as transient-local writers keep it: hellos,
/// descriptions, parts of shapes, states, clocks, and which trees of shapes are used. With these,
/// and an Opening, a replay can begin at this moment.
///
/// Removals take what they remove. What the service has let go of without one (a simulator that was
/// evicted, whose run or epoch is over, or whose name went to another program), or has never taken,
/// leaves with Keep(). So that whoever writes ever-new keys takes no memory, that is due when what
/// is new since the last call takes more than all of it that the service had then, and
/// kNewBytes (wants_census()): it holds three times the world, and twice kNewBytes, at most. If the
/// call does not come, it is bounded by `bytes_max`, beyond which inputs are left out and counted,
/// with what was known of their keys. One thread.
class NewestInputs {
 public:
  /// `follows`: it will be taken by another one, of what came before, and so notes what is removed.
  explicit NewestInputs(std::uint64_t bytes_max, bool follows = false)
      : bytes_max_(bytes_max), follows_(follows) {}

  /// `serialised`: the input's bytes.
  void Take(const v1::Input& input, std::string serialised);

  /// Takes those of `later`, which follows it, in place of its own, and leaves `later` empty.
  void Take(NewestInputs* later);

  /// Forgets what the service does not have, but what has come since the last call of simulators
  /// that it does not know: their names may still come. A clock then names nothing that has
  /// arrived and is not kept: that is over, as a removal is, and will not come again.
  void Keep(const std::map<std::uint64_t, PresentSimulator>& present);

  /// Keep() is due.
  bool wants_census() const { return new_bytes_ > present_bytes_ + kNewBytes; }

  /// All but what VisitReady() visits, by simulator and kind: as inputs of one batch.
  void Visit(const std::function<void(const std::string& serialised)>& visit) const;

  /// The trees of shapes, for the batch behind that one.
  void VisitReady(const std::function<void(const std::string& serialised)>& visit) const;

  std::size_t size() const { return kept_.size(); }
  std::uint64_t bytes_max() const { return bytes_max_; }
  std::uint64_t bytes() const { return bytes_; }        ///< With kOverhead of each.
  std::uint64_t left_out() const { return left_out_; }  ///< Since the start.

  static constexpr std::uint64_t kOverhead = 200;
  static constexpr std::uint64_t kNewBytes = 4 << 20;

 private:
  enum class Kind { kHello, kDescription, kShape, kStates, kClock, kReady };

  /// Simulator, sender, kind, slot or chunk or number of a shape, its part, hash of a shape.
  using Key =
      std::tuple<std::uint64_t, std::uint64_t, Kind, std::uint32_t, std::uint32_t, std::string>;
  struct Kept {
    std::string serialised = {};
    std::uint32_t run = 0;
    std::uint32_t generation = 0;
    std::string shape = {};  ///< Of a part: its hash.
    std::uint64_t turn = 0;  ///< Calls of Keep() before it.
  };

  void Put(const Key& key, Kept kept);
  void Erase(const Key& key);
  bool IsPresent(const Key& key, const Kept& kept,
                 const std::map<std::uint64_t, PresentSimulator>& present) const;

  std::uint64_t bytes_max_;
  bool follows_;
  std::map<Key, Kept> kept_;
  std::set<Key> removed_;  ///< If it follows another one.
  std::uint64_t bytes_ = 0, left_out_ = 0, turn_ = 0;
  std::uint64_t new_bytes_ = 0;      ///< Came since the last Keep().
  std::uint64_t present_bytes_ = 0;  ///< Of what the service had then.
};

}  // namespace collision::server
