// From results over segments of time to the begin and end brackets of contacts.
#pragma once

#include <vector>

#include "collision_core/base/check.h"
#include "collision_core/detection/events/contact_episode.h"

namespace collision::detection {

/// What is known about a pair before the time at which its tracking begins.
enum class Past {
  kKnown,   ///< The two were free of each other.
  kUnknown  ///< The two may have touched.
};

/// Follows one pair through time, segment after segment without a gap. Copyable: a copy that runs
/// ahead of what is settled is a preview.
class ContactTracker {
 public:
  /// The pair is certified free at `free_until`.
  ContactTracker(Instant free_until, Past past);

  /// Everything up to here has been evaluated; while free, freedom is certified up to here.
  Instant at() const { return at_; }
  bool free() const { return !open_; }
  bool in_contact() const { return open_ && episode_.contact; }

  /// The open episode. Requires !free().
  const ContactEpisode& episode() const {
    CORE_CHECK(open_, "only a pair that is not free has an open episode");
    return episode_;
  }

  /// Freedom is certified continuously up to here; the begin of the open episode otherwise.
  Instant free_until() const { return open_ ? episode_.begin.earliest : at_; }

  /// What happened before free_until() is not known.
  bool began_before() const { return open_ ? episode_.began_before : began_before_; }

  /// While free: freedom is certified further, up to `until`.
  void ExtendFree(Instant until);
  /// Takes back freedom certified beyond `until`, after an admission, jump, breach or widening.
  /// While an episode is open only `past` is recorded.
  void RetractFree(Instant until, Past past);

  /// Adds the result for [at(), to]; `nearest` is empty if no instant was evaluated: if all of it
  /// is free, or for a contact of two balls. `normal` is known only where shapes approached each
  /// other. Requires to >= at().
  void Apply(const narrow_phase::SegmentResult& given, Instant to, const NearestInstant& nearest,
             const narrow_phase::ContactNormal& normal);

  /// From here on freedom alone is certain: contacts that are added stay doubts.
  void ConfirmNothing() { confirms_ = false; }

  /// The two may touch at this instant, from which on nothing is known. Requires free() and at().
  void OpenAt(Instant at);

  /// Episodes that have ended since the last call.
  std::vector<ContactEpisode> TakeFinished();
  const std::vector<ContactEpisode>& finished() const { return finished_; }

 private:
  void Open(Instant free_until, const narrow_phase::ContactNormal& normal);
  void Close(Instant free_from);
  void AddContact(const narrow_phase::SegmentResult& result, Instant from, Instant to);

  Instant at_;
  bool open_ = false;
  bool confirms_ = true;
  bool began_before_;
  Instant contact_until_ = Instant::Always();  // contact certified without a gap up to here
  ContactEpisode episode_;
  std::vector<ContactEpisode> finished_;
};

/// The outlook for the announcer. Moves the finished episodes of `settled` into `taken`, which with
/// `preview` must outlive the outlook.
PairOutlook OutlookOf(ContactTracker* settled, const ContactTracker& preview,
                      std::vector<ContactEpisode>* taken);

}  // namespace collision::detection
