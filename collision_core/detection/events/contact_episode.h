// An interval of time in which two agents may have touched, and what is known about it.
#pragma once

#include <span>

#include "collision_core/detection/events/collision_event.h"
#include "collision_core/narrow_phase/contact/shape_contact.h"

namespace collision::detection {

/// How near the two are at one instant.
struct Nearest {
  Instant at = Instant::Never();  ///< Never(): at no instant.
  narrow_phase::Proximity found;
  bool exhausted = false;  ///< The work budget ended the search early.
};

/// One interval of time in which a pair was not certified free.
struct ContactEpisode {
  bool contact = false;  ///< Contact is certified at some instant; false: undecided.
  TimeBracket begin;     ///< [freedom certified up to, first certified contact].
  TimeBracket end;  ///< [contact certified up to, first certified freedom]; open while it lasts.
  bool continuous = true;     ///< No gap in certified contact from begin.latest to end.earliest.
  bool began_before = false;  ///< It may have begun before the pair's known past.
  bool exhausted = false;     ///< The work budget ended some search early.
  Nearest nearest;  ///< The instant, of those evaluated, with the least upper bound of separation.
  narrow_phase::ContactNormal normal;  ///< For shapes: the direction in which they approached.
};

/// What is known about a pair at one step: the settled past, and a preview up to what was heard.
/// Views into the pair's trackers, valid as long as these are not changed.
struct PairOutlook {
  /// Episodes settled since the last report, in the order of time.
  std::span<const ContactEpisode> settled;
  /// Episodes that have ended but are not settled yet.
  std::span<const ContactEpisode> heard;
  const ContactEpisode* open = nullptr;  ///< The one open at the preview's end; null: free there.
  bool settled_free = true;              ///< None is open at the end of the settled past.
  Instant free_until;                    ///< Free up to here, or the begin of the open episode.
  bool began_before = false;             ///< What happened before free_until is not known.

  bool free() const { return open == nullptr; }
  bool in_contact() const { return open != nullptr && open->contact; }
};

}  // namespace collision::detection
