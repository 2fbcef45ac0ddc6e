#include "server/service/level_step.h"

namespace collision::server {

void StepLevels(const std::function<void()>& progress, Detectors* detectors, World* world,
                Publisher* publisher) {
  detectors->AdvanceLevels(world->now(), progress);
  for (std::size_t level = 0; level < detectors->levels().size(); ++level) {
    LevelDetector& of = detectors->levels()[level];
    publisher->PublishLevelEvents(level, of.events(), *world);
    for (const auto& one : of.TakeChangedClearances()) world->SetClearanceOfLevel(level, one);
  }
}

void StepScreening(const std::function<void()>& progress, Detectors* detectors, World* world,
                   Publisher* publisher) {
  detectors->AdvanceScreening(world->now(), progress);
  ScreeningDetector* screening = detectors->screening();
  if (screening == nullptr) return;
  publisher->PublishScreening(screening->detector().events(), world);
  for (const auto& one : screening->TakeChangedClearances()) world->SetClearance(one);
}

}  // namespace collision::server
