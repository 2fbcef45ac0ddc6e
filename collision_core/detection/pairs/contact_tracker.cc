#include "collision_core/detection/pairs/contact_tracker.h"

#include <algorithm>

#include "collision_core/numeric/seconds.h"

namespace collision::detection {
namespace {

// Two states that no motion joins are a breach (motion/contract_between.h), unless rounding
// explains it; and where states were thinned out, each may have followed from the one before with
// an error of its own, but the last not from the first. Then one bound gives freedom and another
// contact for the same time. Nothing is certain there, and the brackets contain both.
narrow_phase::SegmentResult WithoutContradiction(narrow_phase::SegmentResult result) {
  if (result.contact_from > result.contact_to) return result;
  const narrow_phase::SegmentResult given = result;
  if (given.free_until > given.contact_from) {
    result.free_until = given.contact_from;
    result.contact_from = given.free_until;
  }
  if (given.free_from < given.contact_to) {
    result.free_from = given.contact_to;
    result.contact_to = given.free_from;
  }
  return result;
}

}  // namespace

ContactTracker::ContactTracker(Instant free_until, Past past)
    : at_(free_until), began_before_(past == Past::kUnknown) {}

void ContactTracker::ExtendFree(Instant until) {
  if (until <= at_) return;
  at_ = until;
  began_before_ = false;
}

void ContactTracker::RetractFree(Instant until, Past past) {
  const bool began_before = past == Past::kUnknown;
  if (open_) {
    episode_.began_before |= began_before;
    return;
  }
  at_ = std::min(at_, until);
  began_before_ |= began_before;
}

void ContactTracker::Open(Instant free_until, const narrow_phase::ContactNormal& normal) {
  open_ = true;
  episode_ = ContactEpisode{};
  episode_.begin.earliest = free_until;
  episode_.began_before = began_before_;
  episode_.normal = normal;
  began_before_ = false;
}

void ContactTracker::OpenAt(Instant at) {
  CORE_CHECK(free() && at_ == at, "an episode opens where freedom ends", at.nanoseconds());
  Open(at, {});
}

void ContactTracker::Close(Instant free_from) {
  episode_.end.latest = free_from;
  if (!episode_.contact) {
    episode_.begin.latest = free_from;
    episode_.end.earliest = episode_.begin.earliest;
  }
  finished_.push_back(episode_);
  open_ = false;
  began_before_ = false;
}

// Contact on [contact_from, contact_to] of a segment that starts at `from`.
void ContactTracker::AddContact(const narrow_phase::SegmentResult& result, Instant from,
                                Instant to) {
  // Rounded outward: contact has begun by `first`, and lasts at least until `last`.
  const Instant first = std::min(numeric::AddRoundedUp(from, result.contact_from), to);
  const Instant last = std::min(numeric::AddRoundedDown(from, result.contact_to), to);
  const bool joins = episode_.contact && contact_until_ >= from && result.contact_from <= 0;
  if (!episode_.contact) {
    episode_.contact = true;
    episode_.begin.latest = first;
    episode_.end.earliest = std::min(numeric::AddRoundedDown(from, result.contact_from), to);
  } else if (!joins) {
    episode_.continuous = false;
  }
  if (!result.contact_continuous) {
    episode_.continuous = false;
    return;
  }
  if (episode_.continuous) {
    contact_until_ = last;
    episode_.end.earliest = last;
  }
}

void ContactTracker::Apply(const narrow_phase::SegmentResult& given, Instant to,
                           const NearestInstant& nearest,
                           const narrow_phase::ContactNormal& normal) {
  CORE_CHECK(to >= at_, "segments follow each other", at_.nanoseconds(), to.nanoseconds());
  const narrow_phase::SegmentResult result = WithoutContradiction(given);
  const Instant from = at_;
  const Instant free_until = numeric::AddRoundedDown(from, result.free_until);
  const bool free_throughout = free_until >= to;
  const bool free_at_start = result.free_until > 0;
  at_ = to;
  if (free_at_start) began_before_ = false;
  if (open_ && free_at_start) Close(from);
  if (free_throughout) return;
  if (!open_) Open(std::min(free_until, to), normal);
  episode_.exhausted |= nearest.exhausted;
  if (!nearest.at.is_never() &&
      (episode_.nearest.at.is_never() ||
       nearest.found.separation.upper < episode_.nearest.found.separation.upper)) {
    episode_.nearest = nearest;
  }
  if (confirms_ && result.contact_from <= result.contact_to) AddContact(result, from, to);
  const Instant free_from = numeric::AddRoundedUp(from, result.free_from);
  if (free_from < to) Close(free_from);
}

std::vector<ContactEpisode> ContactTracker::TakeFinished() {
  std::vector<ContactEpisode> finished;
  finished.swap(finished_);
  return finished;
}

PairOutlook OutlookOf(ContactTracker* settled, const ContactTracker& preview,
                      std::vector<ContactEpisode>* taken) {
  *taken = settled->TakeFinished();
  PairOutlook outlook;
  outlook.settled = *taken;
  outlook.heard = preview.finished();
  outlook.open = preview.free() ? nullptr : &preview.episode();
  outlook.settled_free = settled->free();
  outlook.free_until = preview.free_until();
  outlook.began_before = preview.began_before();
  return outlook;
}

}  // namespace collision::detection
