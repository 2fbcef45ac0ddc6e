// Files by their descriptors.
#pragma once

#include <string>

namespace collision::server {

/// What an errno means, as text: "No space left on device".
std::string CauseOf(int error_number);

/// Writes all of `bytes` to a descriptor, however many calls that takes. Returns 0, or the errno of
/// the call that failed; some bytes may then be written.
int WriteAll(int file, const std::string& bytes);

/// Whether an open file has been removed: what is written to it nobody will find.
bool IsRemoved(int file);

}  // namespace collision::server
