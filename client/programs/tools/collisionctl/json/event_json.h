// Events for programs: documents of kind "event" and "gap", in one line each without a newline.
#pragma once

#include <cstdint>
#include <string>

#include "client/programs/shared/world_view.h"
#include "client/programs/tools/collisionctl/json/json_writer.h"

namespace collision::client {

/// Adds all that an event says: what is open, never or not evaluated is null.
void AddEvent(const v1::CollisionEvent& event, const WorldView& view, JsonObject* object);

/// `sentence`: EventSentence(), or empty. `told`: when it was published, UTC, or empty.
std::string EventJson(const v1::CollisionEvent& event, const WorldView& view,
                      const std::string& sentence, const std::string& told = {});

/// Among the events, where contacts were lost: how many since the last time, and in all.
std::string GapJson(std::uint64_t more, std::uint64_t so_far);

}  // namespace collision::client
