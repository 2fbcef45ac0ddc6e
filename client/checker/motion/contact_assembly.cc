#include "client/checker/motion/contact_assembly.h"

#include <algorithm>

namespace collision::checker {
namespace {

bool Adjacent(long double end_ns, long double begin_ns) {
  return begin_ns - end_ns <= kRootTolerance;
}

}  // namespace

void ContactAssembly::AddBalls(long double begin_ns, long double end_ns) {
  if (!balls_.empty() && Adjacent(balls_.back().end, begin_ns)) {
    balls_.back().end = end_ns;
  } else {
    balls_.push_back({begin_ns, end_ns});
  }
}

void ContactAssembly::Add(Stretch::Kind kind, bool deep, long double begin_ns, long double end_ns) {
  const bool joins = !stretches_.empty() && stretches_.back().kind == kind &&
                     Adjacent(stretches_.back().end, begin_ns);
  if (joins) {
    stretches_.back().end = end_ns;
    stretches_.back().deep |= deep;
  } else {
    stretches_.push_back({kind, begin_ns, end_ns, deep});
  }
}

// Adjacent stretches make one contact. A stretch of kNear before or after it adds to the tolerance
// of its begin or end; one without a contact is a graze.
std::vector<TrueContact> ContactAssembly::Contacts(std::size_t a, std::size_t b,
                                                   long double start_ns, long double end_ns) const {
  std::vector<TrueContact> contacts;
  const Stretch* before = nullptr;  // adjacent to this one
  bool grazed = false;              // the last contact is no more than a graze so far
  for (const Stretch& stretch : stretches_) {
    if (before != nullptr && !Adjacent(before->end, stretch.begin)) before = nullptr;
    const bool near = stretch.kind == Stretch::Kind::kNear;
    if (near && before != nullptr) {
      contacts.back().end_tolerance_ns += stretch.end - stretch.begin;
      grazed = false;
    } else if (near) {
      contacts.push_back({a, b, stretch.begin, stretch.end, false, false, false});
      grazed = true;
    } else {
      const bool was_near = before != nullptr && before->kind == Stretch::Kind::kNear;
      if (was_near && grazed) contacts.pop_back();
      if (was_near || before == nullptr)
        contacts.push_back({a, b, stretch.begin, stretch.end, false, false, false});
      TrueContact& contact = contacts.back();
      if (was_near) contact.begin_tolerance_ns += before->end - before->begin;
      contact.end_ns = stretch.end;
      contact.certain |= stretch.deep;
      if (stretch.kind == Stretch::Kind::kBlind)
        contact.blind.push_back({stretch.begin, stretch.end});
    }
    before = &stretch;
  }
  for (TrueContact& contact : contacts) {
    contact.from_start = contact.begin_ns <= start_ns + contact.begin_tolerance_ns;
    contact.to_end = contact.end_ns >= end_ns - contact.end_tolerance_ns;
    contact.balls_until_ns = contact.end_ns;
    for (const Span& span : balls_) {
      if (span.begin <= contact.end_ns + kRootTolerance) contact.balls_until_ns = span.end;
    }
    contact.balls_until_ns = std::max(contact.balls_until_ns, contact.end_ns);
  }
  return contacts;
}

}  // namespace collision::checker
