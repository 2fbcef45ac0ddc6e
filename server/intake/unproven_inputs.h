// Inputs of simulators that have not named themselves yet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "idl/messages.pb.h"

namespace collision::server {

inline constexpr std::size_t kUnprovenBytesMax = 64'000'000;  ///< Of all senders together.
inline constexpr std::size_t kUnprovenSendersMax = 256;       ///< Programs that wait.

/// What a smaller input counts as: so there are at most 16000.
inline constexpr std::size_t kUnprovenInputBytesMin = 4000;

/// How long an input waits for the name of its simulator [ns]. The network delivers topics in any
/// order, so a state may overtake the description of its agent.
inline constexpr std::int64_t kUnprovenTime = 30'000'000'000;

/// A waiting room. States and parts of shapes do not carry the name of their simulator, so their
/// sender proves nothing by its id. They wait here until the same sender writes a description or a
/// clock, which does, or until kUnprovenTime is over. At a standby, all that a successor writes
/// waits likewise until the former owner of its id is known to have ended.
///
/// If the room is full, the sender that takes the most bytes of it loses its oldest input, so that
/// one sender cannot crowd the others out. Pure bookkeeping: times are nanoseconds of the monotonic
/// clock. One thread.
class UnprovenInputs {
 public:
  /// Inputs of one sender for one simulator.
  struct Proved {
    std::vector<v1::Input> inputs;  ///< In the order of their arrival.
    std::uint64_t lost = 0;         ///< Inputs of the sender, for any simulator, that did not fit.
  };

  void Add(std::int64_t now_ns, std::uint64_t simulator_id, const v1::Input& input);

  /// The sender has named itself as this simulator: hands out what waits for that.
  [[nodiscard]] Proved Take(std::uint64_t simulator_id, std::uint64_t sender);

  /// The program has ended.
  void Forget(std::uint64_t sender);

  /// Drops what has waited for kUnprovenTime. Returns the number of inputs.
  std::uint64_t DropOverdue(std::int64_t now_ns);

  /// When DropOverdue() may next drop something; nullopt: nothing waits.
  std::optional<std::int64_t> NextDue() const;

  std::size_t size() const { return size_; }  ///< Inputs that wait.

  /// Inputs that did not fit, waited too long, or whose program ended.
  std::uint64_t dropped() const { return dropped_; }

 private:
  struct Waiting {
    std::int64_t arrived_ns = 0;
    std::uint64_t simulator_id = 0;
    std::size_t bytes = 0;
    v1::Input input;
  };
  struct Sender {
    std::deque<Waiting> waiting;  ///< In the order of their arrival.
    std::size_t bytes = 0;
    std::uint64_t lost = 0;
    std::int64_t newest_ns = 0;
  };

  void DropOldest(Sender* sender);

  std::map<std::uint64_t, Sender> senders_;  ///< With what they have lost, until that is overdue.
  std::size_t size_ = 0;
  std::size_t bytes_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace collision::server
