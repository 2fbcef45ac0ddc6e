#include "tests/soak/contact_judge.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "idl/identity.h"

namespace collision::soak {
namespace {

using client::Event;
using client::EventStatus;

/// A watch is judged when one is heard of that is so much later.
constexpr int kLateWatches = 4;
/// Nearer to touching than that two may stay undecided: between their states they could turn [m].
constexpr double kGrazing = 0.01;
/// Positions are rounded, and the slowest pairs move at a millimetre a second [ns].
constexpr std::int64_t kTolerance = 10'000;

/// Whether the bracket has a time in common with [from, to].
bool Meets(const client::TimeBracket& bracket, std::int64_t from_ns, std::int64_t to_ns) {
  return bracket.earliest_ns - kTolerance <= to_ns && from_ns <= bracket.latest_ns + kTolerance;
}

}  // namespace

void ContactJudge::Flies(int crew, int life, int first) {
  const Life flown = LifeOf(plan_, crew, life);
  crews_[SimulatorId(flown.name)] = crew;
  const int end = std::max(first, std::min(first + flown.watches, plan_.watches()));
  spans_[crew].push_back({first, end, flown.killed});
  agents_ += static_cast<std::uint64_t>(end - first) * kSites;
}

void ContactJudge::Hear(const Event& event) {
  if (!client::IsDecided(event.status)) return;
  const auto lower = crews_.find(event.lower.simulator),
             higher = crews_.find(event.higher.simulator);
  const bool known = lower != crews_.end() && higher != crews_.end();
  if (!outcome_.Expect(known, "a contact of an agent that nobody flies")) return;
  const int watch = static_cast<int>(event.begin.latest_ns / plan_.watch_ns());
  const auto [a, b] = std::minmax(lower->second, higher->second);
  const Key key{watch, SiteOf(event.proximity ? event.proximity->point_m[0] : 0), a, b};
  if (!Expect(judged_ <= watch, key, "heard too late")) return;
  const auto [known_contact, is_new] = heard_.try_emplace(key, event);
  if (!is_new) {
    Expect(known_contact->second.contact == event.contact, key, "a second contact");
    known_contact->second = event;
  }
  while (judged_ + kLateWatches < watch) Judge(judged_++);
}

void ContactJudge::End() {
  while (judged_ < plan_.watches()) Judge(judged_++);
  for (const auto& [key, event] : heard_) Expect(false, key, "after the end of the week");
}

ContactJudge::Presence ContactJudge::PresenceOf(int crew, int watch) const {
  const auto spans = spans_.find(crew);
  if (spans == spans_.end()) return Presence::kNot;
  for (const Span& span : spans->second) {
    if (watch < span.first || span.end <= watch) continue;
    return span.killed && watch == span.end - 1 ? Presence::kKilled : Presence::kWhole;
  }
  return Presence::kNot;
}

void ContactJudge::Judge(int watch) {
  for (int a = 0; a < kCrews; ++a) {
    const Presence of_a = PresenceOf(a, watch);
    if (of_a == Presence::kNot) continue;
    for (int b = a + 1; b < kCrews; ++b) {
      const Presence of_b = PresenceOf(b, watch);
      if (of_b == Presence::kNot) continue;
      const bool whole = of_a == Presence::kWhole && of_b == Presence::kWhole;
      for (int site = 0; site < kSites; ++site) JudgePair({watch, site, a, b}, whole);
    }
  }
  for (auto one = heard_.begin(); one != heard_.end() && std::get<0>(one->first) <= watch;) {
    Expect(false, one->first, "heard of agents that were not there");
    one = heard_.erase(one);
  }
}

/// Its agents are gone at some time after the last step of the watch; one whose program was killed
/// may be gone before.
void ContactJudge::JudgePair(const Key& key, bool whole) {
  ++pairs_;
  const auto [watch, site, a, b] = key;
  const std::int64_t last_ns = plan_.BeginOf(watch + 1) - plan_.step_ns();
  const Meeting truth = MeetingOf(plan_, watch, site, a, b);
  const auto heard = heard_.find(key);
  if (heard == heard_.end()) {
    const bool certain = whole && truth.depth_m > kGrazing && truth.begin_ns < last_ns;
    Expect(!certain, key, "not heard");
    return;
  }
  const Event event = heard->second;
  heard_.erase(heard);
  ++contacts_;
  if (std::abs(truth.depth_m) <= kGrazing) return;
  if (!Expect(truth.depth_m > 0, key, "no such contact")) return;
  if (truth.begins_inside) {
    Expect(Meets(event.begin, truth.begin_ns, truth.begin_ns), key,
           "its begin is not in the bracket");
  }
  if (!whole) return;
  Expect(event.status == EventStatus::kEnded, key,
         std::string("it is ") + client::Name(event.status) + " at last, not ended");
  Expect(Meets(event.end, std::min(last_ns, truth.end_ns), truth.end_ns), key,
         "its end is not in the bracket");
}

bool ContactJudge::Expect(bool holds, const Key& key, const std::string& what) {
  if (holds) return outcome_.Expect(true, {});
  const auto [watch, site, a, b] = key;
  return outcome_.Expect(false, "watch " + std::to_string(watch) + ", site " +
                                    std::to_string(site) + ", crews " + std::to_string(a) +
                                    " and " + std::to_string(b) + ": " + what);
}

}  // namespace collision::soak
