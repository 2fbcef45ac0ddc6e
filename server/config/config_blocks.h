// The blocks of the configuration that may occur several times: limits, classes, excluded,
// levels.
#pragma once

#include <google/protobuf/descriptor.h>

#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace collision::server {

/// "limits[2]", the path of a block in errors; the first one of its name is limits[0].
std::string BlockPath(std::string_view name, int block);

/// Whether the configuration has repeated blocks of this name.
bool IsBlock(std::string_view name);

/// The block that a path names or leads into.
struct BlockOfPath {
  const google::protobuf::FieldDescriptor* field;  ///< Of v1::Config.
  int block;
};
/// nullopt: it leads into none.
std::optional<BlockOfPath> FindBlock(const std::string& path);

/// The two names of "simulator/agent" or "class/class". First ones have no slash, so that the first
/// slash separates; without one the second name is empty.
std::pair<std::string, std::string> SplitAtSlash(const std::string& names);

/// The names of all fields, "name, meets".
std::string FieldNames(const google::protobuf::Descriptor& type);

}  // namespace collision::server
