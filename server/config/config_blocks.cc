#include "server/config/config_blocks.h"

#include <cstdlib>

#include "idl/config.pb.h"

namespace collision::server {

std::string BlockPath(std::string_view name, int block) {
  return std::string(name) + "[" + std::to_string(block) + "]";
}

bool IsBlock(std::string_view name) {
  const auto* field = v1::Config::descriptor()->FindFieldByName(std::string(name));
  return field != nullptr && field->is_repeated() && field->message_type() != nullptr;
}

std::optional<BlockOfPath> FindBlock(const std::string& path) {
  const std::size_t bracket = path.find('[');
  if (bracket == path.npos || !IsBlock(path.substr(0, bracket))) return std::nullopt;
  return BlockOfPath{v1::Config::descriptor()->FindFieldByName(path.substr(0, bracket)),
                     std::atoi(path.c_str() + bracket + 1)};
}

std::pair<std::string, std::string> SplitAtSlash(const std::string& names) {
  const std::size_t slash = names.find('/');
  if (slash == names.npos) return {names, {}};
  return {names.substr(0, slash), names.substr(slash + 1)};
}

std::string FieldNames(const google::protobuf::Descriptor& type) {
  std::string names;
  for (int i = 0; i < type.field_count(); ++i) {
    names += (i > 0 ? ", " : "") + type.field(i)->name();
  }
  return names;
}

}  // namespace collision::server
