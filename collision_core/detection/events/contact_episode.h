// An interval of time in which two agents may have touched, and what is known about it.
#pragma once

#include <span>

#include "collision_core/detection/events/collision_event.h"
#include "collision_core/narrow_phase/contact/shape_contact.h"

namespace collision::detection {

/// The instant of an episode at which the two agents are nearest, and how near they are there.
struct NearestInstant {
  Instant at = Instant::Never();  ///< Never(): none was evaluated.
  narrow_phase::Proximity found;  ///< Separation, point and normal at `at`.
  bool exhausted = false;         ///< The work budget ended the search early.
};

/// One interval of time in which a pair was not certified free: a contact, or a doubt (neither
/// contact nor freedom is certified).
struct ContactEpisode {
  bool contact = false;  ///< Contact is certified at some instant; false: undecided.
  TimeBracket begin;     ///< As CollisionEvent::begin.
  TimeBracket end;       ///< As CollisionEvent::end; `latest` is Never() while the episode is open.
  bool continuous = true;              ///< As CollisionEvent::continuous.
  bool began_before = false;           ///< It may have begun before the pair's known past.
  bool exhausted = false;              ///< The work budget ended some search early.
  NearestInstant nearest;              ///< Of those evaluated.
  narrow_phase::ContactNormal normal;  ///< For shapes: the direction in which they approached.
};

/// What is known about a pair at one step: the *settled* past, which no later state changes, and a
/// preview of the *heard* time after it, which both owners have reported and later states narrow
/// (PairEvaluator). Holds views into the pair's trackers, valid as long as these are not changed.
struct PairOutlook {
  /// Episodes settled since the last report, in the order of time.
  std::span<const ContactEpisode> settled;
  /// Episodes that have ended within the heard time, in the order of time; not settled yet.
  std::span<const ContactEpisode> heard;
  /// The episode that is open at the preview's end; null: free there.
  const ContactEpisode* open = nullptr;
  bool settled_free = true;   ///< No episode is open where the settled past ends.
  Instant free_until;         ///< Free up to here, or the begin of the open episode.
  bool began_before = false;  ///< What happened before free_until is not known.

  bool free() const { return open == nullptr; }
  bool in_contact() const { return open != nullptr && open->contact; }
};

}  // namespace collision::detection
