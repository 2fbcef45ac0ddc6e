// Decides what a simulator's user is told, and when.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "collision/notice.h"
#include "collision/types.h"

namespace collision::client {

/// What stands in the way is told when it has lasted so long, and again so rarely.
inline constexpr std::chrono::seconds kNoticeAfter(3);
inline constexpr std::chrono::seconds kNoticeAgain(60);

/// Reasons of refusals, and bounds of agents in breach, that are told; further ones are not.
inline constexpr std::size_t kRefusalsToldMax = 64;
inline constexpr std::size_t kBreachesToldMax = 64;

/// How Cyclone DDS is told where to look: "network profile file:///etc/lan.xml".
/// The commonest cause of silence is that two programs differ in it.
std::string NetworkProfileText();

/// Where a program looks: world, domain and network profile.
std::string PlaceText(const std::string& world, std::uint32_t domain);

/// A simulator and its last clock.
struct Laggard {
  std::string name;
  std::int64_t clock_ns = 0;
};

/// Turns what is the case into notices: each cause once, what lasts again after kNoticeAgain, and,
/// of what was told, that it is over. Depends on nothing but the calls. One thread.
class Notices {
 public:
  using Time = std::chrono::steady_clock::time_point;

  struct Facts {
    std::string simulator;
    std::string world;
    std::uint32_t domain = 0;
    bool lock_step = true;
  };

  /// What is the case at one instant.
  struct Situation {
    bool service_heard = false;
    std::optional<bool> world_lock_step = {};  ///< As the service has said.
    bool waits = false;  ///< Lock-step: for a grant, or for the answer to Join().
    std::int64_t granted_until_ns = 0;
    std::int64_t next_ns = 0;                   ///< The step that it waits for.
    std::vector<std::string> waiting_for = {};  ///< Whom or what for, as the service says.
    std::optional<Laggard> laggard = {};        ///< Of the others, the one furthest behind.
    std::string other_program = {};             ///< A sentence: who has the simulator's name.
    std::string ended = {};                     ///< A sentence: who has ended the run.
  };

  explicit Notices(Facts facts) : facts_(std::move(facts)) {}

  void Look(const Situation& situation, Time now);

  /// `agent`: the name of the agent that it is about; empty: of none.
  void Refuse(const Rejection& rejection, const std::string& agent);

  /// The service says that this agent broke what it declared: told of each agent and field, and
  /// again after kNoticeAgain if it goes on.
  void Breach(const client::Breach& breach, const std::string& agent, Time now);

  /// The service says that the simulator's clock is off: told once.
  void SkewedClock(std::int64_t since_ns);

  /// The network says that the credentials end, or have ended: told each time.
  void Credentials(const std::string& warning);

  /// The next notice that was not told yet; nullopt: none.
  std::optional<Notice> Take();

 private:
  /// Something that lasts: told after `after`, then again, then that it is over.
  class Lasting {
   public:
    /// True: it is to be told now. `cause`: told anew if another one is the case.
    bool Lasts(const std::string& cause, Time now, std::chrono::seconds after);
    /// True: it was told, and is over.
    bool Ends();
    std::chrono::seconds Since(Time now) const;

   private:
    std::optional<Time> since_, told_;
    std::string cause_;
  };

  void LookForService(const Situation& situation, Time now);
  bool LookAtClock(const Situation& situation, Time now);
  void LookAtGrant(const Situation& situation, Time now);
  void LookAtStep(const Situation& situation, Time now);
  void Tell(NoticeKind kind, const std::string& text, bool over = false);

  const Facts facts_;
  Lasting no_service_, wrong_clock_, waiting_, long_step_, name_taken_, ended_;
  std::optional<std::int64_t> granted_ns_;  ///< When the wait began.
  std::optional<std::int64_t> step_ns_;     ///< That it waits for.
  std::set<std::string> refusals_;
  /// Agents and the fields they broke, and when that was told.
  std::map<std::pair<std::string, std::string>, Time> breaches_;
  bool skew_told_ = false;
  std::deque<Notice> notices_;
};

}  // namespace collision::client
