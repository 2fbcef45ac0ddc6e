#include "tests/baselines/window_loop.h"

#include <algorithm>

#include "tests/baselines/frame_bounds.h"

namespace collision::baselines {
namespace {

constexpr std::int64_t kFramesMax = 240;

/// The window is doubled below so many listed pairs for each cube, and halved above the other.
constexpr double kFewPairs = 0.1, kManyPairs = 0.5;

}  // namespace

bool WindowLoop::IsClear(const MovingCubes& cubes) {
  ++work_.questions;
  const auto earliest =
      phase_->Earliest({BoundKind::kHorn, InstantOf(cubes), InstantOf(cubes, frames_)});
  // The last frame before the meeting.
  covered_ = earliest ? (earliest->time.instant().nanoseconds() - 1) / MovingCubes::kFrameNs
                      : cubes.frame() + frames_;
  if (!earliest) frames_ = std::min(kFramesMax, 2 * frames_);
  return !earliest || covered_ - cubes.frame() >= frames_ / 2;
}

void WindowLoop::MakeList(const MovingCubes& cubes) {
  AllMeetings(phase_.get(), cubes.count(), InstantOf(cubes), InstantOf(cubes, frames_), &list_);
  work_.questions += cubes.count();
  std::sort(list_.begin(), list_.end());
  covered_ = cubes.frame() + frames_;
  const auto pairs = static_cast<double>(list_.size());
  if (pairs < kFewPairs * cubes.count()) frames_ = std::min(kFramesMax, 2 * frames_);
  if (pairs > kManyPairs * cubes.count()) frames_ = std::max<std::int64_t>(1, frames_ / 2);
}

void WindowLoop::Rebuild(const MovingCubes& cubes) {
  for (std::uint32_t cube = 0; cube < cubes.count(); ++cube) {
    phase_->Put(cube, BoundOf(cubes, cube));
  }
  work_.rebuilds += cubes.count();
  list_.clear();
  due_ = 0;
  if (!IsClear(cubes)) MakeList(cubes);
}

std::optional<CubePair> WindowLoop::Look(const MovingCubes& cubes) {
  if (cubes.frame() > covered_) Rebuild(cubes);
  const Instant now = InstantOf(cubes);
  while (due_ < list_.size() && list_[due_].time.instant() <= now) ++due_;
  std::optional<CubePair> first;
  for (std::size_t i = 0; i < due_; ++i) Test(cubes, list_[i].lower, list_[i].higher, &first);
  return first;
}

}  // namespace collision::baselines
