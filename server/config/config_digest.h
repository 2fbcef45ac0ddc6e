// Whether two services are configured to find the same.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "idl/config.pb.h"

namespace collision::server {

/// A digest of all fields that decide what a service finds, refuses and grants; never 0. Equal for
/// configurations that differ only in FieldsWithoutResults(). Two that differ elsewhere have
/// different ones but for one chance in 2^64. A field at its default counts like one that is not
/// there, so that a new version with a new field still agrees with the one before it.
std::uint64_t ConfigurationDigest(const v1::Config& complete);

/// The fields that decide only where, when and how fast: paths as in the table of options.
std::span<const std::string_view> FieldsWithoutResults();

}  // namespace collision::server
