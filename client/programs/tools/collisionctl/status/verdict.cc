#include "client/programs/tools/collisionctl/status/verdict.h"

#include <utility>

#include "client/library/network/conversion.h"
#include "client/programs/tools/collisionctl/status/status_fields.h"
#include "idl/identity.h"

namespace collision::client {
namespace {

using Lines = std::vector<std::string>;

/// Something that is wrong: what it is about, and what is wrong and to be done.
struct Cause {
  std::string name;
  std::string text;
};

/// The lines of one word: a single cause stands in its line; several follow it, one a line.
Lines Group(const std::string& word, const std::vector<Cause>& causes, const std::string& summary) {
  if (causes.empty()) return {};
  if (causes.size() == 1) return {word + " " + causes.front().name + ": " + causes.front().text};
  Lines names;
  for (const Cause& cause : causes) names.push_back(cause.name);
  Lines lines = {word + " " + Shortened(names, kNamesColumns) + ": " + summary};
  for (const Cause& cause : causes) lines.push_back("  " + cause.name + ": " + cause.text);
  return lines;
}

/// What ends the waiting. Of all that a world waits for, only a simulator's name has no blank.
std::string WaitAdvice(const std::string& name) {
  if (name.starts_with("simulators to come")) return "start them";
  if (name.starts_with("shape ")) return "it ends by itself";
  if (name.find(' ') != std::string::npos) return "";
  return "let it go on, start it again, or give it up: collisionctl evict " + name;
}

Lines Waiting(const v1::ServiceStatus& status) {
  const Lines reasons = Parts(ExtensionOf(status, "waiting_why"));
  std::vector<Cause> causes;
  for (const std::string& name : Parts(ExtensionOf(status, "waiting_for"))) {
    std::string text;
    for (const std::string& reason : reasons) {
      // One name may begin another one.
      if (!reason.starts_with(name + ":") && !reason.starts_with(name + " ")) continue;
      text = reason.substr(name.size());
      text.erase(0, text.find_first_not_of(": "));
    }
    if (name.starts_with("+")) text = "collisionctl status --all lists the simulators";
    const std::string advice = WaitAdvice(name);
    text += (text.empty() || advice.empty() ? "" : "; ") + advice;
    causes.push_back({name, text});
  }
  return Group("WAITS for", causes, "the world's time stands");
}

/// What has failed in a service, and what then helps.
struct Failure {
  const char* what;
  const char* key;
  const char* advice;
};

constexpr Failure kFailures[] = {
    {"to record", "recording_failure", "free space or choose another file, and start it again"},
    {"to keep the flight recorder", "flight_failure",
     "see to its state_dir (space, rights); it tries again each minute"},
    {"to keep its contacts", "contacts_failure",
     "see to its state_dir (space, rights); it tries again each minute"},
    {"to write its log", "log_failure",
     "free space, or name another log_file and reload: systemctl reload, collisiond --reload"},
    {"to keep its journal", "state_failure",
     "see to its folder (space, rights), and start it again"},
    {"over messages", "quarantine",
     "tell the maintainers, and remove the quarantine file while the service is down"}};

void AddFailures(const v1::ServiceStatus& status, const std::string& of,
                 std::vector<Cause>* causes) {
  for (const auto& [what, key, advice] : kFailures) {
    const std::string text = ExtensionOf(status, key);
    if (!text.empty()) causes->push_back({what + of, text + "; " + advice});
  }
}

Lines Failures(const WorldView& view) {
  std::vector<Cause> causes;
  AddFailures(*view.status(), "", &causes);
  for (const v1::ServiceStatus& standby : view.Standbys()) {
    AddFailures(standby, " (standby " + IdText(standby.service_id()) + ")", &causes);
  }
  return Group("FAILS", causes, "the service goes on without");
}

const char* RefusalAdvice(v1::RejectionReason reason) {
  switch (reason) {
    case v1::REJECTED_NOT_FINITE:
    case v1::REJECTED_OUT_OF_RANGE:
    case v1::REJECTED_ZERO_QUATERNION:
    case v1::REJECTED_NOT_UNIT:
    case v1::REJECTED_CHUNK_TOO_LARGE:
      return "correct the value that it sends";
    case v1::REJECTED_ID_OWNED:
    case v1::REJECTED_ID_MISMATCH:
      return "give each program a name of its own";
    case v1::REJECTED_FUTURE_STAMP:
    case v1::REJECTED_CLOCK_SKEW:
      return "synchronise its clock, or raise clock.skew_max_s";
    case v1::REJECTED_TOO_MANY_AGENTS:
    case v1::REJECTED_TOO_MANY_SIMULATORS:
      return "remove some, or raise the limit in the configuration";
    case v1::REJECTED_OLD_RUN:
      return "start it again";
    case v1::REJECTED_BAD_SHAPE:
      return "mesh-info says whether a mesh is fit";
    case v1::REJECTED_MISMATCH:
      return "start it with what the service expects";
    default:
      return "see its own messages";
  }
}

std::string LowerCaseReason(v1::RejectionReason reason) {
  std::string text = v1::RejectionReason_Name(reason).substr(std::string("REJECTED_").size());
  for (char& c : text) c = c == '_' ? '-' : static_cast<char>(c | 0x20);
  return text;
}

std::string RefusalText(const v1::SimulatorReport& report, const WorldView& view) {
  const v1::StandingRefusal& refusal = report.refusals(0);
  const bool is_of_an_agent =
      refusal.topic() == v1::TOPIC_AGENT_DESCRIPTION || refusal.topic() == v1::TOPIC_AGENT_STATES;
  const AgentId agent{report.simulator_id(), report.run(), refusal.slot(), refusal.generation()};
  std::string text = is_of_an_agent ? "agent " + view.Name(agent) + ": " : "";
  text += refusal.field() + ": " + refusal.detail() + " (" + LowerCaseReason(refusal.reason());
  if (report.refused() > 1) text += "; " + std::to_string(report.refused() - 1) + " more";
  return text + "); " + RefusalAdvice(refusal.reason());
}

/// Simulators whose hello does not fit. A reason may have commas; only a name is without a blank.
std::vector<Cause> Unfit(const v1::ServiceStatus& status) {
  std::vector<Cause> causes;
  for (const std::string& part : Parts(ExtensionOf(status, "unfit"))) {
    const std::size_t colon = part.find(": ");
    if (colon != std::string::npos && part.find(' ') > colon) {
      causes.push_back({part.substr(0, colon), part.substr(colon + 2)});
    } else if (!causes.empty()) {
      causes.back().text += ", " + part;
    }
  }
  for (Cause& cause : causes)
    cause.text += std::string("; ") + RefusalAdvice(v1::REJECTED_MISMATCH);
  return causes;
}

Lines Refusals(const WorldView& view) {
  std::vector<Cause> causes = Unfit(*view.status());
  for (const v1::SimulatorReport& report : view.Refused()) {
    causes.push_back({report.name(), RefusalText(report, view)});
  }
  return Group("REFUSES", causes, "what they send does not count");
}

/// Who takes more than its share: lists of simulators.
constexpr std::pair<const char*, const char*> kLoads[] = {
    {"HOLDS BACK", "narrow_phase_held"}, {"NEARS A LIMIT", "quotas"}, {"FLOODED", "flooding"}};

Lines Loads(const v1::ServiceStatus& status) {
  Lines lines;
  for (const auto& [word, key] : kLoads) {
    for (const std::string& who : Parts(ExtensionOf(status, key))) {
      lines.push_back(std::string(word) + ": " + who);
    }
  }
  return lines;
}

std::string WellText(const v1::ServiceStatus& status) {
  if (status.simulators().empty()) return "WELL: it serves, and no simulator is here";
  const std::uint64_t broken = CounterOf(status, "breaches");
  const std::string told = broken == 0
                               ? ""
                               : "; but agents broke what they declare, " + std::to_string(broken) +
                                     (broken == 1 ? " time" : " times") + ": collisionctl agents";
  return "WELL: time is not held up, nothing has failed, nothing is refused" + told;
}

}  // namespace

std::string Shortened(const std::vector<std::string>& texts, std::size_t columns,
                      std::size_t further) {
  std::string all;
  std::size_t shown = 0;
  for (const std::string& text : texts) {
    const std::string next = (shown == 0 ? "" : ", ") + text;
    if (shown > 0 && all.size() + next.size() > columns) break;
    all += next;
    ++shown;
  }
  const std::size_t more = texts.size() - shown + further;
  return more == 0 ? all : all + " and " + std::to_string(more) + " more";
}

std::vector<std::string> Verdict(const WorldView& view) {
  Lines lines;
  for (const Lines& group :
       {Waiting(*view.status()), Failures(view), Refusals(view), Loads(*view.status())}) {
    lines.insert(lines.end(), group.begin(), group.end());
  }
  if (lines.empty()) lines.push_back(WellText(*view.status()));
  return lines;
}

}  // namespace collision::client
