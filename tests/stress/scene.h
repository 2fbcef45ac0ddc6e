// Agents whose motion is known in closed form, told to a detector step by step; what the detector
// says is judged against the truth.
#pragma once

#include <functional>
#include <map>
#include <vector>

#include "collision_core/detection/detector.h"
#include "tests/stress/case.h"

namespace collision::stress {

/// Seconds after the scene's start, in long double: closed forms lose nothing that counts.
using Seconds = long double;

/// The state of an agent so many seconds after the start; the stamp is filled in.
using Motion = std::function<MotionState(Seconds)>;

/// A motion with constant velocity. Exact where the numbers are dyadic.
Motion Straight(const Eigen::Vector3d& p, const Eigen::Vector3d& v);
/// With constant acceleration.
Motion Falling(const Eigen::Vector3d& p, const Eigen::Vector3d& v, const Eigen::Vector3d& a);

/// When two agents really touch.
struct Meeting {
  std::uint32_t a = 0, b = 0;
  Seconds begin = 0, end = 0;  ///< `end` may be +infinity.
  bool announced = false;
};

/// Judges while it runs, at every step: an announced time never lies behind a contact (never late),
/// brackets are finite and ordered, and the queue holds no more than agents and pairs.
class Scene {
 public:
  Scene(const DetectorOptions& options, Instant start, Outcome* outcome);

  /// At rest at the start of the scene or later; told every `every` steps.
  std::uint32_t Add(const AgentDeclaration& declaration, Motion motion, int every = 1);

  /// All that is true of who touches whom: pairs that are not named never do.
  void Touch(std::uint32_t a, std::uint32_t b, Seconds begin, Seconds end);

  /// One step to `now`: everybody whose turn it is tells a state, then the detector advances.
  void StepTo(Instant now);
  void Run(std::int64_t step_ns, int steps);

  /// Whether every contact was told, with brackets that contain the truth; nobody else touches. Begin
  /// brackets are at most `width` wide where contact is confirmed; `confirmed` says that all must be.
  void Judge(Seconds width, bool confirmed);

  const std::vector<CollisionEvent>& events() const { return events_; }
  Detector& detector() { return detector_; }
  Instant now() const { return now_; }
  Seconds elapsed() const { return Since(now_); }
  std::size_t events_per_step_max() const { return events_per_step_max_; }
  std::uint64_t work_per_step_max() const { return work_per_step_max_; }
  std::size_t queued_max() const { return queued_max_; }

 private:
  struct Agent {
    Motion motion;
    int every = 1;
  };

  AgentId IdOf(std::uint32_t agent) const { return {1, agent, 1, 1}; }
  Seconds Since(Instant t) const;
  MotionState StateAt(std::uint32_t agent, Instant t) const;
  void CheckAnnounced(Instant next);
  void TakeEvents();
  void CheckBrackets(const CollisionEvent& event);
  void CheckClearances();
  bool IsToldToTouch(const Meeting& meeting) const;
  const CollisionEvent* Covering(const Meeting& meeting) const;
  bool TouchAtAll(const CollisionEvent& event) const;

  Detector detector_;
  double announce_within_;
  Instant start_, now_;
  Outcome* outcome_;
  std::vector<Agent> agents_;
  std::vector<Meeting> meetings_;
  std::vector<CollisionEvent> events_;  ///< All revisions.
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::map<std::uint32_t, std::size_t>> newest_;
  int steps_ = 0;
  std::size_t events_per_step_max_ = 0, queued_max_ = 0;
  std::uint64_t work_per_step_max_ = 0;
};

/// "3 of 4 contacts confirmed, begins within 1.2e-09 s at most, ..."
void SayScene(const Scene& scene, Outcome* outcome);

}  // namespace collision::stress
