#include "server/world/silence/roster.h"

#include <algorithm>

namespace collision::server {

Roster::Roster(const std::vector<JournalledSimulator>& entries) {
  for (const JournalledSimulator& entry : entries) {
    missing_[entry.id] = {.run = entry.run, .name = entry.name};
    greatest_grant_ = std::max(greatest_grant_, entry.granted.value_or(Instant::Always()));
  }
}

void Roster::Await(std::uint64_t id, Missing missing) {
  const auto [place, is_new] = missing_.try_emplace(id, missing);
  if (is_new) return;
  missing.since_ns = place->second.since_ns;
  place->second = std::move(missing);
}

void Roster::Arrive(std::uint64_t id, std::uint32_t run) {
  const auto found = missing_.find(id);
  if (found != missing_.end() && run >= found->second.run) missing_.erase(found);
}

bool Roster::GiveUp(const std::string& name) {
  return std::erase_if(missing_, [&](const auto& one) { return one.second.name == name; }) > 0;
}

std::vector<std::string> Roster::GiveUpSince(std::int64_t since_ns, std::int64_t begun_ns) {
  std::vector<std::string> names;
  std::erase_if(missing_, [&](const auto& one) {
    const bool given_up = one.second.since_ns.value_or(begun_ns) <= since_ns;
    if (given_up) names.push_back(one.second.name);
    return given_up;
  });
  return names;
}

bool Roster::AwaitsNewRun() const {
  return std::any_of(missing_.begin(), missing_.end(),
                     [](const auto& one) { return one.second.started_again; });
}

std::vector<std::string> Roster::missing() const {
  std::vector<std::string> names;
  for (const auto& [id, entry] : missing_) names.push_back(entry.name);
  return names;
}

std::optional<std::string> Roster::Refusal(std::uint64_t id, std::uint32_t run) const {
  const auto found = missing_.find(id);
  if (found == missing_.end() || run >= found->second.run) return std::nullopt;
  const std::string served = std::to_string(found->second.run);
  return "run " + std::to_string(run) + "; the service before this one served run " + served +
         "; allowed: run " + served + " or a higher one";
}

void Roster::Forget() {
  missing_.clear();
  greatest_grant_ = Instant::Always();
}

}  // namespace collision::server
