// The rounds of a service that stands by: those of the service in force.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>

#include "idl/messages.pb.h"
#include "server/intake/intake.h"
#include "server/world/world.h"

namespace collision::server {

/// Stands before the Intake. A simulator cannot tell of a time that it has not been granted, so a
/// service that grants time never has states of a later round. One that stands by follows the
/// grants of another one, and may be behind: it keeps such states and clocks until it gets there,
/// with the descriptions and removals of agents that follow them, and so finds what the other one
/// finds. After a take-over it catches up. One thread.
class FollowedRounds {
 public:
  /// Beyond it nothing more is kept: rounds are judged together, which makes brackets wider.
  static constexpr std::size_t kKeptMax = 65536;
  static constexpr std::size_t kKeptBytesMax = 64 << 20;

  /// Likewise of one simulator, whose messages may be of times that never come.
  static constexpr std::size_t kKeptOfOneMax = kKeptMax / 8;
  static constexpr std::size_t kKeptBytesOfOneMax = kKeptBytesMax / 8;

  /// Both outlive this.
  FollowedRounds(World* world, Intake* intake) : world_(*world), intake_(*intake) {}

  /// The service stands by in this step.
  void StandBy();

  /// Applies the input, or keeps it.
  void Apply(const v1::Input& input);

  /// Applies what belongs to the present round by now, also what was kept of a simulator that does
  /// not end the round otherwise, since the clock with which it did was lost.
  void ApplyKept();

  /// World::SucceedsLast() of this input's sender, once all that has arrived before it counts.
  bool SucceedsLast(const v1::Input& input);

  /// Time begins anew.
  void Clear();

 private:
  struct KeptInput {
    Instant time;  ///< It is of the round that this is in.
    v1::Input input;
  };
  /// Of one simulator, in the order in which they arrived.
  struct Kept {
    std::deque<KeptInput> inputs;
    std::size_t bytes = 0;
    Instant first = Instant::Never();  ///< No input is of an earlier time.
  };

  Instant RoundEnd() const;
  Instant TimeOf(const v1::Input& input) const;
  Simulator* FindFollower(const v1::Input& input);
  bool Keep(std::uint64_t simulator, Instant time, const v1::Input& input);
  void TakeRound();
  void TakeToClock(std::uint64_t simulator);
  template <typename Predicate>
  void Take(Kept* kept, const Predicate& is_taken);

  World& world_;
  Intake& intake_;
  std::map<std::uint64_t, Kept> kept_;  ///< By simulator; none is empty.
  std::size_t count_ = 0, bytes_ = 0;   ///< Of all.
  bool follows_ = false;
};

}  // namespace collision::server
