// A member of an object of JSON.
#pragma once

#include <google/protobuf/struct.pb.h>

#include <string>

namespace collision::gateway {

/// The member of this name; one without a kind: there is none. It asks the library, not the map: in
/// a build for the thread sanitizer, maps of the program and of the library differ.
const google::protobuf::Value& MemberOf(const google::protobuf::Struct& object,
                                        const std::string& name);

}  // namespace collision::gateway
