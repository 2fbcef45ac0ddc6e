#include "tests/baselines/global_loop.h"

#include "tests/baselines/frame_bounds.h"

namespace collision::baselines {
namespace {

/// How far ahead is asked [frames]: two seconds.
constexpr int kHorizonFrames = 120;

}  // namespace

std::optional<CubePair> GlobalLoop::Look(const MovingCubes& cubes) {
  const Instant now = InstantOf(cubes);
  if (now < t_end_) return std::nullopt;
  for (std::uint32_t cube = 0; cube < cubes.count(); ++cube) {
    const motion::SpaceTimeBound bound = BoundOf(cubes, cube);
    sweep_->Set(cube, bound);
    near_.Set(cube, bound);
  }
  work_.rebuilds += cubes.count();
  const intersection::BroadQuery query{intersection::BoundKind::kHorn, now,
                                       InstantOf(cubes, kHorizonFrames)};
  const auto earliest = sweep_->Earliest(query);
  ++work_.queries;
  t_end_ = earliest ? earliest->time.instant() : query.until;
  const Instant next_frame = InstantOf(cubes, 1);
  if (t_end_ > next_frame) return std::nullopt;
  t_end_ = next_frame;
  could_overlap_.clear();
  AllNeighbours(&near_, cubes.count(), now, now, &could_overlap_);
  work_.queries += cubes.count();
  std::optional<CubePair> first;
  for (const intersection::IntersectingPair& meeting : could_overlap_) {
    Test(cubes, meeting.lower, meeting.higher, &first);
  }
  return first;
}

}  // namespace collision::baselines
