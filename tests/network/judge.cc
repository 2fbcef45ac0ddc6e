#include "tests/network/judge.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "client/checker/check.h"

namespace collision::network {
namespace {

using suite::Outcome;

/// A contact by the names of its agents and its number.
using ContactKey = std::tuple<std::string, std::string, std::uint32_t>;
using Revisions = std::vector<v1::CollisionEvent>;

std::string NameOf(const Heard& heard, const v1::AgentId& id) {
  const auto found = heard.agents.find(id.SerializeAsString());
  return found == heard.agents.end() ? "unknown" : found->second;
}

std::map<ContactKey, Revisions> Contacts(const Heard& heard,
                                         const std::vector<v1::CollisionEvent>& events) {
  std::map<ContactKey, Revisions> contacts;
  for (const v1::CollisionEvent& event : events) {
    if (event.contacts_sequence() == 0) continue;
    contacts[{NameOf(heard, event.lower()), NameOf(heard, event.higher()), event.contact()}]
        .push_back(event);
  }
  return contacts;
}

std::string Text(const ContactKey& key) {
  const auto& [lower, higher, contact] = key;
  return lower + " × " + higher + " #" + std::to_string(contact);
}

/// What is wrong with the order in which one contact was told; empty: nothing.
std::string Disorder(const Revisions& revisions) {
  for (std::size_t i = 1; i < revisions.size(); ++i) {
    const v1::CollisionEvent &before = revisions[i - 1], &event = revisions[i];
    if (before.status() != v1::EVENT_CONFIRMED) return "is told after its end";
    const bool narrower = event.begin().latest_ns() - event.begin().earliest_ns() <
                          before.begin().latest_ns() - before.begin().earliest_ns();
    if (event.status() == v1::EVENT_CONFIRMED && !narrower) return "is confirmed twice";
  }
  return "";
}

void ExpectOrder(const std::string& whose, const std::map<ContactKey, Revisions>& contacts,
                 Outcome* outcome) {
  for (const auto& [key, revisions] : contacts) {
    const std::string disorder = Disorder(revisions);
    outcome->Expect(disorder.empty(), whose + Text(key) + " " + disorder);
  }
}

using Told = std::set<std::pair<ContactKey, v1::EventStatus>>;

Told ToldOf(const Heard& heard, const std::vector<v1::CollisionEvent>& events) {
  Told told;
  for (const auto& [key, revisions] : Contacts(heard, events)) {
    for (const v1::CollisionEvent& event : revisions) told.insert({key, event.status()});
  }
  return told;
}

void ExpectSameTold(const std::string& what, const Told& told, const Told& expected,
                    Outcome* outcome) {
  const auto expect_none = [&](const Told& from, const Told& without, const char* how) {
    for (const auto& one : from) {
      outcome->Expect(without.contains(one),
                      what + Text(one.first) + " " + v1::EventStatus_Name(one.second) + " " + how);
    }
  };
  expect_none(expected, told, "was not told");
  expect_none(told, expected, "was told beyond what is expected");
}

void ExpectContacts(const std::string& of, const checker::Evidence& evidence, Outcome* outcome) {
  outcome->Expect(evidence.contacts_certain() > 0, of + "no two drones met");
  outcome->Add("true_contacts", static_cast<double>(evidence.contacts_certain()));
}

void ExpectNone(const std::string& of, const checker::Violations& violations, Outcome* outcome) {
  outcome->Expect(violations.empty(), of + (violations.empty() ? "" : violations.front()));
}

}  // namespace

void ExpectGoodEnds(const std::string& of, const Flown& flown, Outcome* outcome) {
  outcome->Expect(flown.failures.empty(),
                  of + (flown.failures.empty() ? "" : flown.failures.front()));
}

void ExpectTruth(const std::string& of, const Flown& flown, Outcome* outcome) {
  ExpectGoodEnds(of, flown, outcome);
  const Heard& heard = flown.heard;
  outcome->Expect(heard.contacts_missed == 0, of + "the listener missed contacts");
  outcome->Expect(flown.monitor_said.find("missed: 0") != std::string::npos,
                  of + "the monitor: " + flown.monitor_said);
  ExpectOrder(of + "to the listener ", Contacts(heard, heard.observations.events), outcome);
  ExpectOrder(of + "to the monitor ", Contacts(heard, flown.printed), outcome);
  ExpectSameTold(of + "to the monitor, ", ToldOf(heard, flown.printed),
                 ToldOf(heard, heard.observations.events), outcome);
  const checker::Evidence evidence(flown.motions, heard.observations, flown.facts);
  ExpectContacts(of, evidence, outcome);
  ExpectNone(of, checker::Check(evidence, {}), outcome);
}

void ExpectClearances(const std::string& of, const Flown& flown, Outcome* outcome) {
  ExpectGoodEnds(of, flown, outcome);
  const checker::Evidence evidence(flown.motions, flown.heard.observations, flown.facts);
  ExpectContacts(of, evidence, outcome);
  ExpectNone(of, checker::CheckClearances(evidence), outcome);
}

Flown Only(const std::string& simulator, Flown flown) {
  std::set<std::uint64_t> ids;
  for (const v1::AgentName& name : flown.heard.observations.names) {
    if (name.simulator() == simulator) ids.insert(name.id().simulator_id());
  }
  const auto is_other = [&](const v1::CollisionEvent& event) {
    return !ids.contains(event.lower().simulator_id()) ||
           !ids.contains(event.higher().simulator_id());
  };
  std::erase_if(flown.heard.observations.events, is_other);
  std::erase_if(flown.printed, is_other);
  // The clearances of its agents cover agents of others.
  flown.heard.observations.clearances.clear();
  std::erase_if(flown.motions, [&](const auto& motion) { return motion.simulator != simulator; });
  return flown;
}

void ExpectSameContacts(const std::string& of, const Flown& flown, const Flown& undisturbed,
                        Outcome* outcome) {
  ExpectSameTold(of, ToldOf(flown.heard, flown.heard.observations.events),
                 ToldOf(undisturbed.heard, undisturbed.heard.observations.events), outcome);
}

void ExpectSameEventLog(const std::string& of, const Flown& flown, const Flown& undisturbed,
                        Outcome* outcome) {
  outcome->Expect(!flown.event_log.empty() && flown.event_log == undisturbed.event_log,
                  of + "\"" + flown.event_log + "\" instead of \"" + undisturbed.event_log + "\"");
}

void Report(const FrameCounts& frames, const Flown& flown, Outcome* outcome) {
  outcome->Add("contacts_told",
               static_cast<double>(Contacts(flown.heard, flown.heard.observations.events).size()));
  outcome->Add("frames_delivered", static_cast<double>(frames.delivered));
  outcome->Add("frames_lost", static_cast<double>(frames.lost));
  outcome->Add("frames_doubled", static_cast<double>(frames.doubled));
  outcome->Expect(frames.overflowed == 0,
                  std::to_string(frames.overflowed) + " frames more than the switch holds");
}

}  // namespace collision::network
