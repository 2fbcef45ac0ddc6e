// Values of a status that have no field of their own.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "idl/messages.pb.h"

namespace collision::client {

/// The counter of this name; 0 if the status has none.
std::uint64_t CounterOf(const v1::ServiceStatus& status, const std::string& name);

/// The counters of refusals by reason, or all others, "out_of_range 2, stale 1"; those that are 0
/// are left out, and without any it is "none".
std::string CountersText(const v1::ServiceStatus& status, bool rejections);

/// The extension of this key; empty if the status has none.
std::string ExtensionOf(const v1::ServiceStatus& status, const std::string& key);

/// The parts of a list in an extension, which a comma and a blank separate.
std::vector<std::string> Parts(const std::string& list);

/// A line "label  text" with its newline, the text in the same column for every label.
std::string Line(const std::string& label, const std::string& text);

}  // namespace collision::client
