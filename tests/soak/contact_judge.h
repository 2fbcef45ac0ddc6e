// The contacts of the week that a monitor heard of, against those of the plan.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "collision/types.h"
#include "tests/soak/plan.h"
#include "tests/support/suite/case.h"

namespace collision::soak {

/// Each contact of two agents that were there is heard as confirmed and then ended, with brackets
/// that contain its begin and its end; and no other one is heard.
class ContactJudge {
 public:
  ContactJudge(const Plan& plan, suite::Outcome* outcome) : plan_(plan), outcome_(*outcome) {}

  /// Before what it flies is heard of: a program of a crew begins with watch `first`.
  void Flies(int crew, int life, int first);
  void Hear(const client::Event& event);
  /// Nothing more follows.
  void End();

  std::uint64_t agents() const { return agents_; }
  std::uint64_t pairs() const { return pairs_; }
  std::uint64_t contacts() const { return contacts_; }

 private:
  enum class Presence { kNot, kKilled, kWhole };
  struct Span {
    int first = 0, end = 0;
    bool killed = false;
  };
  using Key = std::tuple<int, int, int, int>;  ///< Watch, site, crew, other crew.

  Presence PresenceOf(int crew, int watch) const;
  void Judge(int watch);
  void JudgePair(const Key& key, bool whole);
  bool Expect(bool holds, const Key& key, const std::string& what);

  const Plan plan_;
  suite::Outcome& outcome_;
  std::map<std::uint64_t, int> crews_;      ///< By the id of the simulator.
  std::map<int, std::vector<Span>> spans_;  ///< What each crew flew.
  std::map<Key, client::Event> heard_;      ///< The last revision.
  int judged_ = 0;                          ///< Watches before this one are.
  std::uint64_t agents_ = 0, pairs_ = 0, contacts_ = 0;
};

}  // namespace collision::soak
