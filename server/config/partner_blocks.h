// The blocks of `classes` and `excluded` in the configuration: which agents can meet at all.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "idl/config.pb.h"
#include "server/config/config_blocks.h"
#include "server/config/config_error.h"

namespace collision::server {

/// Blocks of `excluded` in one configuration.
inline constexpr int kExcludedPairsMax = 4096;

/// What a field of such a block may be; for a name that no field has, the names that there are.
std::string AllowedInPartnerBlock(const BlockOfPath& block, std::string_view field);

/// Adds what is wrong with the blocks: names that none can have, a class twice, one that meets a
/// class that is not there, a pair of one agent, and more blocks than there may be.
void CheckPartnerBlocks(const v1::Config& complete, std::vector<ConfigError>* errors);

}  // namespace collision::server
