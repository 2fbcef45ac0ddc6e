// The part of a step that moves the world's time on and detects.
#pragma once

#include <functional>
#include <optional>

#include "server/detectors/detectors.h"
#include "server/intake/followed_rounds.h"
#include "server/intake/intake.h"
#include "server/publish/publisher.h"
#include "server/publish/status.h"
#include "server/service/reports/share_report.h"
#include "server/world/world.h"

namespace collision::server {

/// What this part of a step works on; all of it outlives the DetectionStep.
struct DetectionParts {
  World& world;
  Intake& intake;
  FollowedRounds& rounds;
  Detectors& detectors;
  Publisher& publisher;
  StatusSchedule& schedule;
};

/// Brings the detectors to the world's time and publishes what they find: contacts first, then
/// levels, then what hypothetical agents would meet, on which nothing but their own clearances
/// depends; grants last. One thread.
class DetectionStep {
 public:
  /// `progress` is called after each bounded piece of the detectors' work.
  DetectionStep(const DetectionParts& parts, std::function<void()> progress)
      : parts_(parts), progress_(std::move(progress)) {}

  /// Brings into effect what was told, moves the world's time as far as it may go, and detects.
  void MoveOn(bool inputs);

  /// Detects at the world's time. With a simulated clock only inputs and releases change anything.
  void Detect(bool inputs);

  /// The end of the round, if it is over: then everything in it is known.
  std::optional<Instant> NextRound() const;

  /// Time begins anew.
  void BeginEpoch() { advanced_to_.reset(); }

  /// Whether anything was detected in this epoch.
  bool has_detected() const { return advanced_to_.has_value(); }

  /// For the status: those of ShareReport.
  void AddExtensions(std::vector<v1::KeyValue>* extensions) const {
    shares_.AddExtensions(extensions);
  }

 private:
  void TakeLast();
  void DetectContacts();
  void DetectLevels();
  void Screen();

  const DetectionParts parts_;
  const std::function<void()> progress_;
  ShareReport shares_;
  std::optional<Instant> advanced_to_;
};

}  // namespace collision::server
