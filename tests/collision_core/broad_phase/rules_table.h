// Agents, half-spaces and rules in the plainest form, beside the methods.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tests/collision_core/broad_phase/method_scenes.h"

namespace collision::broad_phase {

/// Asks the canonical routines for every pair. Every change is made to the method too.
class RulesTable {
 public:
  explicit RulesTable(SweepingIndex* method) : method_(method) {}

  std::uint32_t end() const { return static_cast<std::uint32_t>(bounds_.size()); }
  bool Moves(std::uint32_t i) const { return i < end() && bounds_[i].has_value(); }
  bool Holds(std::uint32_t i) const { return Moves(i) || half_spaces_.count(i) != 0; }
  const AgentBound& bound(std::uint32_t i) const { return *bounds_[i]; }
  std::size_t rules() const { return rules_.size(); }

  void Set(std::uint32_t i, const AgentBound& bound) {
    Reserve(i);
    bounds_[i] = bound;
    half_spaces_.erase(i);
    method_->Set(i, bound);
  }
  void Tighten(std::uint32_t i, const AgentBound& bound) {
    bounds_[i] = bound;
    method_->Tighten(i, bound);
  }
  void SetHalfSpace(std::uint32_t i, const HalfSpace& half_space) {
    Reserve(i);
    bounds_[i].reset();
    half_spaces_[i] = half_space;
    EXPECT_TRUE(method_->SetHalfSpace(i, half_space));
  }
  void Remove(std::uint32_t i) {
    if (i < end()) bounds_[i].reset();
    half_spaces_.erase(i);
    std::erase_if(
        rules_, [i](const auto& rule) { return rule.first.first == i || rule.first.second == i; });
    method_->Remove(i);
  }
  void SetRule(std::uint32_t a, std::uint32_t b, intersection::PairRule rule) {
    if (a == b) return;
    rules_[std::minmax(a, b)] = rule;
    if (rule == intersection::PairRule()) {
      rules_.erase(std::minmax(a, b));
      method_->ClearRule(a, b);
    } else if (rule.excluded) {
      EXPECT_TRUE(method_->Exclude(a, b));
    } else {
      EXPECT_TRUE(method_->SetMargin(a, b, rule.margin));
    }
  }

  intersection::IntersectionTime TimeOf(const intersection::BroadQuery& query, std::uint32_t a,
                                        std::uint32_t b) const {
    const intersection::IntersectionTime never{query.from, numeric::kInfinity};
    const auto found = rules_.find(std::minmax(a, b));
    const intersection::PairRule rule =
        found == rules_.end() ? intersection::PairRule() : found->second;
    if (rule.excluded || a == b || !Holds(a) || !Holds(b)) return never;
    if (Moves(a) && Moves(b)) return EarliestIntersectionOf(query, bound(a), bound(b), rule.margin);
    if (!Moves(a) && !Moves(b)) return never;
    if (!Moves(a)) std::swap(a, b);
    return EarliestIntersectionOf(query, half_spaces_.at(b), bound(a), rule.margin);
  }

  std::optional<intersection::IntersectingPair> Earliest(const intersection::BroadQuery& query,
                                                         int only = -1) const {
    std::optional<intersection::IntersectingPair> best;
    for (std::uint32_t a = 0; a < end(); ++a) {
      for (std::uint32_t b = a + 1; b < end(); ++b) {
        if (only >= 0 && static_cast<int>(a) != only && static_cast<int>(b) != only) continue;
        const intersection::IntersectingPair meeting{a, b, TimeOf(query, a, b)};
        if (!meeting.time.instant().is_never() && (!best || meeting < *best)) best = meeting;
      }
    }
    return best;
  }

  std::vector<Neighbour> Meetings(std::uint32_t agent, Instant from, Instant until,
                                  Instant horizon) const {
    std::vector<Neighbour> meetings;
    std::optional<Neighbour> next;
    for (std::uint32_t other = 0; other < end(); ++other) {
      const Neighbour meeting{
          other, TimeOf({intersection::BoundKind::kHorn, from, horizon}, agent, other)};
      const Instant when = meeting.time.instant();
      if (when.is_never()) continue;
      if (when <= until) {
        meetings.push_back(meeting);
      } else if (!next || when < next->time.instant()) {
        next = meeting;
      }
    }
    if (next) meetings.push_back(*next);
    SortByPartner(0, &meetings);
    return meetings;
  }

 private:
  void Reserve(std::uint32_t i) {
    if (end() <= i) bounds_.resize(i + 1);
  }

  SweepingIndex* method_;
  SceneAgents bounds_;
  std::map<std::uint32_t, HalfSpace> half_spaces_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, intersection::PairRule> rules_;
};

inline std::string Text(const std::optional<intersection::IntersectingPair>& meeting) {
  if (!meeting) return "none";
  return std::to_string(meeting->lower) + " x " + std::to_string(meeting->higher) + " at " +
         std::to_string(meeting->time.base.nanoseconds()) + " ns + " +
         testing::PrintToString(meeting->time.seconds) + " s";
}

/// Near some agent, any way round.
inline HalfSpace DrawHalfSpace(const RulesTable& table, Random* random) {
  HalfSpace half_space;
  half_space.normal = random->UnitVector() * random->LogUniform(1e-3, 1e3);
  const auto at = static_cast<std::uint32_t>(random->Below(table.end()));
  if (table.Moves(at)) {
    const double out = random->LogUniform(0.1, 30);
    half_space.offset =
        half_space.normal.dot(table.bound(at).bound.state.p_WA) - half_space.normal.norm() * out;
  }
  if (random->Chance(0.3)) half_space.filter = {.group = 3, .mask = 3};
  return half_space;
}

inline intersection::PairRule DrawRule(Random* random) {
  if (random->Chance(0.3)) return {};
  if (random->Chance(0.4)) return {.excluded = true};
  if (random->Chance(0.02)) return {.margin = 1e30};
  return {.margin = random->LogUniform(1e-3, 10)};
}

}  // namespace collision::broad_phase
