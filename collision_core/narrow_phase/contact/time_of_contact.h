// When two moving bodies begin to touch, and when they cease to: the time of contact.
//
// Free. Sweeps (conservative_advancement.h) one after the other: a tangent leaves its circle by the
// square of the step, so each sweep squares what is left of the gap, and four of them lead from a
// quarter of a radian down to rounding. What rounding takes from a gap grows with the time since
// the start of a sweep, so the last one loses next to nothing. Nearest points a short way apart
// give no direction; there the normals and edges of the two triangles do: any direction is right,
// the best is taken.
//
// Touching. Half of the tolerance after freedom ends contact is searched, then four times as far,
// and so on, and narrowed by halves. Faces that meet in parallel and edges that coincide cross
// nowhere for certain. So contact_candidates.h proposes points in the middle of what lies on each
// other, and solid_point.h certifies them by distance and winding number: a contact of 1e-14 m is
// found that way. Open surfaces are certain by crossing triangles only. If none of it shows contact
// within the tolerance, queries of everything go on from there.
//
// Brief contacts. A ball at 10 km/s is through a plate in 50 µs. If 0.1 s is asked for, freedom may
// end long before it and contact be stepped over. So where the answer is not as narrow as asked
// for, it is searched again with a millionth of the tolerance, from both ends of what is left, down
// to 1e-12 of the time: what the finest tolerance finds is found at every one. Mostly that costs
// less than to ask for the finest at once; where what is not known of the motion limits the answer,
// up to about twice as much.
//
// Turning fast. Over spans in which a body turns by more than a full turn, each body is replaced by
// everything that it sweeps in one (swept_ring.h). More than kRotationAngleMax (10⁶ rad) after a
// state orientations are not followed: the body may be turned any way, as without a declared bound,
// and the answer says that its motion is not known.
//
// How narrow. With nothing uncertain, 1e-12 of the time, for cubes on faces, edges and corners as
// for tumbling stars, and for solids and their mixtures with triangles. With accelerations: free
// until closing speed and u(t) may have used up the gap, touching as soon as they certainly have,
// within a tenth of the least that any answer must leave. Touching all the time by nothing
// (resting, sliding) stays undecided, within 1e-14 m for cubes of 1 m. What turns thousands of
// times before it meets is known to about 2^-52 of its angle times its reach. Far from the origin
// both are seen from a frame that moves along with A's state (known_motion.cc): nothing is lost but
// what the differences of the states lose.
//
// Cost. Rocker-arm of 80,352 triangles against itself, 40 motions with up to 1.5 rad of turning,
// begin and end to 1e-6 each: with fitted balls 180,000 units in the median and 650,000 at most.
#pragma once

#include <optional>

#include "collision_core/base/work_budget.h"
#include "collision_core/narrow_phase/contact/contact_tolerance.h"
#include "collision_core/narrow_phase/pose/body_segment.h"
#include "collision_core/narrow_phase/pose/proximity.h"

namespace collision::narrow_phase {

enum class ContactStatus {
  kFree,      ///< Apart throughout, both ends included.
  kContact,   ///< Certainly touching within both brackets' inner ends.
  kUndecided  ///< They certainly come as near as `within`, and perhaps touch.
};

/// Seconds after the start of a segment; every claim holds for all motions within the bounds.
struct TimeOfContactResult {
  ContactStatus status = ContactStatus::kUndecided;
  /// kFree: `begin` and `end` are both {duration, duration}; the rest holds for the other two.
  /// Apart on [0, begin.lower), touching at begin.upper; {0, 0}: touching from the start.
  /// Undecided: the first contact, if any, begins within it.
  numeric::Interval begin;
  /// Touching at end.lower, apart after end.upper; {duration, duration}: touching at the end of the
  /// segment. The two may part in between. Undecided: the last contact, if any, ends within it.
  numeric::Interval end;
  double within = 0;  ///< Undecided: at some instant they are certainly no farther apart [m].
  /// What kept a bracket from being as narrow as asked; kNone: nothing did. kBudget: the work
  /// allowed. kMotion: what is not known of it, or turns beyond kRotationAngleMax, whatever the
  /// work allowed. kGeometry: they touch by less than rounding can tell, or graze, or are open
  /// surfaces that do not certainly cross.
  BracketLimit limited_by = BracketLimit::kNone;
  std::uint64_t work = 0;  ///< Units spent.
};

/// The first and the last contact of two rigid bodies within [0, duration]: conservative
/// advancement from both ends, with the direction of each pair of triangles that may touch, and
/// then certain contact as near to what is free as asked for.
///
/// It ends where both brackets are narrow enough, where no step leads any further, or where the
/// work is spent: then the brackets are what they are by then. No other limit cuts it short.
/// Turning is followed by at most a quarter of a radian a sweep, so that the work grows with the
/// turns between two states during which the two may meet. Requires that neither is awaited.
///
/// A library call: the service brackets contacts segment by segment (shape_contact.h), and this is
/// kept as the certified time of contact of two known motions, which is measured against the peers.
/// Callers: `./run bench precision` (tests/bench/pairs/contact_ours.cc), tests/stress, tests/fuzz
/// and tests.
TimeOfContactResult TimeOfContact(const BodySegment& a, const BodySegment& b, double duration,
                                  const ContactTolerance& tolerance, WorkBudget* work);

/// What is known of a body's motion over a segment: a state at or before its start, one at or after
/// its end, or both; nothing jumps in between.
struct KnownMotion {
  std::optional<motion::SpaceTimeBound> last;
  std::optional<motion::SpaceTimeBound> next;
  std::shared_ptr<const shape::Shape> shape = nullptr;  ///< Null: the ball itself.
};

/// The segments of two motions from `from` on, seen from a frame that moves along with A's state:
/// nothing is lost far from the origin, nor at high speed, but what the differences of the states
/// lose.
BodyPair SegmentsOf(const KnownMotion& a, const KnownMotion& b, Instant from);

/// The instants from `from` to `to`, both included.
struct TimeSpan {
  Instant from, to;
};

/// The same for two known motions over a span of time. The result is in seconds after `span.from`.
/// Requires span.from <= span.to.
TimeOfContactResult TimeOfContact(const KnownMotion& a, const KnownMotion& b, const TimeSpan& span,
                                  const ContactTolerance& tolerance, WorkBudget* work);

}  // namespace collision::narrow_phase
