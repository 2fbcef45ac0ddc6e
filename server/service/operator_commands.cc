#include "server/service/operator_commands.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <utility>

#include "idl/identity.h"
#include "idl/limits.h"
#include "server/process/logging.h"
#include "server/publish/text/names_text.h"

namespace collision::server {
namespace {

/// Longest list of names in an answer [bytes]; the rest of the answer fits beside it.
constexpr std::size_t kKnownNamesMax = 120;

bool IsDone(const std::string& answer) { return answer.starts_with("done"); }

}  // namespace

bool OperatorCommands::Obey(const v1::OperatorCommand& command) {
  const auto same = [&](const Answer& answer) { return answer.command_id == command.command_id(); };
  if (std::any_of(answers_.begin(), answers_.end(), same)) return false;
  std::string text;
  switch (command.kind()) {
    case v1::OPERATOR_EVICT:
      text = Evict(command.simulator());
      break;
    case v1::OPERATOR_RESTART_TIME:
      text = RestartTime();
      break;
    default:
      text = fmt::format("refused: kind: {}; allowed: {} to {}", static_cast<int>(command.kind()),
                         static_cast<int>(v1::OperatorCommandKind_MIN),
                         static_cast<int>(v1::OperatorCommandKind_MAX));
  }
  Log(spdlog::level::warn, "operator command", "operator: " + text);
  const bool restarts = command.kind() == v1::OPERATOR_RESTART_TIME && IsDone(text);
  answers_.push_back({command.command_id(), text.substr(0, wire::kExtensionValueMax)});
  if (answers_.size() > kAnswersKept) answers_.pop_front();
  news_ = true;
  return restarts;
}

std::string OperatorCommands::Evict(const std::string& name) {
  if (!wire::IsName(name)) {
    return fmt::format("refused: simulator: not a name; allowed: {}", wire::kNameText);
  }
  const bool was_missing = world_.silence().roster().GiveUp(name);
  Simulator* simulator = world_.Find(SimulatorId(name));
  if (simulator != nullptr && !simulator->has_left()) {
    const std::uint64_t agents = world_.quotas().Used(simulator->id(), Resource::kAgents);
    intake_.EndRun(simulator, EndCause::kEvicted);
    return fmt::format(
        "done: simulator \"{}\" is removed with its {} agents; it is welcome again with a higher "
        "run",
        name, agents);
  }
  if (was_missing) return fmt::format("done: simulator \"{}\" is not waited for any more", name);
  return fmt::format("refused: no simulator \"{}\" in this world; known: {}", name, KnownNames());
}

std::string OperatorCommands::RestartTime() {
  if (!world_.simulated()) {
    return "refused: the world runs in real time, which cannot begin anew; only in lock-step "
           "(clock.kind LOCK_STEP) it can";
  }
  world_.silence().roster().GiveUpAll();
  std::size_t ended = 0;
  std::size_t others = 0;
  for (auto& [id, simulator] : world_.simulators()) {
    if (simulator.has_left()) continue;
    if (!simulator.time().clock() && simulator.alive()) {
      ++others;
      continue;
    }
    intake_.EndRun(&simulator, EndCause::kRestarted);
    ++ended;
  }
  return fmt::format(
      "done: the world's time begins anew with the next first clock; simulators that were in it, "
      "each welcome again with a higher run: {}; others, which had told no clock and go on: {}",
      ended, others);
}

std::string OperatorCommands::KnownNames() const {
  std::vector<std::string> names = world_.silence().roster().missing();
  for (const auto& [id, simulator] : world_.simulators()) {
    if (!simulator.has_left()) names.push_back(simulator.name());
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names.empty() ? "none" : NamesText(names, kKnownNamesMax);
}

bool OperatorCommands::TakeNews() { return std::exchange(news_, false); }

void OperatorCommands::AddExtensions(std::vector<v1::KeyValue>* extensions) const {
  for (const Answer& answer : answers_) {
    v1::KeyValue& extension = extensions->emplace_back();
    extension.set_key("operator." + IdText(answer.command_id));
    extension.set_value(answer.text);
  }
}

}  // namespace collision::server
