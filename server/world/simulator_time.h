// The clocks of one simulator: which have arrived, which is in force, and how far it may go.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "collision_core/base/instant.h"

namespace collision::server {

/// What a clock tells: all before its `next`, or up to itself. Never(): no step follows.
Instant ToldUntil(Instant clock, const std::optional<Instant>& next);

/// A clock, and what its simulator had written before it.
struct PendingClock {
  Instant clock;
  /// It has nothing more to tell of any time before this one; nullopt: it does not say.
  std::optional<Instant> next = {};
  std::uint64_t states_sequence = 0;        ///< Highest sequence of its states by then.
  std::uint64_t descriptions_sequence = 0;  ///< Likewise of its descriptions.
  bool lock_step = false;                   ///< The simulator waits for grants.
  std::uint64_t agents = 0;                 ///< How many it had described.
};

/// A simulator's clocks arrive in order, so only a few overtake their states. Beyond this many the
/// newest replaces the last, which makes time coarser and nothing else.
inline constexpr std::size_t kPendingClocksMax = 16;

/// The time of one simulator in one run.
///
/// A clock comes into force when the states and descriptions that were written before it have
/// arrived. The highest sequence seen decides: a keep-last-1 sample may have been overwritten by a
/// newer one, and refused samples count as arrived, so that no clock waits for ever. One thread.
class SimulatorTime {
 public:
  SimulatorTime() = default;

  /// Of a run that follows one with this time, which the world waited for: it stands at `stands_at`
  /// until it has told a clock of its own.
  static SimulatorTime After(const SimulatorTime& former, const PendingClock& stands_at);

  void RecordStates(std::uint64_t sequence);
  void RecordDescriptions(std::uint64_t sequence);

  /// At the end of a batch: how many agents are described, and how many descriptions are refused.
  /// If that is what the newest clock names, all descriptions up to its sequence have arrived.
  void TakeCensus(std::uint64_t described, std::uint64_t refused);

  std::uint64_t states_seen() const { return states_seen_; }              ///< The highest sequence.
  std::uint64_t descriptions_seen() const { return descriptions_seen_; }  ///< Likewise.
  /// Up to this sequence every description and removal has arrived.
  std::uint64_t descriptions_arrived() const { return descriptions_arrived_; }
  /// The clock in force was written after every description and removal that has arrived, so all
  /// states that were written before them have arrived, too.
  bool is_settled() const { return descriptions_told_ >= descriptions_seen_; }

  /// A clock that tells no time yet has arrived: that the simulator is there, and what it has
  /// described.
  void TellPresence(std::uint64_t descriptions_sequence, std::uint32_t agents);

  /// A clock has arrived, of which told_until() will be `until`. It may be taken in a later round
  /// (FollowedRounds).
  void Hear(Instant clock, Instant until) {
    heard_ = std::max(heard_, clock);
    heard_until_ = std::max(heard_until_, until);
  }

  /// Takes a clock that has arrived; Take() brings it into force.
  void Offer(const PendingClock& offered);

  /// It has asked what time it is. In place of its first clock: it has told everything of any time
  /// before `at`, and is granted that time. Or no step of it follows.
  void Join(Instant at, bool finishes);

  /// Its first clock was an answer to Join(), not one of its own.
  bool joined() const { return joined_; }
  /// And it has told none of its own yet.
  bool awaits_own_clock() const { return awaits_own_clock_; }

  /// The simulator has published a clock of the other kind (simulated or wall) and none of this
  /// world's: its stamps mean nothing here until it offers one.
  void SetOtherKind() { other_kind_ = true; }

  /// Brings into force the newest clock before which everything has arrived. False: there is none.
  bool Take();

  /// Extends the grant to `until`; one that was published is never shortened. True if it has
  /// changed.
  bool Grant(Instant until);

  /// Shortens the grant, which nobody was told, to `until`.
  void LowerGrant(Instant until) {
    if (granted_) granted_ = std::min(*granted_, until);
  }

  /// All that its simulator has to tell up to and including this time has arrived: the time before
  /// its next step or, where it does not say when that is, its clock. Never(): no step follows.
  /// Always() without a clock. Before the first clock of its own, what its former run told.
  Instant told_until() const;

  /// The clock that the world waits at: the newest in force, or that of its former run.
  std::optional<Instant> stands_at() const;

  /// Likewise, with what it says of the next step. Requires that there is one.
  PendingClock standing() const;

  /// The clock that it stands at says when its next step is.
  bool tells_next() const;

  /// It follows a run that the world waited for, and has told neither a clock nor an agent of its
  /// own.
  bool is_awaited() const { return former_.has_value() && descriptions_seen_ == 0; }

  /// Nobody waits for it in place of its former run any more.
  void ForgetFormer();

  /// No step follows.
  bool has_finished() const { return next_ && next_->is_never(); }

  /// The world's time begins anew: no clock and no grant. What has arrived stays known.
  void Restart();

  Instant newest() const { return newest_; }  ///< The newest clock that has arrived; else Always().
  /// Likewise, and the greatest told_until(), of clocks that are taken or not.
  Instant heard() const { return heard_; }
  Instant heard_until() const { return heard_until_; }
  const std::optional<Instant>& clock() const { return clock_; }  ///< The newest in force.
  /// The one that this service first brought into force.
  const std::optional<Instant>& first_clock() const { return first_clock_; }
  const std::optional<Instant>& granted() const { return granted_; }  ///< By this service.
  bool lock_step() const { return lock_step_; }                       ///< As its newest clock says.
  bool is_other_kind() const { return other_kind_; }
  std::size_t pending() const { return pending_.size(); }

 private:
  std::uint64_t states_seen_ = 0;
  std::uint64_t descriptions_seen_ = 0;
  std::uint64_t descriptions_told_ = 0;  ///< By the clock in force.
  std::uint64_t descriptions_arrived_ = 0;
  PendingClock offered_;  ///< The newest clock that has arrived.
  Instant newest_ = Instant::Always();
  Instant heard_ = Instant::Always();
  Instant heard_until_ = Instant::Always();
  std::deque<PendingClock> pending_;
  std::optional<PendingClock> former_;  ///< In force when its former run ended.
  std::optional<Instant> first_clock_;
  std::optional<Instant> clock_;
  std::optional<Instant> next_;  // of the clock in force
  std::optional<Instant> granted_;
  bool lock_step_ = true;
  bool other_kind_ = false;
  bool joined_ = false;
  bool awaits_own_clock_ = false;
};

}  // namespace collision::server
