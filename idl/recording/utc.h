// Wall time as people and names of files have it: UTC.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace collision::wire {

/// "2026-11-29T03:00:00.123Z"; `wall_ns` since 1970.
std::string UtcText(std::int64_t wall_ns);

/// Likewise, for the name of a file: "20261129T030000.123Z". Equal times have equal texts, and a
/// later one sorts behind.
std::string UtcOfFile(std::int64_t wall_ns);

/// What UtcOfFile() gave; nullopt: the text is none.
std::optional<std::int64_t> FromUtcOfFile(const std::string& text);

/// What kUtcAllowed describes; nullopt: the text is none, or no such day or time.
std::optional<std::int64_t> FromUtc(const std::string& text);

inline constexpr char kUtcAllowed[] =
    "a time (UTC): 2026-11-28, 2026-11-28T03:00, "
    "2026-11-28T03:00:00 or 2026-11-28T03:00:00.5, with or "
    "without Z";

}  // namespace collision::wire
