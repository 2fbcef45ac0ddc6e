#include "server/world/silence/ended_runs.h"

#include <algorithm>

namespace collision::server {
namespace {

const char* ExplanationOf(EndCause cause) {
  switch (cause) {
    case EndCause::kSilent:
      return "was removed as silent";
    case EndCause::kEvicted:
      return "was evicted by an operator";
    case EndCause::kRestarted:
      return "has ended: an operator restarted the world's time";
  }
  return "has ended";
}

}  // namespace

const char* NameOf(EndCause cause) {
  switch (cause) {
    case EndCause::kSilent:
      return "silent";
    case EndCause::kEvicted:
      return "evicted";
    case EndCause::kRestarted:
      return "restarted";
  }
  return "ended";
}

void EndedRuns::Add(std::uint64_t simulator, std::uint32_t run, EndCause cause) {
  if (ended_.size() >= kEndedRunsMax && !ended_.contains(simulator)) {
    ended_.erase(std::min_element(ended_.begin(), ended_.end(), [](const auto& a, const auto& b) {
      return a.second.number < b.second.number;
    }));
  }
  ++counts_[cause];
  ended_[simulator] = {.run = run, .cause = cause, .number = ++count_};
}

std::uint64_t EndedRuns::count(EndCause cause) const {
  const auto found = counts_.find(cause);
  return found == counts_.end() ? 0 : found->second;
}

std::optional<EndCause> EndedRuns::Find(std::uint64_t simulator, std::uint32_t run) const {
  const auto found = ended_.find(simulator);
  if (found == ended_.end() || found->second.run != run) return std::nullopt;
  return found->second.cause;
}

std::optional<std::string> EndedRuns::Refusal(std::uint64_t simulator, std::uint32_t run) const {
  const auto found = ended_.find(simulator);
  if (found == ended_.end() || run > found->second.run) return std::nullopt;
  return "run " + std::to_string(run) + "; run " + std::to_string(found->second.run) + " " +
         ExplanationOf(found->second.cause) + "; allowed: a higher run, which is welcome";
}

}  // namespace collision::server
