// The pages of collisionctl, for people. Every page ends with a newline.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "client/programs/shared/world_view.h"

namespace collision::client {

/// A table of all agents: identity, declaration, newest state, how long they are clear, and where
/// the service holds one whose simulator is not heard, or does not hold it, why.
std::string AgentsPage(const WorldView& view);

/// A table of all shapes that simulators have published: owner, number of agents, size, and how
/// much of it has arrived.
std::string ShapesPage(const WorldView& view);

/// The pair that can touch first, and before when it certainly does not.
std::string EarliestPage(const WorldView& view);

/// Among the events, where contacts were lost: how many since the last time, and in all. Without a
/// newline.
std::string MissedLine(std::uint64_t more, std::uint64_t so_far);

/// How many contacts have come and how many were lost, when it ends. Without a newline.
std::string ContactsSummary(std::uint64_t told, std::uint64_t missed);

/// The time to the millisecond; "-" for a grant or clearance that was never given, which is the
/// least instant.
std::string SinceText(std::int64_t instant_ns);

/// The pair that can touch first, in one line, without a newline.
std::string EarliestText(const WorldView& view);

/// The value in a printf() `format` for one double, of at most 63 characters.
std::string NumberText(double value, const char* format);

/// Rows in aligned columns, the first row being the heading. All rows have the same number of
/// cells.
std::string Table(const std::vector<std::vector<std::string>>& rows);

}  // namespace collision::client
