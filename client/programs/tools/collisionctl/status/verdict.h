// How a world is, in words: well, or what an operator should do something about.
#pragma once

#include <string>
#include <vector>

#include "client/programs/shared/world_view.h"

namespace collision::client {

/// Lines without newlines, the gravest first: "WAITS for beta: not heard for more than 12 s; ...",
/// "FAILS to record: ...", "REFUSES beta: ...", or else "WELL: ..." alone. Each says what is wrong
/// and what to do. Where one word has several causes, its line names them, and an indented line
/// for each follows. Requires a status.
std::vector<std::string> Verdict(const WorldView& view);

/// The room for names in a line of a page.
inline constexpr std::size_t kNamesColumns = 60;

/// The texts with ", " between them, as many as fit into `columns`, at least one; it ends with how
/// many are missing, and `further` ones: "a, b and 7 more".
std::string Shortened(const std::vector<std::string>& texts, std::size_t columns,
                      std::size_t further = 0);

}  // namespace collision::client
