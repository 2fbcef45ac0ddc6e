#include "collision_core/intersection/pair_rules.h"

#include <algorithm>
#include <cmath>

namespace collision::intersection {
namespace {

template <typename Entries>
auto Find(std::uint32_t partner, Entries& entries) {
  return std::lower_bound(
      entries.begin(), entries.end(), partner,
      [](const auto& entry, std::uint32_t wanted) { return entry.partner < wanted; });
}

}  // namespace

void PairRules::Rules::Update() {
  margin_max = 0;
  for (const Entry& entry : entries) margin_max = std::max(margin_max, entry.rule.margin);
}

bool PairRules::HasRoom(std::uint32_t agent) const {
  const auto found = of_.find(agent);
  return found == of_.end() || found->second.entries.size() < kRulesOfAgentMax;
}

void PairRules::Put(std::uint32_t agent, std::uint32_t partner, PairRule rule) {
  Rules& rules = of_[agent];
  const auto at = Find(partner, rules.entries);
  if (at != rules.entries.end() && at->partner == partner) {
    at->rule = rule;
  } else {
    rules.entries.insert(at, {partner, rule});
  }
  rules.Update();
}

void PairRules::Drop(std::uint32_t agent, std::uint32_t partner) {
  const auto found = of_.find(agent);
  Rules& rules = found->second;
  rules.entries.erase(Find(partner, rules.entries));
  rules.Update();
  if (rules.entries.empty()) of_.erase(found);
}

bool PairRules::Set(std::uint32_t a, std::uint32_t b, PairRule rule) {
  if (a == b || !(rule.margin >= 0) || !std::isfinite(rule.margin)) return false;
  if (rule.excluded) rule.margin = 0;
  const bool is_new = Of(a, b) == PairRule();
  if (rule == PairRule()) {
    if (is_new) return true;
    Drop(a, b);
    Drop(b, a);
    --size_;
    return true;
  }
  if (is_new && (size_ == kRulesMax || !HasRoom(a) || !HasRoom(b))) return false;
  Put(a, b, rule);
  Put(b, a, rule);
  size_ += is_new;
  return true;
}

std::vector<std::uint32_t> PairRules::Forget(std::uint32_t agent) {
  std::vector<std::uint32_t> partners;
  const auto found = of_.find(agent);
  if (found == of_.end()) return partners;
  for (const Entry& entry : found->second.entries) partners.push_back(entry.partner);
  for (const std::uint32_t partner : partners) Drop(partner, agent);
  of_.erase(agent);
  size_ -= partners.size();
  return partners;
}

PairRule PairRules::Of(std::uint32_t a, std::uint32_t b) const {
  if (empty()) return {};
  const auto found = of_.find(a);
  if (found == of_.end()) return {};
  const auto at = Find(b, found->second.entries);
  return at != found->second.entries.end() && at->partner == b ? at->rule : PairRule();
}

double PairRules::HalfMargin(std::uint32_t agent) const {
  const auto found = of_.find(agent);
  return found == of_.end() ? 0 : HalfUp(found->second.margin_max);
}

}  // namespace collision::intersection
