// From verdicts over segments of time to the begin and end brackets of contacts.
#pragma once

#include <vector>

#include "collision_core/detection/collision_event.h"
#include "collision_core/narrow_phase/contact/shape_contact.h"

namespace collision::detection {

/// How near the two are at one instant.
struct Nearest {
  Instant at = Instant::Never();  ///< Never(): none.
  narrow_phase::Proximity found;
  bool exhausted = false;  ///< For want of work something was not looked at.
};

/// One stretch of time in which a pair was not certified free.
struct ContactEpisode {
  bool contact = false;  ///< Certified at some instant; false: undecided.
  TimeBracket begin;     ///< {freedom certified up to, first certified contact}.
  TimeBracket
      end;  ///< {contact certified up to, first certified freedom}; latest open until it ends.
  bool continuous = true;
  bool began_before = false;
  bool exhausted = false;  ///< For want of work something was not looked at.
  /// Where, of the instants looked at, the surfaces were certified to be nearest.
  Nearest nearest;
  /// Of shapes: how they came near each other.
  narrow_phase::ContactNormal normal;
};

/// Follows one pair through time, segment after segment without a gap. Copyable: a copy that runs
/// ahead of what is settled is a preview.
class ContactTracker {
 public:
  /// The pair is certified free up to `free_until`. `began_before`: what came earlier is not known.
  ContactTracker(Instant free_until, bool began_before);

  /// Everything up to here has been judged; while free, freedom is certified up to here.
  Instant at() const { return at_; }
  bool free() const { return !open_; }
  bool in_contact() const { return open_ && episode_.contact; }

  /// The open episode; meaningful unless free().
  const ContactEpisode& episode() const { return episode_; }

  /// Freedom is certified continuously up to here; the begin of the open episode otherwise.
  Instant free_until() const { return open_ ? episode_.begin.earliest : at_; }

  /// What came before free_until() is not known.
  bool began_before() const { return open_ ? episode_.began_before : began_before_; }

  /// While free: freedom is certified further, or (a bound was broken) only up to `until`.
  void ExtendFree(Instant until);
  void RetractFree(Instant until, bool began_before);

  /// The verdict on [at(), to]; `nearest` is given where the verdict is not all free, `normal` where
  /// shapes came near each other.
  void Apply(const narrow_phase::SegmentResult& said, Instant to, const Nearest& nearest,
             const narrow_phase::ContactNormal& normal);

  /// Episodes that have ended since the last call.
  std::vector<ContactEpisode> TakeFinished();
  const std::vector<ContactEpisode>& finished() const { return finished_; }

 private:
  void Open(Instant free_until, const narrow_phase::ContactNormal& normal);
  void Close(Instant free_from);
  void Touch(const narrow_phase::SegmentResult& verdict, Instant from, Instant to);

  Instant at_;
  bool open_ = false;
  bool began_before_;
  Instant contact_until_ = Instant::Always();  // contact certified without a gap up to here
  ContactEpisode episode_;
  std::vector<ContactEpisode> finished_;
};

}  // namespace collision::detection
