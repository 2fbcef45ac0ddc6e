#include "collision_core/detection/events/contact_numbers.h"

#include <algorithm>

namespace collision::detection {

std::uint32_t ContactNumbers::Next(AgentIndex a, AgentIndex b) {
  CORE_CHECK(a != b, "a pair has two agents", a.value());
  const AgentIndex last_index = std::max(a, b);
  if (!agents_.contains(last_index)) agents_.resize(last_index.value() + 1);
  const std::uint32_t known = Take(a, b);
  Take(b, a);
  const std::uint32_t last =
      known != 0 ? known : std::max(agents_[a].given_up, agents_[b].given_up);
  Record(a, b, last + 1);
  Record(b, a, last + 1);
  return last + 1;
}

// 0: not known.
std::uint32_t ContactNumbers::Take(AgentIndex agent, AgentIndex partner) {
  std::vector<Number>& known = agents_[agent].known;
  const auto found = std::find_if(known.begin(), known.end(), [partner](const Number& number) {
    return number.partner == partner;
  });
  if (found == known.end()) return 0;
  const std::uint32_t last = found->last;
  known.erase(found);
  return last;
}

void ContactNumbers::Record(AgentIndex agent, AgentIndex partner, std::uint32_t number) {
  OfAgent& numbers = agents_[agent];
  if (numbers.known.size() == kPartnersMax) {
    const Number oldest = numbers.known.front();
    Take(agent, oldest.partner);
    Take(oldest.partner, agent);
    for (OfAgent* side : {&numbers, &agents_[oldest.partner]}) {
      side->given_up = std::max(side->given_up, oldest.last);
    }
  }
  numbers.known.push_back({partner, number});
}

void ContactNumbers::Forget(AgentIndex agent) {
  if (!agents_.contains(agent)) return;
  for (const Number& number : agents_[agent].known) Take(number.partner, agent);
  agents_[agent] = OfAgent();
}

void ContactNumbers::Validate() const {
  for (std::uint32_t a = 0; a < agents_.size(); ++a) {
    const std::vector<Number>& known = agents_[AgentIndex(a)].known;
    CORE_CHECK(known.size() <= kPartnersMax, "an agent keeps few numbers", a, known.size());
    for (const Number& number : known) {
      CORE_CHECK(agents_.contains(number.partner), "a partner is in the table", a);
      const std::vector<Number>& others = agents_[number.partner].known;
      const bool mirrored = std::any_of(others.begin(), others.end(), [&](const Number& other) {
        return other.partner == AgentIndex(a) && other.last == number.last;
      });
      CORE_CHECK(mirrored, "a number is kept with both agents", a, number.partner.value());
    }
  }
}

}  // namespace collision::detection
