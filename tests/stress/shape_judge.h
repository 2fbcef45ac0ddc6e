// Judges when two rigid bodies touch, where the answer is closed.
#pragma once

#include <memory>

#include "collision_core/narrow_phase/contact/time_of_contact.h"
#include "collision_core/shape/shape.h"
#include "tests/stress/case.h"

namespace collision::stress {

/// A body that moves and turns with constant velocities, known exactly at the start.
struct Body {
  std::shared_ptr<const shape::Shape> shape = nullptr;  ///< Null: a ball of `radius`.
  double radius = 0;
  Eigen::Vector3d p{0, 0, 0}, v{0, 0, 0}, w{0, 0, 0};
  Eigen::Quaterniond q{1, 0, 0, 0};

  motion::SpaceTimeBound Bound() const;
};

std::shared_ptr<const shape::Shape> BoxShape(const Eigen::Vector3d& half, bool solid);

/// Both seen from a frame that moves along with A, as the service sees them.
narrow_phase::TimeOfContactResult FindContact(const Body& a, const Body& b, double duration,
                                              std::uint64_t units);

/// WorkBudget that is plenty for a pair of simple bodies.
inline constexpr std::uint64_t kPlenty = 2'000'000;

/// K of times of contact: a bracket is at most 1e-12 of the time wide, and K units in the last
/// place of where the bodies are and how large they are over their speed.
///
/// K is not derived: it is a power of two above the widest that was seen (96). What can be said
/// of it, in units of 2^-52 L, where L is place and size: freedom is followed up to a gap of
/// 2^-48 of all lengths (conservative_advancement.cc), 28 units at most, and 28 more for each L
/// that is flown within the duration; contact is shown from a depth of 2^-49 of them on
/// (SlackOf), 14 units. The rest is what the search makes of it, which ends where another step is
/// not worth its work (contact_boundary.cc: kStepGrowth, kWorthNarrowing): no bound of that is
/// known.
inline constexpr double kShapeUnits = 128;

/// Two bodies that touch on [begin, end], exactly, and what is asked of them.
struct ShapeMeeting {
  Body a, b;
  double duration = 0;             ///< Of the query [s].
  long double begin = 0, end = 0;  ///< [s].
  double speed = 0;                ///< At which they close [m/s].
};

/// The service finds the contact, and brackets its begin and end tightly.
void JudgeTimes(const ShapeMeeting& meeting, const std::string& what, Outcome* outcome);

/// When contact is possible, but not certain.
struct Stay {
  long double begin = 0, end = 0;  ///< [s].
  double unit = 0;                 ///< One in the last place of place and size, over the speed [s].
};

/// Contact is not excluded during the stay, and no sooner or later than a bracket may be wide.
void JudgeStay(const narrow_phase::TimeOfContactResult& found, const Stay& stay,
               const std::string& what, Outcome* outcome);

/// What holds of every answer: a finite, ordered one within the work allowed.
void JudgeForm(const narrow_phase::TimeOfContactResult& found, double duration, std::uint64_t units,
               const std::string& what, Outcome* outcome);

void SayTimes(Outcome* outcome);

}  // namespace collision::stress
