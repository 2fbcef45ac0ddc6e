// When two moving bodies begin to touch, and when they cease to.
#pragma once

#include <optional>

#include "collision_core/narrow_phase/proximity.h"
#include "collision_core/narrow_phase/separation.h"

namespace collision {

/// How narrow a time is to be: whichever of the two is wider. What rounding and what is not known of
/// the motion leave open is wider at times; then the answer says so. A contact that is over sooner is
/// found all the same.
struct ContactTolerance {
  double absolute = 0;      ///< [s]
  double relative = 1e-12;  ///< Of the time itself, counted from the start.
};

enum class ContactStatus {
  kFree,      ///< Apart throughout, both ends included.
  kContact,   ///< Certainly touching within both brackets' inner ends.
  kUndecided  ///< They certainly come as near as `within`, and perhaps touch.
};

/// Seconds after the start of a segment; every claim holds for all motions within the bounds.
struct ContactTime {
  ContactStatus status = ContactStatus::kUndecided;
  /// Apart on [0, begin.lower), touching at begin.upper; {0, 0}: they touch from the start on.
  /// Undecided: if they touch, then first within it.
  Interval begin;
  /// Touching at end.lower, apart after end.upper; {duration, duration}: they touch at the end of
  /// the segment. In between they may have been apart. Undecided: likewise, if they touch.
  Interval end;
  double within = 0;  ///< Undecided: at some instant they are certainly no farther apart [m].
  /// What kept a bracket from being as narrow as asked; kNone: nothing did. kBudget: the work
  /// allowed. kMotion: what is not known of it, or turns beyond kTurnMax, whatever the work allowed.
  /// kGeometry: they touch by less than rounding can tell, or graze, or are open surfaces that do not
  /// certainly cross.
  EventLimit limited_by = EventLimit::kNone;
  std::uint64_t work = 0;  ///< Units spent.
};

/// The first and the last contact of two rigid bodies within [0, duration]: conservative advancement
/// from both ends, with the direction of each pair of triangles that may touch, and then certain
/// contact as near to what is free as asked for.
///
/// It ends where both brackets are narrow enough, where no step leads any further, or where the work
/// is spent: then the brackets are what they are by then. No other limit cuts it short. Turning is
/// followed by at most a quarter of a radian a sweep, so that the work grows with the turns between
/// two states during which the two may meet. Requires that neither is awaited.
ContactTime TimeOfContact(const BodySegment& a, const BodySegment& b, double duration,
                          const ContactTolerance& tolerance, Work* work);

/// What is known of a body's motion over a segment: a state at or before its start, one at or after
/// its end, or both; nothing jumps in between.
struct KnownMotion {
  std::optional<SpaceTimeBound> last;
  std::optional<SpaceTimeBound> next;
};

/// Both bodies over what follows `from`, seen from a frame that moves along with A's state: nothing
/// is lost far from the origin, nor at high speed, but what the differences of the states lose.
struct BodyPair {
  BodySegment a, b;
};
BodyPair SegmentsOf(const KnownMotion& a, const KnownMotion& b, Instant from);

/// As above, over [from, to], in seconds after `from`.
ContactTime TimeOfContact(const KnownMotion& a, const KnownMotion& b, Instant from, Instant to,
                          const ContactTolerance& tolerance, Work* work);

}  // namespace collision
