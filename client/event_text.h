// Collision events for people to read.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "idl/messages.pb.h"

namespace collision::client {

/// Gives the name of an agent for a text, or something in its place if it is not known.
using AgentNamer = std::function<std::string(const v1::AgentId&)>;

enum class Rounding { kDown, kUp };

/// An instant in seconds since `origin_ns` with 0 to 9 decimals, "599.734"; INT64_MAX reads
/// "never".
std::string SecondsText(std::int64_t instant_ns, std::int64_t origin_ns, int decimals,
                        Rounding rounding = Rounding::kDown);

/// The same of a lock-step world. Without an origin an instant beyond 1e17 ns, of a wall clock,
/// reads as its time of day in UTC: "22:24:55.022".
std::string TimeText(std::int64_t instant_ns, std::int64_t origin_ns, int decimals,
                     Rounding rounding = Rounding::kDown);

/// TimeText() with its unit: "599.734 s", "22:24:55.022 UTC", "never".
std::string InstantText(std::int64_t instant_ns, std::int64_t origin_ns, int decimals);

/// The text, filled up with spaces to a number of characters (not bytes: names may be UTF-8).
std::string Padded(std::string text, std::size_t columns);

/// "possible", "confirmed", "dismissed", "undecided", "withdrawn" or "ended".
const char* StatusText(v1::EventStatus status);

/// The event in one line without a newline, columns in the same places from line to line:
///   599.734 s  confirmed  iridium-33 × cosmos-2251  #1 r3  begin [599.734236, 599.734370]  end
///   open  gap ≤ -0.12 m
/// Times are seconds since `origin_ns` (0 in lock-step), or times of day as TimeText() has them;
/// brackets and gap are rounded outward. #1 is the ordinal of the pair's contacts, r3 the revision.
/// `begin ≤ b (began before)`: they may have touched before the pair was known, or before one of
/// them jumped. `end ≥ t`: still in contact at t. An undecided event has neither, but
/// `not certified free in [a, b]`. The gap is the distance of the surfaces where it was last
/// evaluated, negative inside. Where sphere trees have judged two shapes, it is a bracket, followed
/// by what is known of a contact, and by how deep the trees were searched and why not deeper:
///   gap [-0.31, -0.012] m  depth ≥ 0.012 m  at (1.20, -3.41, 0.88) ± 0.16 m
///   normal (0.981, 0.195, 0.000) ± 4.2°  level 6, 1840 units, limited by budget
std::string EventLine(const v1::CollisionEvent& event, const AgentNamer& name,
                      std::int64_t origin_ns);

}  // namespace collision::client
