#include "server/world/wall_clock/widenings.h"

#include <algorithm>

namespace collision::server {

void Widenings::Add(const Widening& widening) {
  std::vector<Waiting>& of_agent = waiting_[widening.agent];
  if (of_agent.size() == 2) of_agent.pop_back();
  of_agent.push_back({.revision = widening.revision});
}

void Widenings::Publish(std::uint64_t owner, const std::vector<Informed>& others,
                        std::int64_t now_ns, Waiting* waiting) const {
  waiting->is_published = true;
  waiting->until_ns = now_ns + expiry_ns_;
  for (const Informed& other : others) {
    if (other.simulator == owner || other.published <= other.acknowledged) continue;
    waiting->awaited[other.simulator] = other.published;
  }
}

bool Widenings::IsOver(const std::vector<Informed>& others, std::int64_t now_ns, Waiting* waiting) {
  for (const Informed& other : others) {
    const auto awaited = waiting->awaited.find(other.simulator);
    if (awaited == waiting->awaited.end() || other.acknowledged < awaited->second) continue;
    waiting->awaited.erase(awaited);
  }
  return waiting->awaited.empty() || now_ns >= waiting->until_ns;
}

std::vector<Widening> Widenings::Take(const std::vector<Informed>& others, std::int64_t now_ns) {
  std::vector<Widening> taken;
  for (auto& [agent, of_agent] : waiting_) {
    std::erase_if(of_agent, [&, id = agent](Waiting& waiting) {
      if (!waiting.is_published) Publish(id.simulator, others, now_ns, &waiting);
      if (!IsOver(others, now_ns, &waiting)) return false;
      taken.push_back({id, waiting.revision});
      return true;
    });
  }
  std::erase_if(waiting_, [](const auto& entry) { return entry.second.empty(); });
  return taken;
}

std::optional<std::int64_t> Widenings::NextDue() const {
  std::optional<std::int64_t> next;
  for (const auto& [agent, of_agent] : waiting_) {
    const std::int64_t until_ns = of_agent.front().until_ns;
    next = std::min(next.value_or(until_ns), until_ns);
  }
  return next;
}

}  // namespace collision::server
