#include "client/programs/gateway/scene/event_book.h"

#include "client/library/network/conversion.h"
#include "client/programs/tools/collisionctl/events/event_filter.h"
#include "client/programs/tools/collisionctl/json/event_json.h"
#include "collision/event_text.h"

namespace collision::gateway {
namespace {

using client::JsonObject;

bool IsOpen(v1::EventStatus status) {
  return status == v1::EVENT_POSSIBLE || status == v1::EVENT_CONFIRMED;
}

std::string BracketJson(const v1::TimeBracket& bracket) {
  return JsonObject()
      .Instant("earliest", bracket.earliest_ns())
      .Instant("latest", bracket.latest_ns())
      .Json();
}

std::string KeyText(std::uint64_t number) { return "event/" + std::to_string(number); }

}  // namespace

void EventBook::Take(const v1::CollisionEvent& event) {
  const v1::ServiceStamp& stamp = event.stamp();
  if (stamp.service_id() == service_ && stamp.epoch() < epoch_) return;  // of a former epoch
  if (const auto ended = slots_.Take(event)) Supersede(*ended);
  const Key key = client::KeyOf(event);
  const auto [place, is_new] = events_.try_emplace(key);
  Entry& entry = place->second;
  if (is_new) {
    entry.number = ++last_;
    by_age_[entry.number] = key;
  }
  const bool is_of_another = entry.newest.stamp().service_id() == stamp.service_id() &&
                             entry.newest.stamp().epoch() < stamp.epoch();
  if (is_of_another) entry.revisions.clear();
  entry.newest = event;
  entry.is_superseded = false;
  entry.revisions.push_back({.now_ns = event.now_ns(),
                             .begin = event.begin(),
                             .end = event.end(),
                             .status = event.status()});
  if (entry.revisions.size() > kRevisionsMax) {
    std::vector<Revision> kept;
    for (std::size_t i = 1; i < entry.revisions.size(); i += 2) kept.push_back(entry.revisions[i]);
    if (entry.revisions.size() % 2 == 1) kept.push_back(entry.revisions.back());
    entry.revisions = std::move(kept);
  }
  changed_.insert(key);
  if (events_.size() > kEventsMax) DropOldest();
}

void EventBook::Supersede(const Key& key) {
  const auto former = events_.find(key);
  if (former == events_.end() || former->second.newest.status() != v1::EVENT_POSSIBLE) return;
  former->second.is_superseded = true;
  changed_.insert(key);
}

/// The oldest that is over; where none is, the oldest.
void EventBook::DropOldest() {
  auto oldest = by_age_.begin();
  for (auto next = by_age_.begin(); next != by_age_.end(); ++next) {
    const Entry& entry = events_.at(next->second);
    if (IsOpen(entry.newest.status()) && !entry.is_superseded) continue;
    oldest = next;
    break;
  }
  Drop(oldest);
}

void EventBook::Drop(std::map<std::uint64_t, Key>::iterator oldest) {
  dropped_.push_back(KeyText(oldest->first));
  changed_.erase(oldest->second);
  events_.erase(oldest->second);
  by_age_.erase(oldest);
}

void EventBook::ForgetEpochsBefore(const v1::ServiceStamp& stamp, std::uint64_t service) {
  if (service == service_ && stamp.epoch() == epoch_) return;
  service_ = service;
  epoch_ = stamp.epoch();
  for (auto next = by_age_.begin(); next != by_age_.end();) {
    const auto one = next++;
    const v1::ServiceStamp& told = events_.at(one->second).newest.stamp();
    if (told.service_id() == service && told.epoch() < stamp.epoch()) Drop(one);
  }
}

std::vector<EventBook::Shown> EventBook::TakeChanged(const client::WorldView& view) {
  std::vector<Shown> pages;
  for (std::string& key : std::exchange(dropped_, {})) pages.push_back({std::move(key), ""});
  for (const Key& key : std::exchange(changed_, {})) {
    const Entry& entry = events_.at(key);
    pages.push_back({KeyText(entry.number), JsonOf(entry, view)});
  }
  return pages;
}

std::string EventBook::JsonOf(const Entry& entry, const client::WorldView& view) {
  const auto full_name = [&view](const client::AgentId& id) { return view.FullName(id); };
  const std::string sentence = client::EventSentence(client::FromMessage(entry.newest), full_name,
                                                     client::NowOf(entry.newest, view), 0);
  std::vector<std::string> revisions;
  for (const Revision& revision : entry.revisions) {
    JsonObject one;
    one.Instant("now", revision.now_ns)
        .Add("begin", BracketJson(revision.begin))
        .Add("end", BracketJson(revision.end))
        .Text("status", client::Name(static_cast<client::EventStatus>(revision.status)));
    revisions.push_back(one.Json());
  }
  return JsonObject()
      .Text("item", "event")
      .Text("key", KeyText(entry.number))
      .Flag("superseded", entry.is_superseded)
      .Add("event", client::EventJson(entry.newest, view, sentence))
      .Add("revisions", client::JsonArray(revisions))
      .Json();
}

}  // namespace collision::gateway
