// Collision events for people to read.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "collision/export.h"
#include "collision/types.h"

namespace collision::client {

/// Gives the name of an agent for a text, or a substitute if the name is not known.
using AgentNamer = std::function<std::string(const AgentId&)>;

enum class Rounding { kDown, kUp };

/// An instant in seconds since `origin_ns` with 0 to 9 decimals, "599.734"; kNever reads "never".
COLLISION_API std::string SecondsText(std::int64_t instant_ns, std::int64_t origin_ns, int decimals,
                                      Rounding rounding = Rounding::kDown);

/// The same for a lock-step world. Without an origin an instant beyond 1e17 ns belongs to a wall
/// clock and reads as its time of day in UTC: "22:24:55.022".
COLLISION_API std::string TimeText(std::int64_t instant_ns, std::int64_t origin_ns, int decimals,
                                   Rounding rounding = Rounding::kDown);

/// TimeText() with its unit: "599.734 s", "22:24:55.022 UTC", "never".
COLLISION_API std::string InstantText(std::int64_t instant_ns, std::int64_t origin_ns, int decimals,
                                      Rounding rounding = Rounding::kDown);

/// The text, padded with spaces to a number of characters (not bytes: names may be UTF-8).
COLLISION_API std::string Padded(std::string text, std::size_t columns);

/// Metres, or any other value, with three digits that are not above (down) or below (up) it.
COLLISION_API std::string MetresText(double value, Rounding rounding);

/// "crane-3 broke acceleration_max_m_s2: declared 2, at least 3.4 seen between 1.200 s and 1.300 s
/// (4 times)". What was seen is rounded down.
COLLISION_API std::string BreachText(const Breach& breach, const AgentNamer& name,
                                     std::int64_t origin_ns);

/// The event in one line without a newline, with columns at the same places in every line:
///   599.734 s  confirmed  iridium-33 × cosmos-2251  #1 r3  begin [599.734236, 599.734370]  end
///   open  gap ≤ -0.12 m
/// An event of a level names it before its begin.
/// Times are seconds since `origin_ns` (0 in lock-step), or times of day as in TimeText(); brackets
/// and gap are rounded outward. client/EVENTS.md explains each part.
COLLISION_API std::string EventLine(const Event& event, const AgentNamer& name,
                                    std::int64_t origin_ns);

/// The event in one plain sentence, as it looks at `now_ns`:
///   ada (people) and bob (people) will touch between 2.10 s and 2.11 s, at (4.2, 0.0, 0.0) m.
/// What is not certain is said so. Times as in EventLine().
COLLISION_API std::string EventSentence(const Event& event, const AgentNamer& name,
                                        std::int64_t now_ns, std::int64_t origin_ns);

}  // namespace collision::client
