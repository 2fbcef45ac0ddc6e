// The pages of collisionctl, for people. Every page ends with a newline.
#pragma once

#include <string>
#include <vector>

#include "client/tools/collisionctl_view.h"

namespace collision::client {

/// Service, clock, simulators, broad phase and why, what is left out, refusals. The view has a
/// status.
std::string StatusPage(const WorldView& view);

/// A table of all agents: identity, declaration, newest state, how long they are clear.
std::string AgentsPage(const WorldView& view);

/// A table of all shapes that simulators have told: whose, of how many agents, how large, and how
/// much of it has been seen.
std::string ShapesPage(const WorldView& view);

/// Who can touch whom first, and not before when.
std::string EarliestPage(const WorldView& view);

/// Rows in aligned columns, the first row being the heading. All rows have the same number of
/// cells.
std::string Table(const std::vector<std::vector<std::string>>& rows);

}  // namespace collision::client
