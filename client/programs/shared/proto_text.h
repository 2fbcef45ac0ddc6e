// Files of protobuf text.
#pragma once

#include <google/protobuf/message.h>

#include <string>

namespace collision::client {

/// Reads `path` into `message`. Throws std::runtime_error, "path: cannot be read" or
/// "path:line:column: cause" of the first error.
void ReadProtoText(const std::string& path, google::protobuf::Message* message);

}  // namespace collision::client
