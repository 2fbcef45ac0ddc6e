#include "server/publish/identity/event_labels.h"

namespace collision::server {

void AddLabels(const PairLabels& labels, v1::CollisionEvent* event) {
  if (labels.lower != nullptr) *event->mutable_lower_label() = *labels.lower;
  if (labels.higher != nullptr) *event->mutable_higher_label() = *labels.higher;
}

void EventLabels::Note(const detection::CollisionEvent& event, const World& world) {
  Pair& pair = pairs_[event.pair_slot];
  if (pair.lower != event.lower || pair.higher != event.higher) {
    pair = {.lower = event.lower, .higher = event.higher, .labels = {}};
  }
  if (auto lower = world.LabelOf(event.lower)) pair.labels.lower = std::move(lower);
  if (auto higher = world.LabelOf(event.higher)) pair.labels.higher = std::move(higher);
}

PairLabels EventLabels::Of(const detection::CollisionEvent& event) const {
  const auto found = pairs_.find(event.pair_slot);
  if (found == pairs_.end()) return {};
  const Pair& pair = found->second;
  return pair.lower == event.lower && pair.higher == event.higher ? pair.labels : PairLabels();
}

}  // namespace collision::server
