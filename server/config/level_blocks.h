// The blocks of `levels` in the configuration: how near is worth telling beside contact.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "idl/config.pb.h"
#include "server/config/config_error.h"

namespace collision::server {

/// The least margin [m] of a level: each of two agents grows by half of it.
inline constexpr double kLevelMarginMin = 2e-6;

/// What a field of a block may be; for a name that no field has, the names that there are.
std::string AllowedInLevelBlock(std::string_view field);

/// Adds what is wrong with the blocks: names that none can have or that occur twice, numbers out of
/// range, pairs of classes that are not there or cannot meet, and more blocks than there may be.
void CheckLevelBlocks(const v1::Config& complete, std::vector<ConfigError>* errors);

}  // namespace collision::server
