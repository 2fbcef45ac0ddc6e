#include "server/world/silence/progress.h"

#include <algorithm>

namespace collision::server {

void Progress::Update(const std::vector<TimeHolder>& holders, std::int64_t now_ns) {
  std::map<std::uint64_t, Standing> standing;
  for (const TimeHolder& holder : holders) {
    if (!holder.is_last) continue;
    Standing now{.told = holder.told, .since_ns = now_ns, .holds_up_since_ns = {}};
    const auto before = standing_.find(holder.id);
    const bool stood = before != standing_.end() && before->second.told == holder.told;
    if (stood) now.since_ns = before->second.since_ns;
    if (holder.others_wait) {
      now.holds_up_since_ns = stood && before->second.holds_up_since_ns
                                  ? before->second.holds_up_since_ns
                                  : std::optional(now_ns);
    }
    standing[holder.id] = now;
  }
  standing_ = std::move(standing);
}

std::optional<std::int64_t> Progress::StandsSince(std::uint64_t id) const {
  const auto found = standing_.find(id);
  if (found == standing_.end()) return std::nullopt;
  return found->second.since_ns;
}

std::optional<std::int64_t> Progress::HoldsUpSince(std::uint64_t id) const {
  const auto found = standing_.find(id);
  return found == standing_.end() ? std::nullopt : found->second.holds_up_since_ns;
}

bool Progress::IsNamed(std::uint64_t id, std::int64_t now_ns) const {
  const auto since_ns = StandsSince(id);
  return since_ns && now_ns - *since_ns >= named_after_ns_;
}

std::optional<std::int64_t> Progress::NextDue(std::int64_t now_ns) const {
  std::optional<std::int64_t> next;
  for (const auto& [id, standing] : standing_) {
    const std::int64_t due = standing.since_ns + named_after_ns_;
    if (due > now_ns) next = std::min(next.value_or(due), due);
  }
  return next;
}

}  // namespace collision::server
