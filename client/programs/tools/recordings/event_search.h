// Finding an event of a recording by what people call it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "client/programs/shared/world_view.h"

namespace collision::client {

/// What `--around` says: nothing (the first contact), the number of a contact ("7", which one of
/// its revisions has as contacts_sequence), or two agents
/// ("ada,bob"; each AGENT or SIMULATOR:AGENT), of which it is the first contact, or else their
/// first event. Takes the events of a replay, one revision after the other. One thread.
class EventSearch {
 public:
  /// Throws BadInput if it is none of these.
  explicit EventSearch(const std::string& wanted);

  void Take(const v1::CollisionEvent& event, const WorldView& view);

  /// The newest revision of what fits best so far.
  const std::optional<v1::CollisionEvent>& found() const { return found_; }

  /// Nothing that comes can change it.
  bool is_settled() const;

  /// Some of the contacts that came, for one who found nothing: a line each.
  std::string Contacts() const;

 private:
  bool Fits(const v1::CollisionEvent& event, const WorldView& view) const;

  std::optional<std::uint64_t> number_;
  std::vector<std::string> agents_;
  std::optional<v1::CollisionEvent> found_;
  std::vector<std::string> contacts_;
};

}  // namespace collision::client
