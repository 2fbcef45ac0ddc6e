// Agents whose motion is known in closed form, sent to a detector step by step; what the detector
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
using Motion = std::function<motion::MotionState(Seconds)>;

/// A motion with constant velocity. Exact where the numbers are dyadic.
Motion Straight(const Eigen::Vector3d& p, const Eigen::Vector3d& v);
/// With constant acceleration.
Motion Falling(const Eigen::Vector3d& p, const Eigen::Vector3d& v, const Eigen::Vector3d& a);

/// When two agents really touch.
struct Meeting {
  std::uint32_t a = 0, b = 0;
  Seconds begin = 0, end = 0;  ///< `end` may be +infinity.
  Seconds width = 0;           ///< The most of its brackets; 0: as of the scene.
  bool announced = false;
};

/// K of the distance of two balls in an event: its bracket is as wide as the motion within the
/// bounds since the last states leaves open, and K units in the last place of places and sizes.
///
/// Each of its ends is rounded outward by a unit of some of these at most, for each operation: the
/// time since the state, its product with the velocity, the sum with the place, the difference of
/// the two, a square, two sums, a root, the sum of the radii, that of what is open, and the
/// difference with either. These are 12; of the motion since the segment's start four more.
inline constexpr double kDistanceUnits = 2 * 16;

/// Judges while it runs, at every step: an announced time never lies behind a contact (never late),
/// brackets are finite and ordered, and the queue holds no more than agents and pairs.
class Scene {
 public:
  Scene(const detection::DetectorOptions& options, Instant start, Outcome* outcome);

  /// At rest at the start of the scene or later; sends a state every `every` steps.
  std::uint32_t Add(const detection::AgentDeclaration& declaration, Motion motion, int every = 1);

  /// All true contacts: pairs that are not named never touch.
  void Touch(std::uint32_t a, std::uint32_t b, Seconds begin, Seconds end, Seconds width = 0);

  /// One step to `now`: every agent whose turn it is sends a state, then the detector advances.
  void StepTo(Instant now);
  void Run(std::int64_t step_ns, int steps);

  /// From here on no clearance may be idle: a ball that could touch no other within the temporal
  /// resolution (where no ball accelerates, within announce_within) is clear for as long; nearer
  /// than that until it could, as the newest states go, if lengths were off by kPairUnits; but for
  /// a nanosecond. By exact arithmetic.
  void ForbidIdle() { idle_forbidden_ = true; }

  /// Whether each contact is reported, with brackets that contain the truth; no other pair touches.
  /// Begin and end brackets are at most `width` wide where contact is confirmed; `confirmed` says
  /// that all must be. What is not certified free is longer than the contact by 2 `width` at most,
  /// whether it is confirmed or in doubt. `end_width`, if it is not 0: of end brackets, where
  /// contact cannot be certain throughout.
  void Judge(Seconds width, bool confirmed, Seconds end_width = 0);

  const std::vector<detection::CollisionEvent>& events() const { return events_; }
  detection::Detector& detector() { return detector_; }
  const detection::Detector& detector() const { return detector_; }
  Instant now() const { return now_; }
  Seconds elapsed() const { return Since(now_); }
  std::size_t events_per_step_max() const { return events_per_step_max_; }
  std::uint64_t work_per_step_max() const { return work_per_step_max_; }
  std::size_t queued_max() const { return queued_max_; }

 private:
  struct Agent {
    Motion motion;
    int every = 1;
    detection::AgentDeclaration declaration;
    motion::SpaceTimeBound told;  ///< As of its newest state.
    /// How far off it was when, of all states.
    std::vector<std::pair<Instant, double>> places;
  };

  detection::AgentId IdOf(std::uint32_t agent) const { return {1, agent, 1, 1}; }
  Seconds Since(Instant t) const;
  const motion::MotionState& Tell(std::uint32_t agent, Instant t);
  void CheckAnnounced(Instant next);
  void TakeEvents();
  void CheckBrackets(const detection::CollisionEvent& event);
  void CheckClearances();
  void CheckDistance(const detection::CollisionEvent& event);
  void CheckIdle();
  bool CouldTouchBy(std::uint32_t agent, Instant until) const;
  bool IsToldToTouch(std::uint32_t a, std::uint32_t b) const;
  const detection::CollisionEvent* Covering(const Meeting& meeting) const;
  void JudgeWidth(const Meeting& meeting, const detection::CollisionEvent& event, Seconds width,
                  Seconds end_width);
  bool TouchAtAll(const detection::CollisionEvent& event) const;

  detection::Detector detector_;
  const detection::DetectorOptions options_;
  Instant start_, now_;
  Outcome* outcome_;
  std::vector<Agent> agents_;
  std::vector<Meeting> meetings_;
  std::vector<detection::CollisionEvent> events_;  ///< All revisions.
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::map<std::uint32_t, std::size_t>> newest_;
  bool idle_forbidden_ = false, anybody_accelerates_ = false;
  int steps_ = 0;
  std::size_t events_per_step_max_ = 0, queued_max_ = 0;
  std::uint64_t work_per_step_max_ = 0;
};

/// "3 of 4 contacts confirmed, begins within 1.2e-09 s at most, ..."
void SayScene(const Scene& scene, Outcome* outcome);

}  // namespace collision::stress
