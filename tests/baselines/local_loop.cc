#include "tests/baselines/local_loop.h"

#include <algorithm>

#include "tests/baselines/frame_bounds.h"

namespace collision::baselines {
namespace {

/// How far ahead an agent is asked about [frames]: two seconds.
constexpr int kHorizonFrames = 120;

/// A pair goes back to the queue when nothing can happen for so many frames: less would make it
/// come back at once, and asking costs more than testing.
constexpr int kFramesApart = 4;

}  // namespace

void LocalLoop::Start(const MovingCubes& cubes) {
  const Instant now = InstantOf(cubes);
  keys_.assign(cubes.count(), now);
  partners_.resize(cubes.count());
  frame_of_bound_.assign(cubes.count(), -1);
  for (std::uint32_t cube = 0; cube < cubes.count(); ++cube) {
    Renew(cubes, cube);
    queue_.Set(AgentIndex(cube), now);
  }
}

bool LocalLoop::Renew(const MovingCubes& cubes, std::uint32_t cube) {
  if (frame_of_bound_[cube] == cubes.frame()) return false;
  ++work_.rebuilds;
  const bool is_new = frame_of_bound_[cube] < 0;
  frame_of_bound_[cube] = cubes.frame();
  const motion::SpaceTimeBound bound = BoundOf(cubes, cube);
  if (is_new) {
    phase_->Set(cube, bound);
  } else {
    phase_->Tighten(cube, bound);
  }
  return true;
}

bool LocalLoop::IsClose(std::uint32_t a, std::uint32_t b) const {
  return std::find(partners_[a].begin(), partners_[a].end(), b) != partners_[a].end();
}

void LocalLoop::Ask(const MovingCubes& cubes, std::uint32_t cube) {
  const Instant now = InstantOf(cubes), soon = InstantOf(cubes, 1);
  const Instant horizon = InstantOf(cubes, kHorizonFrames);
  const auto is_close = [&](std::uint32_t partner) { return IsClose(cube, partner); };
  Renew(cubes, cube);
  for (;;) {
    meetings_.clear();
    phase_->FindNeighbours(cube, {now, soon, horizon}, is_close, &meetings_);
    ++work_.queries;
    // A partner whose bound is old only seems near: renew it before it counts.
    bool renewed = false;
    Instant next = horizon;
    for (const broad_phase::Neighbour& meeting : meetings_) {
      renewed |= Renew(cubes, meeting.partner);
      next = std::min(next, std::max(meeting.time.instant(), soon));
    }
    if (renewed) continue;
    for (const broad_phase::Neighbour& meeting : meetings_) {
      if (meeting.time.instant() > soon) continue;
      close_.push_back(std::minmax(cube, meeting.partner));
      partners_[cube].push_back(meeting.partner);
      partners_[meeting.partner].push_back(cube);
    }
    if (next > soon || meetings_.empty()) {
      queue_.Set(AgentIndex(cube), keys_[cube] = next);
      return;
    }
  }
}

std::optional<CubePair> LocalLoop::TestClosePairs(const MovingCubes& cubes) {
  std::optional<CubePair> first;
  const Instant now = InstantOf(cubes), apart = InstantOf(cubes, kFramesApart);
  std::erase_if(close_, [&](const CubePair& pair) {
    const auto [a, b] = pair;
    Test(cubes, a, b, &first);
    const BallAgent ball_a = cubes.Ball(a), ball_b = cubes.Ball(b);
    const double reach = ball_a.radius + ball_b.radius;
    if ((ball_a.p_WA - ball_b.p_WA).squaredNorm() <= reach * reach) return false;
    const intersection::IntersectionTime time =
        intersection::EarliestIntersection(BoundOf(cubes, a), BoundOf(cubes, b), now);
    if (time.instant() <= apart) return false;
    std::erase(partners_[a], b), std::erase(partners_[b], a);
    if (time.instant() < keys_[a]) queue_.Set(AgentIndex(a), keys_[a] = time.instant());
    return true;
  });
  return first;
}

std::optional<CubePair> LocalLoop::Look(const MovingCubes& cubes) {
  if (keys_.empty()) Start(cubes);
  // What may meet before the next frame is looked at from now on.
  const Instant now = InstantOf(cubes);
  while (!queue_.empty() && queue_.top_key() <= now) Ask(cubes, queue_.top().value());
  return TestClosePairs(cubes);
}

}  // namespace collision::baselines
