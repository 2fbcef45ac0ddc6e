// An honest simulator that measures how it is served: laps that are all alike.
//
// A lap is 0.4 s in which one agent passes through another one. The passing agent is a new one in
// each lap, with a shape that was given up after the last lap, and for a while nothing of it is
// there: so each lap needs a place for an agent, for a shape and for a pair.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "collision/shape.h"
#include "collision/world.h"
#include "tests/support/suite/case.h"

namespace collision::soak {

/// What some laps were answered.
struct Served {
  int laps = 0;
  std::vector<double> answers_ms;  ///< Lock-step: each wait for the next step's grant.
  std::vector<double> events_ms;   ///< From the state that shows a contact to its event.
};

/// The part-quantile; 0 of nothing.
double QuantileOf(std::vector<double> values, double part);

class Honest {
 public:
  /// Throws std::runtime_error where it cannot connect.
  Honest(const std::string& world, std::uint32_t domain, bool lock_step, suite::Outcome* outcome);

  /// Flies one lap more. Every lap should be told the same contact, in brackets that hold; in
  /// lock-step they are the same in each. A lap is judged at the end of the next one. False: it was
  /// not answered.
  bool Lap(Served* served);

  /// Laps whose contact was not heard of as ended.
  int unended() const { return unended_; }

 private:
  /// What was heard of the contact of one lap.
  struct Flown {
    std::int64_t begin_ns = 0;
    client::AgentId passing;
    std::optional<client::Event> last;
  };

  void Enter();
  bool Step(int step, Served* served);
  void Hear(const client::Event& event);
  void Judge(const Flown& lap);
  client::State Resting(int step) const;
  client::State Passing(int step) const;
  std::int64_t StampOf(int step) const;

  const bool lock_step_;
  suite::Outcome& outcome_;
  client::World world_;
  std::shared_ptr<const client::Shape> shape_;
  std::optional<client::Agent> resting_, passing_;
  Flown lap_;
  std::optional<Flown> before_;  ///< The lap before: its contact may be heard of until now.
  double shown_at_s_ = -1;       ///< When the state was sent that shows the contact; -1: not yet.
  int unended_ = 0;
  Served* served_ = nullptr;
  std::vector<std::int64_t> brackets_;  ///< Of the first lap, from its begin on.
};

}  // namespace collision::soak
