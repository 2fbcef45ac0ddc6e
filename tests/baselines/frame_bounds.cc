#include "tests/baselines/frame_bounds.h"

namespace collision::baselines {

void AllNeighbours(broad_phase::NeighbourIndex* phase, std::uint32_t agents, Instant from,
                   Instant until, std::vector<intersection::IntersectingPair>* meetings) {
  std::vector<broad_phase::Neighbour> of_one;
  for (std::uint32_t agent = 0; agent < agents; ++agent) {
    of_one.clear();
    const auto is_told = [agent](std::uint32_t partner) { return partner < agent; };
    phase->FindNeighbours(agent, {from, until, until}, is_told, &of_one);
    for (const broad_phase::Neighbour& meeting : of_one) {
      meetings->push_back({agent, meeting.partner, meeting.time});
    }
  }
}

}  // namespace collision::baselines
