// The blocks of `limits` in the configuration: what one simulator may have of the world's limits.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "idl/config.pb.h"
#include "server/config/config_error.h"

namespace collision::server {

/// Blocks of one configuration.
inline constexpr int kLimitBlocksMax = 64;

/// Whether the name fits the pattern, in which `*` stands for any characters. Of two patterns:
/// whether each name that fits the first one fits the second one too.
bool FitsPattern(const std::string& name, const std::string& pattern);

/// Whether the name of a block stands for several simulators.
bool IsPattern(std::string_view name);

/// What a field of a block may be, as far as its name says it: "0 to 1", "1 to agents_max of the
/// world"; for a name that no field has, the names that there are.
std::string AllowedInLimitBlock(std::string_view field);

/// Adds what is wrong with the blocks: values that the world does not allow, more blocks or names
/// than there may be, guarantees of more than everything, and a block that never counts because an
/// earlier one fits all of its names.
void CheckLimitBlocks(const v1::Config& complete, std::vector<ConfigError>* errors);

}  // namespace collision::server
