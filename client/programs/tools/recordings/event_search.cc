#include "client/programs/tools/recordings/event_search.h"

#include <algorithm>
#include <charconv>
#include <cstdio>

#include "client/library/network/conversion.h"
#include "client/programs/shared/exit_code.h"
#include "client/programs/shared/forecast_slots.h"
#include "client/programs/tools/collisionctl/events/event_filter.h"

namespace collision::client {
namespace {

constexpr std::size_t kContactsMax = 10;

/// Of contact itself, and not only possible.
bool IsContact(const v1::CollisionEvent& event) {
  return event.contacts_sequence() > 0 && event.level().empty() &&
         event.status() != v1::EVENT_WITHDRAWN;
}

bool IsOpen(const v1::CollisionEvent& event) {
  return event.status() == v1::EVENT_POSSIBLE || event.status() == v1::EVENT_CONFIRMED;
}

std::string LineOf(const v1::CollisionEvent& event, const WorldView& view) {
  char begin[32];
  std::snprintf(begin, sizeof begin, "%.6f s",
                1e-9 * static_cast<double>(event.begin().earliest_ns()));
  return "  " + std::to_string(event.contacts_sequence()) + "  " +
         view.FullName(FromMessage(event.lower())) + " - " +
         view.FullName(FromMessage(event.higher())) + ", begins at " + begin + "\n";
}

}  // namespace

EventSearch::EventSearch(const std::string& wanted) {
  if (wanted.empty()) return;
  std::uint64_t number = 0;
  const char* end = wanted.data() + wanted.size();
  const auto [read, failed] = std::from_chars(wanted.data(), end, number);
  if (failed == std::errc() && read == end && number > 0) {
    number_ = number;
    return;
  }
  const std::size_t comma = wanted.find(',');
  if (comma == std::string::npos || comma == 0 || comma + 1 == wanted.size()) {
    throw BadInput("--around \"" + wanted +
                   "\"; allowed: the number of a contact (contacts_sequence of collisionctl events "
                   "--json), or two agents: ada,bob");
  }
  agents_ = {wanted.substr(0, comma), wanted.substr(comma + 1)};
}

bool EventSearch::Fits(const v1::CollisionEvent& event, const WorldView& view) const {
  if (!event.level().empty()) return false;
  if (number_) return event.contacts_sequence() == *number_;
  if (agents_.empty()) return IsContact(event);
  const AgentId lower = FromMessage(event.lower()), higher = FromMessage(event.higher());
  const auto are = [&](const std::string& a, const std::string& b) {
    return IsCalled(lower, a, view) && IsCalled(higher, b, view);
  };
  return are(agents_[0], agents_[1]) || are(agents_[1], agents_[0]);
}

void EventSearch::Take(const v1::CollisionEvent& event, const WorldView& view) {
  if (event.status() == v1::EVENT_CONFIRMED && IsContact(event) &&
      contacts_.size() < kContactsMax) {
    contacts_.push_back(LineOf(event, view));
  }
  const bool is_newer = found_ && KeyOf(*found_) == KeyOf(event);
  const bool is_better =
      Fits(event, view) && (!found_ || (IsContact(event) && !IsContact(*found_)));
  if (is_newer || is_better) found_ = event;
}

bool EventSearch::is_settled() const { return found_ && IsContact(*found_) && !IsOpen(*found_); }

std::string EventSearch::Contacts() const {
  std::string lines;
  for (const std::string& line : contacts_) lines += line;
  return lines;
}

}  // namespace collision::client
