#include "tests/baselines/frame_bounds.h"

namespace collision::baselines {

void AllMeetings(broad_phase::BroadPhase* phase, std::uint32_t agents, Instant from, Instant until,
                 std::vector<intersection::IntersectingPair>* meetings) {
  std::vector<broad_phase::Meeting> of_one;
  for (std::uint32_t agent = 0; agent < agents; ++agent) {
    of_one.clear();
    const auto is_told = [agent](std::uint32_t partner) { return partner < agent; };
    phase->Meetings(agent, from, until, until, is_told, &of_one);
    for (const broad_phase::Meeting& meeting : of_one) {
      meetings->push_back({agent, meeting.partner, meeting.time});
    }
  }
}

}  // namespace collision::baselines
