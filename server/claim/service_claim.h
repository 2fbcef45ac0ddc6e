// Which of several services serves a world.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "server/claim/journalled_simulator.h"

namespace collision::server {

/// What another service of this world is doing, as its status says.
enum class OtherPhase { kClaiming, kServing, kStandby };

/// One status of another service of this world.
struct HeardService {
  std::uint64_t instance = 0;
  std::uint32_t term = 0;  ///< As ServiceClaim::term().
  OtherPhase phase = OtherPhase::kClaiming;
  std::uint64_t sequence = 0;  ///< Of the sample.
  bool followed = true;        ///< Serving: simulators have told clocks that name it.
  std::string process = {};    ///< Where it runs, in which version; empty: not known.
};

/// For the log: "service 0123456789abcdef (pid 12 on host-a, version 0.1.0), term 3".
std::string NameOf(const HeardService& service);

enum class ClaimPhase {
  kClaiming,  ///< It listens whether anybody serves the world, and publishes nothing but its claim.
  kServing,   ///< The world is its own, in term().
  kStandby,   ///< Another service has it; this one does the same work and publishes none of it.
  kWaking,    ///< It served and stood still: it listens whether a standby has taken over.
  kYielded,   ///< Another service has it; why() says which.
};

struct ClaimOptions {
  std::uint64_t instance = 1;     ///< Random, so that no two services share one.
  std::uint32_t term_before = 0;  ///< The highest that the journal knows of.
  std::int64_t wait_ns = 0;       ///< How long it listens; longer than discovery takes.
  std::int64_t heard_for_ns = 0;  ///< How long a status counts as a sign of life: its lease.
  bool stands_by = false;         ///< Beside another service it waits for its end, and takes over.
  std::int64_t waking_ns = 0;     ///< How long it listens after it has stood still: its lease.
  /// Whom the service before this one served, as the journal has it.
  std::vector<JournalledSimulator> roster = {};
  /// Of a replay that begins in the middle of a run: the epoch it was in, and the runs that it had
  /// ended (EndedRuns::TakeTurn()).
  std::uint32_t epoch = 0;
  std::string ended_runs = {};
};

/// A service's claim to its world. Of the services that serve one world at most one stays: a
/// newcomer ends beside a live one, of two newcomers the one with the lower instance goes on, and
/// of two that serve, because the network had parted them, the one that simulators follow, or else
/// the one with the higher term (of equal terms the lower instance). A term is the highest heard or
/// remembered + 1; at the greatest number it stays there, and the instance alone decides.
///
/// Whoever serves yields only to a service that it has heard twice, so that one stray sample ends
/// nobody. A service that has served and yields does not come back: what it knows of the world is
/// its own version of it. A process that is to stand by again starts afresh.
///
/// **Standby.** With `stands_by` it does not end: it takes over, in a new term, when the network
/// says that the one that serves is gone (HearEnd()). Of several standbys the one does that came in
/// the lowest term, of these the one with the lowest instance; the others do if it has not within
/// heard_for_ns. A service that stood still for standstill_ns() may have been replaced meanwhile:
/// WakeUp() keeps it from publishing anything before it has listened, and it then yields to one
/// that it hears once. One that stood still while it claimed listens anew. A standby that stood
/// still has heard nothing of the one that serves: WakeUp() keeps it from taking over before it has
/// listened; after kStaleAfterNs it yields.
///
/// Pure bookkeeping: it reads no clock; times are nanoseconds of the monotonic one. One
/// thread.
class ServiceClaim {
 public:
  explicit ServiceClaim(const ClaimOptions& options) : options_(options) {}

  /// Takes a status that has arrived. Its own is ignored.
  void Hear(const HeardService& heard, std::int64_t now_ns);

  /// The network says that this service has ended, or has not kept its lease. If it is back, it is
  /// heard again, with the status that it wrote last.
  void HearEnd(std::uint64_t instance) { others_.erase(instance); }

  /// This process has stood still for so long, or a step has taken it. Shorter than
  /// standstill_ns() changes nothing. Nor does any other once it has gone on so, step by step, for
  /// heard_for_ns: who is only slow would listen for ever.
  void WakeUp(std::int64_t gap_ns, std::int64_t now_ns);

  /// The standstill after which a standby may have taken over: half a lease; nullopt: none stands
  /// by. Without one, a late service is only late.
  std::optional<std::int64_t> standstill_ns() const;

  /// As a standby: whether simulators could go on with this service. It takes over only if so.
  void SetFits(bool fits) { fits_ = fits; }

  /// What it publishes after so long a standstill within a step is to be held back; 0: nothing is.
  std::int64_t hold_after_ns() const {
    return phase_ == ClaimPhase::kServing ? standstill_ns().value_or(0) : 0;
  }

  /// Whether simulators follow this service, as its next status says.
  void SetFollowed(bool followed) { followed_ = followed; }
  bool followed() const { return followed_; }

  /// A clock, which may count or not, says that its simulator follows this service, or none (0), in
  /// this term. That service may be gone or stand still: this one goes before it, once it serves. A
  /// term more than kTermLeapMax above all that are known is ignored.
  void HearClock(std::uint64_t service, std::uint32_t term);

  /// Brings the phase up to date; the first call begins the claim.
  void Update(std::int64_t now_ns);

  ClaimPhase phase() const { return phase_; }

  /// The term in which it serves, or of the service beside which it began to stand by (the greatest
  /// number: it has heard only of another standby); 0: neither.
  std::uint32_t term() const { return phase_ == ClaimPhase::kStandby ? standby_term_ : term_; }
  std::uint64_t instance() const { return options_.instance; }
  const ClaimOptions& options() const { return options_; }

  /// It does all the work of a service, whether it publishes it or not.
  bool works() const { return phase_ == ClaimPhase::kServing || phase_ == ClaimPhase::kStandby; }

  /// Whether it publishes anything but its status: it serves and, if it has taken over, a simulator
  /// has heard so. A standby whose cable is out takes over, too; nobody hears it, and what it says
  /// of the world would be wrong.
  bool speaks() const { return phase_ == ClaimPhase::kServing && !is_unheard_; }

  /// True, once: it has taken over, a simulator has heard so since, and it speaks from now on.
  bool BeginsToSpeak();

  /// kYielded, kStandby: the other service, in words for the log and standard error.
  const std::string& why() const { return why_; }

  /// When Update() changes something although nothing is heard; nullopt: never.
  std::optional<std::int64_t> NextDue() const;

  /// Whether another service was heard to serve this world within kContendedForNs, or has been
  /// replaced by this one since.
  bool IsContended(std::int64_t now_ns) const;

  /// Serving: one line for each live service that serves this world too and will yield, or has an
  /// implausible term. Empty is what an operator wants to see.
  std::vector<std::string> Conflicts(std::int64_t now_ns) const;

 private:
  bool HasStandby() const;
  struct Other {
    HeardService newest;
    std::int64_t heard_ns = 0;
    std::uint64_t samples = 0;
  };

  bool GoesFirst(const HeardService& other) const;
  bool Yields(std::int64_t now_ns);
  void ListenAnew(std::int64_t gap_ns, std::int64_t now_ns);
  std::int64_t StandbyListens() const;
  bool HasJustWoken(std::int64_t now_ns) const;
  bool TakesOver(std::int64_t now_ns);
  bool WaitsFor(const Other& other) const;
  void Serve(std::int64_t now_ns);
  void Yield(const HeardService& other, const std::string& why);

  const ClaimOptions options_;
  ClaimPhase phase_ = ClaimPhase::kClaiming;
  std::optional<std::int64_t> since_ns_;      ///< Of the claim, or of the waking.
  int listened_anew_ = 0;                     ///< Times, while it claimed.
  std::optional<std::int64_t> contended_ns_;  ///< Serving: when it last was, though that one ended.
  std::optional<std::int64_t> woke_ns_;
  std::optional<std::int64_t> stood_ns_;  ///< Until when it stood still, or a step took long.
  std::int64_t listens_since_ns_ = 0;     ///< Since then it has gone on so.
  bool fits_ = true;
  bool followed_ = false;
  bool is_unheard_ = false;                ///< It has taken over, and does not speak yet.
  bool is_named_ = false;                  ///< Since then: by a simulator.
  std::optional<std::int64_t> vacant_ns_;  ///< Since when nobody serves; while it stands by.
  std::uint32_t term_ = 0;
  std::uint32_t standby_term_ = 0;
  std::uint32_t highest_heard_ = 0;
  std::string why_;
  std::map<std::uint64_t, Other> others_;  ///< By instance; at most kOthersMax.
};

/// A claimant whose every step takes so long serves all the same.
inline constexpr int kListensAnewMax = 3;

/// So long after another service was heard, what this one says may still be overwritten by what
/// that one wrote: longer than a message is on its way on any network.
inline constexpr std::int64_t kContendedForNs = 60'000'000'000;

/// A standby that has heard nothing for so long starts afresh: others may have given it up, as DDS
/// does by default, and what ended meanwhile is told to nobody any more.
inline constexpr std::int64_t kStaleAfterNs = 10'000'000'000;

/// Services that may have come and gone unheard, and each served a simulator in a term of its own.
inline constexpr std::uint32_t kTermLeapMax = 4096;

/// Other services of one world that are remembered at a time; further ones are not, except that
/// their terms count.
inline constexpr std::size_t kOthersMax = 16;

}  // namespace collision::server
