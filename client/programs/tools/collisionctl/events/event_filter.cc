#include "client/programs/tools/collisionctl/events/event_filter.h"

#include <algorithm>
#include <limits>
#include <sstream>

#include "client/library/network/conversion.h"
#include "idl/hello_extensions.h"

namespace collision::client {
namespace {

/// a − b, kept within the range.
std::int64_t Difference(std::int64_t a, std::int64_t b) {
  std::int64_t difference = 0;
  if (!__builtin_sub_overflow(a, b, &difference)) return difference;
  return a > b ? kNever : std::numeric_limits<std::int64_t>::min();
}

}  // namespace

bool IsCalled(const AgentId& id, const std::string& name, const WorldView& view) {
  const std::string agent = view.Name(id);
  return name == agent || name == view.SimulatorName(id.simulator) + ":" + agent;
}

std::string UnknownLevelText(const EventFilter& filter, const WorldView& view) {
  const auto told = view.HelloExtension(std::string(wire::kLevelsExtension));
  if (!told) return "";
  std::vector<std::string> known = {kContactLevel};
  std::istringstream names(*told);
  for (std::string name; names >> name;) known.push_back(name);
  std::string allowed;
  for (const std::string& name : known) allowed += (allowed.empty() ? "" : ", ") + name;
  for (const std::string& level : filter.levels) {
    if (std::ranges::count(known, level) > 0) continue;
    return "--level: \"" + level + "\", allowed: " + allowed + ", the levels of this service";
  }
  return "";
}

std::string AbsentAgentsText(const EventFilter& filter, const WorldView& view) {
  const std::vector<AgentView> agents = view.Agents();
  std::string absent;
  for (const std::string& name : filter.agents) {
    const auto is_called = [&](const AgentView& agent) {
      return IsCalled(IdOf(agent), name, view);
    };
    if (std::ranges::any_of(agents, is_called)) continue;
    absent += (absent.empty() ? "" : ", ") + ("\"" + name + "\"");
  }
  if (absent.empty()) return "";
  return "--agent: no agent called " + absent +
         " is here yet; events are shown when one comes, and collisionctl agents lists those that "
         "are here";
}

std::optional<EventStatus> StatusOf(const std::string& name) {
  for (const EventStatus status :
       {EventStatus::kPossible, EventStatus::kConfirmed, EventStatus::kDismissed,
        EventStatus::kUndecided, EventStatus::kWithdrawn, EventStatus::kEnded}) {
    if (name == Name(status)) return status;
  }
  return std::nullopt;
}

bool IsExpected(const v1::CollisionEvent& event) {
  switch (event.status()) {
    case v1::EVENT_POSSIBLE:
      return event.has_expected() && event.expected().outcome() == v1::EXPECTED_TOUCH;
    case v1::EVENT_DISMISSED:
    case v1::EVENT_WITHDRAWN:
      return false;
    default:
      return true;
  }
}

std::int64_t LeadTime(const v1::CollisionEvent& event, std::int64_t now_ns) {
  const std::int64_t begin_ns = event.begin().earliest_ns();
  if (event.began_before()) return 0;
  if (begin_ns == kNever) return kNever;
  if (begin_ns > now_ns) return Difference(begin_ns, now_ns);
  if (event.status() != v1::EVENT_POSSIBLE) return 0;
  return std::max<std::int64_t>(0, Difference(begin_ns, event.now_ns()));
}

std::int64_t DistanceInTime(const v1::CollisionEvent& event, std::int64_t now_ns) {
  const std::int64_t end_ns = event.end().latest_ns();
  return end_ns < now_ns ? Difference(now_ns, end_ns) : LeadTime(event, now_ns);
}

bool IsOfEarlierEpoch(const v1::CollisionEvent& event, const WorldView& view) {
  if (!view.status()) return false;
  const v1::ServiceStamp& now = view.status()->stamp();
  return event.stamp().service_id() == now.service_id() && event.stamp().epoch() < now.epoch();
}

std::int64_t NowOf(const v1::CollisionEvent& event, const WorldView& view) {
  if (!view.status() || IsOfEarlierEpoch(event, view)) return event.now_ns();
  return std::max(view.status()->now_ns(), event.now_ns());
}

std::vector<v1::CollisionEvent> EventSelection::Of(std::vector<v1::CollisionEvent> events,
                                                   const WorldView& view) const {
  std::erase_if(events, [&](const auto& event) { return !Fits(event, view); });
  const auto order = [&](const v1::CollisionEvent& event) {
    const bool past = IsOfEarlierEpoch(event, view);
    const std::int64_t distance = past ? kNever : DistanceInTime(event, NowOf(event, view));
    return std::pair(!IsExpected(event), filter_.top ? distance : 0);
  };
  std::stable_sort(events.begin(), events.end(),
                   [&](const auto& a, const auto& b) { return order(a) < order(b); });
  if (!filter_.top) return events;
  if (events.size() > *filter_.top) events.resize(*filter_.top);
  return events;
}

bool EventSelection::Takes(const v1::CollisionEvent& event, const WorldView& view) {
  if (!Fits(event, view)) {
    remembered_.erase(KeyOf(event));
    return false;
  }
  return !filter_.top || IsNearest(event, NowOf(event, view));
}

bool EventSelection::IsNearest(const v1::CollisionEvent& event, std::int64_t now_ns) {
  v1::CollisionEvent& kept = remembered_[KeyOf(event)];
  kept = event;
  kept.clear_lower_label();
  kept.clear_higher_label();
  const std::int64_t own = DistanceInTime(event, now_ns);
  std::size_t nearer = 0;
  std::int64_t farthest_ns = 0;
  auto farthest = remembered_.begin();
  for (auto one = remembered_.begin(); one != remembered_.end(); ++one) {
    const std::int64_t distance = DistanceInTime(one->second, now_ns);
    nearer += distance < own;
    if (distance < farthest_ns) continue;
    farthest_ns = distance;
    farthest = one;
  }
  if (remembered_.size() > kRememberedMax) remembered_.erase(farthest);
  return nearer < *filter_.top;
}

bool EventSelection::Fits(const v1::CollisionEvent& event, const WorldView& view) const {
  const auto status = static_cast<EventStatus>(event.status());
  const auto& statuses = filter_.statuses;
  const bool any = statuses.empty();
  if (filter_.expected && status == EventStatus::kPossible && !IsExpected(event)) return false;
  if (!any && std::find(statuses.begin(), statuses.end(), status) == statuses.end()) return false;
  return IsOfLevels(event) && FitsInTime(event, view) && IsOfAgents(event, view);
}

bool EventSelection::IsOfLevels(const v1::CollisionEvent& event) const {
  const std::string level = event.level().empty() ? kContactLevel : event.level();
  return filter_.levels.empty() || std::ranges::count(filter_.levels, level) > 0;
}

bool EventSelection::FitsInTime(const v1::CollisionEvent& event, const WorldView& view) const {
  if (!filter_.since_ns && !filter_.within_ns) return true;
  if (IsOfEarlierEpoch(event, view)) return false;
  const std::int64_t now_ns = NowOf(event, view);
  if (filter_.since_ns && Difference(now_ns, event.now_ns()) > *filter_.since_ns) return false;
  return !filter_.within_ns || LeadTime(event, now_ns) <= *filter_.within_ns;
}

bool EventSelection::IsOfAgents(const v1::CollisionEvent& event, const WorldView& view) const {
  if (filter_.agents.empty()) return true;
  const AgentId lower = FromMessage(event.lower()), higher = FromMessage(event.higher());
  return std::any_of(filter_.agents.begin(), filter_.agents.end(), [&](const auto& name) {
    return IsCalled(lower, name, view) || IsCalled(higher, name, view);
  });
}

EventSelection::Key EventSelection::KeyOf(const v1::CollisionEvent& event) {
  return {FromMessage(event.lower()), FromMessage(event.higher()), event.level(), event.contact()};
}

}  // namespace collision::client
