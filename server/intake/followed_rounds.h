// The rounds of a service that stands by: those of the service in force.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "idl/messages.pb.h"
#include "server/intake/intake.h"
#include "server/world/world.h"

namespace collision::server {

/// Stands before the Intake. A simulator cannot tell of a time that it has not been granted, so a
/// service that grants time never has states of a later round. One that stands by follows the
/// grants of another one, and may be behind: it keeps such states and clocks until it gets there,
/// and so finds what the other one finds. After a take-over it catches up. One thread.
class FollowedRounds {
 public:
  /// Beyond it nothing more is kept: rounds are judged together, which makes brackets wider.
  static constexpr std::size_t kKeptMax = 65536;
  static constexpr std::size_t kKeptBytesMax = 64 << 20;

  /// Both outlive this.
  FollowedRounds(World* world, Intake* intake) : world_(*world), intake_(*intake) {}

  /// The service stands by in this step.
  void StandBy();

  /// Applies the input, or keeps it.
  void Apply(const v1::Input& input);

  /// Applies what belongs to the present round by now, also what was kept of a simulator that does
  /// not end the round otherwise, since the clock with which it did was lost.
  void ApplyKept();

  /// Time begins anew.
  void Clear();

 private:
  Instant RoundEnd() const;
  bool IsOfLockStep(const v1::Input& input) const;
  void TakeRound();
  void TakeOut(const v1::Input& input);
  void TakeToClock(std::uint64_t simulator);

  World& world_;
  Intake& intake_;
  std::deque<v1::Input> kept_;
  std::size_t kept_bytes_ = 0;
  bool follows_ = false;
};

}  // namespace collision::server
