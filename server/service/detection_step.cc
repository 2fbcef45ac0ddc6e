#include "server/service/detection_step.h"

#include "server/service/step_limits.h"

namespace collision::server {

void DetectionStep::MoveOn(bool inputs) {
  World& world = parts_.world;
  if (!world.RunsInRounds()) {
    parts_.intake.Enact();
    world.MoveOn();
    return Detect(inputs);
  }
  world.ShareGrant();
  for (int round = 0; round < kRoundsPerStepMax; ++round) {
    const std::optional<Instant> next = NextRound();
    if (!next) {
      if (inputs) TakeLast();
      return;
    }
    parts_.intake.Enact();
    world.MoveTo(*next);
    Detect(true);
    parts_.rounds.ApplyKept();
  }
}

// Who has finished may still remove its agents. All of them leave together, so that the events do
// not depend on who does so first.
void DetectionStep::TakeLast() {
  if (!parts_.world.HasNoRoundLeft() || !parts_.intake.AllLeave()) return;
  parts_.intake.Enact();
  Detect(true);
}

void DetectionStep::Detect(bool inputs) {
  World& world = parts_.world;
  if (!world.started()) return;
  if (world.simulated() && !inputs && world.now() == advanced_to_) return;
  advanced_to_ = world.now();
  DetectContacts();
  DetectLevels();
  Screen();
  world.UpdateGrants();
}

std::optional<Instant> DetectionStep::NextRound() const {
  return parts_.intake.AwaitsShapes() ? std::nullopt : parts_.world.NextNow();
}

void DetectionStep::DetectContacts() {
  World& world = parts_.world;
  detection::Detector& contacts = parts_.detectors.contacts();
  contacts.Advance(world.now(), progress_);
  if (shares_.Take(contacts.owner_work(), world)) parts_.schedule.Hasten();
  shares_.Write(world.monotonic_ns());
  parts_.publisher.PublishEvents(contacts.events(), world);
  for (const auto& one : contacts.TakeChangedClearances()) world.SetClearance(one);
}

void DetectionStep::DetectLevels() {
  World& world = parts_.world;
  std::vector<LevelDetector>& levels = parts_.detectors.levels();
  parts_.detectors.AdvanceLevels(world.now(), progress_);
  for (std::size_t level = 0; level < levels.size(); ++level) {
    parts_.publisher.PublishLevelEvents(level, levels[level].events(), world);
    for (const auto& one : levels[level].TakeChangedClearances())
      world.SetClearanceOfLevel(level, one);
  }
}

void DetectionStep::Screen() {
  World& world = parts_.world;
  parts_.detectors.AdvanceScreening(world.now(), progress_);
  ScreeningDetector* screening = parts_.detectors.screening();
  if (screening == nullptr) return;
  parts_.publisher.PublishScreening(screening->detector().events(), &world);
  for (const auto& one : screening->TakeChangedClearances()) world.SetClearance(one);
}

}  // namespace collision::server
