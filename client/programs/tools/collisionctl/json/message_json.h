// Messages as protobuf has them in JSON.
#pragma once

#include <google/protobuf/message.h>

#include <string>

namespace collision::client {

/// The message with every field of it, under the names of the .proto file, in one line.
std::string MessageJson(const google::protobuf::Message& message);

}  // namespace collision::client
