#include <algorithm>
#include <limits>

#include "client/checker/check.h"

namespace collision::checker {
namespace {

constexpr long double kForEver = std::numeric_limits<long double>::infinity();

v1::AgentId IdOf(const v1::Clearance& sample, const v1::AgentClearance& agent) {
  v1::AgentId id;
  id.set_simulator_id(sample.simulator_id());
  id.set_run(sample.run());
  id.set_slot(agent.slot());
  id.set_generation(agent.generation());
  return id;
}

auto FirstAfter(const std::vector<const TrueContact*>& contacts, std::int64_t now_ns) {
  return std::partition_point(contacts.begin(), contacts.end(), [&](const TrueContact* contact) {
    return contact->begin_ns <= now_ns + kRootTolerance;
  });
}

bool Open(const EventHistory& history, const Moment& then, const Moment& since) {
  return !since.IsAfter(then) && (!history.closed || history.closed->IsAfter(then));
}

// Whether the pair had been reported as possible or in contact by then, and was not closed.
bool Announced(const Evidence& evidence, const TrueContact& contact, const Moment& then) {
  for (const EventHistory* history : evidence.HistoriesOf(contact.a, contact.b)) {
    if (Open(*history, then, history->announced)) return true;
  }
  return false;
}

bool InContact(const Evidence& evidence, const TrueContact& contact, const Moment& then) {
  for (const EventHistory* history : evidence.HistoriesOf(contact.a, contact.b)) {
    if (history->confirmed && Open(*history, then, *history->confirmed)) return true;
  }
  return false;
}

// Whether this contact certainly breaks a promise that no contact begins in (from, until).
bool Breaks(const TrueContact& contact, std::int64_t from_ns, long double until_ns) {
  return contact.certain && contact.begin_ns > from_ns + contact.begin_tolerance_ns &&
         contact.begin_ns < until_ns - contact.begin_tolerance_ns;
}

void CheckClearance(const Evidence& evidence, std::size_t motion, const Moment& then,
                    const v1::AgentClearance& agent, Violations* violations) {
  const std::int64_t now_ns = then.now_ns;
  const auto& contacts = evidence.ContactsOf(motion);
  for (auto it = FirstAfter(contacts, now_ns); it != contacts.end(); ++it) {
    const TrueContact& contact = **it;
    if (contact.begin_ns >= agent.clear_until_ns() - kRootTolerance) return;
    if (!Breaks(contact, now_ns, agent.clear_until_ns())) continue;
    if (evidence.MayHaveLeft(contact, now_ns)) continue;
    if (evidence.Changed(contact, now_ns, contact.begin_ns) || Announced(evidence, contact, then)) {
      continue;
    }
    violations->push_back(evidence.motions()[motion].agent + ": at " + evidence.Time(now_ns) +
                          " clear until " + evidence.Time(agent.clear_until_ns()) +
                          " was promised, but " + evidence.PairName(contact.a, contact.b) +
                          " touch at " + evidence.Time(contact.begin_ns));
    return;
  }
}

}  // namespace

Violations CheckClearances(const Evidence& evidence) {
  Violations violations;
  for (const v1::Clearance& sample : evidence.observations().clearances) {
    const Moment then{sample.now_ns(), sample.stamp()};
    for (const v1::AgentClearance& agent : sample.agents()) {
      if (violations.size() >= kRepeatsMax) return violations;
      const auto motion = evidence.MotionOf(IdOf(sample, agent));
      if (!motion) continue;
      if (agent.cause() == v1::CAUSE_BREACH &&
          agent.void_from_ns() != std::numeric_limits<std::int64_t>::max()) {
        violations.push_back(evidence.motions()[*motion].agent +
                             ": promises published as void from " +
                             evidence.Time(agent.void_from_ns()) + ", but no agent broke a bound");
      }
      CheckClearance(evidence, *motion, then, agent, &violations);
    }
  }
  return violations;
}

Violations CheckEarliest(const Evidence& evidence) {
  Violations violations;
  for (const v1::EarliestIntersection& sample : evidence.observations().earliest) {
    const Moment then{sample.now_ns(), sample.stamp()};
    for (const TrueContact& contact : evidence.contacts()) {
      if (violations.size() >= kRepeatsMax) return violations;
      const long double until = sample.found() ? sample.earliest_ns() : kForEver;
      if (contact.begin_ns >= until - kRootTolerance) break;
      if (!Breaks(contact, sample.now_ns(), until)) continue;
      if (evidence.MayHaveLeft(contact, sample.now_ns())) continue;
      if (evidence.Changed(contact, sample.now_ns(), contact.begin_ns)) continue;
      if (InContact(evidence, contact, then)) continue;
      violations.push_back(
          "at " + evidence.Time(sample.now_ns()) + " the earliest intersection was " +
          (sample.found() ? evidence.Time(sample.earliest_ns()) : std::string("none")) + ", but " +
          evidence.PairName(contact.a, contact.b) + " touch at " + evidence.Time(contact.begin_ns));
      break;
    }
  }
  return violations;
}

std::vector<double> ClearanceTightness(const Evidence& evidence) {
  std::vector<double> ratios;
  for (const v1::Clearance& sample : evidence.observations().clearances) {
    for (const v1::AgentClearance& agent : sample.agents()) {
      const auto motion = evidence.MotionOf(IdOf(sample, agent));
      if (!motion) continue;
      const auto& contacts = evidence.ContactsOf(*motion);
      const auto next = std::find_if(FirstAfter(contacts, sample.now_ns()), contacts.end(),
                                     [](const TrueContact* contact) { return contact->certain; });
      if (next == contacts.end()) continue;
      if (evidence.Changed(**next, sample.now_ns(), (*next)->begin_ns)) continue;
      const long double promised =
          static_cast<long double>(agent.clear_until_ns()) - sample.now_ns();
      const long double truth = (*next)->begin_ns - sample.now_ns();
      ratios.push_back(static_cast<double>(std::clamp(promised / truth, 0.0L, 1.0L)));
    }
  }
  return ratios;
}

std::vector<Announcement> Announcements(const Evidence& evidence) {
  std::vector<Announcement> announcements;
  for (const TrueContact& contact : evidence.contacts()) {
    if (!contact.certain) continue;
    for (const EventHistory* history : evidence.HistoriesOf(contact.a, contact.b)) {
      const v1::TimeBracket& begin = history->last().begin();
      const std::int64_t now_ns = history->announced.now_ns;
      const long double lead = contact.begin_ns - now_ns;
      if (!history->confirmed || !(lead > 0)) continue;
      if (contact.begin_ns < begin.earliest_ns() - contact.begin_tolerance_ns ||
          contact.begin_ns > begin.latest_ns() + contact.begin_tolerance_ns) {
        continue;
      }
      if (evidence.Changed(contact, now_ns, contact.begin_ns)) continue;
      const std::int64_t earliest_ns = history->revisions.front().begin().earliest_ns();
      announcements.push_back(
          {static_cast<double>(lead * 1e-9L), static_cast<double>((earliest_ns - now_ns) / lead)});
      break;
    }
  }
  return announcements;
}

}  // namespace collision::checker
