// The extensions of a service's hello: what its configuration says of who meets whom, and what of
// it is told.
#pragma once

#include <string_view>

namespace collision::wire {

/// "class.NAME": the classes that this one lists, separated by blanks. Two classes meet if either
/// lists the other. Either all classes are told, or none, since there is no room for them.
inline constexpr std::string_view kClassExtension = "class.";

/// How many pairs of agents the configuration excludes.
inline constexpr std::string_view kExcludedExtension = "excluded";

/// The names of the levels that the configuration has, separated by blanks. Not told if there is no
/// room for all.
inline constexpr std::string_view kLevelsExtension = "levels";

}  // namespace collision::wire
