// Up to when an agent is certified free of everybody that it is not tracked with.
#pragma once

#include <algorithm>
#include <vector>

#include "collision_core/base/instant.h"
#include "collision_core/detection/restlessness.h"

namespace collision::detection {

/// One key for each group beside the agent (Restlessness::GroupOf): that of the calm holds for
/// every class that has no earlier one.
class AgentKeys {
 public:
  /// The earliest of all.
  Instant first() const { return first_; }
  /// Of the calm ones; of nobody it is later.
  Instant calm() const { return calm_; }
  Instant of(int group) const {
    for (const OfClass& one : earlier_) {
      if (one.of_class == group) return std::min(one.key, calm_);
    }
    return calm_;
  }

  /// Of everybody.
  void SetAll(Instant key) {
    earlier_.clear();
    calm_ = first_ = key;
  }
  /// Of a restless class; not later than that of the calm ones.
  void SetRestless(int of_class, Instant key) {
    std::erase_if(earlier_, [=](const OfClass& one) { return one.of_class == of_class; });
    if (key < calm_) earlier_.push_back({key, of_class});
    NoteFirst();
  }
  void Lower(int group, Instant key) {
    if (group != Restlessness::kCalm) return SetRestless(group, std::min(of(group), key));
    calm_ = std::min(calm_, key);
    NoteFirst();
  }

  /// Appends the restless classes whose keys are not later than `until`.
  void RestlessUpTo(Instant until, std::vector<int>* classes) const {
    for (const OfClass& one : earlier_) {
      if (one.key <= until) classes->push_back(one.of_class);
    }
  }

 private:
  struct OfClass {
    Instant key;
    int of_class;
  };

  void NoteFirst() {
    first_ = calm_;
    for (const OfClass& one : earlier_) first_ = std::min(first_, one.key);
  }

  Instant calm_ = Instant::Always();
  Instant first_ = Instant::Always();
  std::vector<OfClass> earlier_;  // of restless classes, earlier than calm_ when they were set
};

}  // namespace collision::detection
