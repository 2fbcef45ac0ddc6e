#include "server/world/silence/ended_runs.h"

#include <charconv>
#include <sstream>
#include <string_view>
#include <system_error>

#include "idl/identity.h"

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
    case EndCause::kRefused:
      return "was refused: its hello does not fit";
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
    case EndCause::kRefused:
      return "refused";
  }
  return "ended";
}

void EndedRuns::Add(std::uint64_t simulator, std::uint32_t run, EndCause cause) {
  const auto known = ended_.find(simulator);
  if (known != ended_.end()) {
    order_.erase(known->second.number);
  } else if (ended_.size() >= kEndedRunsMax) {
    ended_.erase(order_.begin()->second);
    order_.erase(order_.begin());
  }
  ++counts_[cause];
  ended_[simulator] = {.run = run, .cause = cause, .number = ++count_};
  order_[count_] = simulator;
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

std::string EndedRuns::TakeTurn(std::size_t bytes) {
  std::string text;
  for (std::size_t i = 0; i < order_.size(); ++i) {
    auto next = order_.upper_bound(told_);
    if (next == order_.end()) next = order_.begin();
    const Ended& ended = ended_.at(next->second);
    const std::string one = (text.empty() ? "" : ", ") + IdText(next->second) + ":" +
                            std::to_string(ended.run) + ":" + NameOf(ended.cause);
    if (text.size() + one.size() > bytes) break;
    text += one;
    told_ = next->first;
  }
  return text;
}

std::vector<EndedRun> EndedRunsIn(const std::string& text) {
  std::vector<EndedRun> runs;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (word.back() == ',') word.pop_back();
    EndedRun ended;
    const char* const end = word.data() + word.size();
    const auto id = std::from_chars(word.data(), end, ended.simulator, 16);
    if (id.ec != std::errc() || id.ptr == end || *id.ptr != ':') continue;
    const auto run = std::from_chars(id.ptr + 1, end, ended.run);
    if (run.ec != std::errc() || run.ptr == end || *run.ptr != ':') continue;
    for (const EndCause cause :
         {EndCause::kSilent, EndCause::kEvicted, EndCause::kRestarted, EndCause::kRefused}) {
      ended.cause = cause;
      if (std::string_view(run.ptr + 1, end) == NameOf(cause)) runs.push_back(ended);
    }
  }
  return runs;
}

}  // namespace collision::server
