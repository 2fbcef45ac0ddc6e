#include "server/world/silence/roster.h"

#include <algorithm>

namespace collision::server {

Roster::Roster(const std::vector<JournalledSimulator>& entries) {
  for (const JournalledSimulator& entry : entries) {
    missing_[entry.id] = entry;
    greatest_grant_ = std::max(greatest_grant_, entry.granted.value_or(Instant::Always()));
  }
}

void Roster::Arrive(std::uint64_t id, std::uint32_t run) {
  const auto found = missing_.find(id);
  if (found != missing_.end() && run >= found->second.run) missing_.erase(found);
}

bool Roster::GiveUp(const std::string& name) {
  return std::erase_if(missing_, [&](const auto& one) { return one.second.name == name; }) > 0;
}

std::vector<std::string> Roster::GiveUpAll() {
  std::vector<std::string> names = missing();
  missing_.clear();
  return names;
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
