// Names the simulators whose pairs want more work than their share.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "collision_core/detection/detector.h"
#include "idl/messages.pb.h"
#include "server/process/names_log.h"
#include "server/world/world.h"

namespace collision::server {

/// A simulator is named once pairs of it have waited for their evaluation in every step for
/// kHeldNamed of the world's time, until none waits any more: in the log when that begins and ends,
/// and in the status for as long as it lasts. It only tells: the detector holds a simulator to its
/// share from the first step on. One thread.
class ShareReport {
 public:
  /// Takes note of who is held to its share now. True: that has changed.
  bool Take(const std::vector<detection::OwnerWork>& work, const World& world);

  /// Writes what is new.
  void Write(std::int64_t monotonic_ns);

  /// For the status: "narrow_phase_held".
  void AddExtensions(std::vector<v1::KeyValue>* extensions) const;

 private:
  struct Held {
    detection::OwnerId owner;
    std::string name;
    std::string text;  // the name, its share, for how long, how many pairs wait
  };

  std::vector<Held> held_;
  NamesLog begins_{
      "narrow phase: simulator {}: its pairs want more work than step_budget_us allows; they wait "
      "in turn and their brackets are wider, and no other simulator waits for them"};
  NamesLog ends_{"narrow phase: no pair of simulator {} waits any more"};
};

/// A simulator that is held to its share for less is not named [s].
inline constexpr double kHeldNamed = 1;

}  // namespace collision::server
