// How a ship answers a contact: it bounces off, and never stays entangled.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "client/programs/simulators/motion/rigid_motion.h"
#include "collision/types.h"

namespace collision::client {

/// A contact as the owner of one of the two ships sees it.
struct ShipContact {
  Vector3 point_m{};
  Vector3 outward{};  ///< Unit, from the own ship to the other; zero: not known.
};

/// Beyond this error [rad] an event's normal does not tell where the other ship is.
inline constexpr double kNormalErrorMax = 1.2;

/// A ship leaves a contact at this speed [m/s] at least.
inline constexpr double kSpeedApart = 1;

/// The contact of an event with the own ship, whose state is `own` at `now_ns`. `lower`: the own
/// ship is the event's lower agent. The point moves along with the ship since it was evaluated.
ShipContact ContactOf(const Event& event, bool lower, const RigidState& own, std::int64_t now_ns);

/// Changes the velocities as an elastic push at the point does, against an obstacle that does not
/// yield, since the owner does not know the other's velocity. The push is along −outward, or from
/// the point to the own centre if that is not known; the ship has the inertia of a ball of its
/// radius. Afterwards the centre moves away at kSpeedApart or more. If it does so already and the
/// point does not approach, returns false and changes nothing.
bool BounceOff(const ShipContact& contact, double radius_m, RigidState* own);

/// The contacts of one ship that wait for an answer. Each is answered when it is confirmed, and
/// again every kAnswerPeriod while it lasts, so that entangled ships come apart. One pair of ships
/// is not answered more often, whatever the contact.
class ContactsToAnswer {
 public:
  static constexpr std::int64_t kAnswerPeriod = 250'000'000;  ///< [ns]

  /// Takes any event; ignores those of other agents.
  void Handle(const Event& event, const AgentId& own);

  /// The contacts due at `now_ns`, in a fixed order; they count as answered from then on.
  std::vector<ShipContact> Take(const RigidState& own, std::int64_t now_ns);

 private:
  struct Pair {
    Event event;  // the newest that confirms the contact
    bool lower = false;
    bool fresh = false;  // not answered yet, perhaps over already
    bool lasts = false;
    std::int64_t answered_ns = -kAnswerPeriod;
  };
  std::map<AgentId, Pair> pairs_;  // by the other ship
};

}  // namespace collision::client
