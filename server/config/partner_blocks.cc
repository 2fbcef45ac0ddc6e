#include "server/config/partner_blocks.h"

#include <algorithm>
#include <set>

#include "idl/limits.h"

namespace collision::server {
namespace {

constexpr const char* kClasses = "classes";
constexpr const char* kExcluded = "excluded";
constexpr const char* kAllowedClass = "1 to 32 of A-Z a-z 0-9 _ -, each once";
constexpr const char* kAllowedAgent = "simulator/agent, two different ones";
static_assert(wire::kClassNameMax == 32, "the text says so");

std::string Quoted(const std::string& text) { return "\"" + text + "\""; }

void Refuse(const std::string& path, const std::string& value, const std::string& allowed,
            std::vector<ConfigError>* errors) {
  errors->push_back({path, value + " is not allowed; allowed: " + allowed});
}

/// Refuses the first block beyond the limit; returns how many there may be of those that there are.
int BlocksChecked(const char* name, int blocks, int most, std::vector<ConfigError>* errors) {
  if (blocks > most) {
    errors->push_back({BlockPath(name, most), std::to_string(blocks) +
                                                  " blocks are not allowed; allowed: at most " +
                                                  std::to_string(most)});
  }
  return std::min(blocks, most);
}

void CheckClasses(const v1::Config& config, std::vector<ConfigError>* errors) {
  const int blocks = BlocksChecked(kClasses, config.classes_size(), wire::kClassesMax, errors);
  std::set<std::string> names;
  std::string list;
  for (int block = 0; block < blocks; ++block) {
    const std::string& name = config.classes(block).name();
    if (name.size() > wire::kClassNameMax || !wire::IsName(name) || !names.insert(name).second) {
      Refuse(BlockPath(kClasses, block) + ".name", Quoted(name), kAllowedClass, errors);
    } else {
      list += (list.empty() ? "" : ", ") + name;
    }
  }
  for (int block = 0; block < blocks; ++block) {
    for (const std::string& met : config.classes(block).meets()) {
      if (names.count(met) != 0) continue;
      Refuse(BlockPath(kClasses, block) + ".meets", Quoted(met), "the names of classes: " + list,
             errors);
      break;
    }
  }
}

bool NamesAgent(const std::string& name) {
  const auto [simulator, agent] = SplitAtSlash(name);
  return wire::IsName(simulator) && !agent.empty() && agent.size() <= wire::kNameMax;
}

void CheckExcluded(const v1::Config& config, std::vector<ConfigError>* errors) {
  const int blocks = BlocksChecked(kExcluded, config.excluded_size(), kExcludedPairsMax, errors);
  for (int block = 0; block < blocks; ++block) {
    const v1::ExcludedPair& pair = config.excluded(block);
    const std::string path = BlockPath(kExcluded, block);
    if (!NamesAgent(pair.first())) {
      Refuse(path + ".first", Quoted(pair.first()), kAllowedAgent, errors);
    } else if (!NamesAgent(pair.second()) || pair.second() == pair.first()) {
      Refuse(path + ".second", Quoted(pair.second()), kAllowedAgent, errors);
    }
  }
}

}  // namespace

std::string AllowedInPartnerBlock(const BlockOfPath& block, std::string_view field) {
  const google::protobuf::Descriptor& type = *block.field->message_type();
  if (type.FindFieldByName(std::string(field)) == nullptr) return FieldNames(type);
  if (block.field->name() == kExcluded) return kAllowedAgent;
  return field == "meets" ? "the names of classes" : kAllowedClass;
}

void CheckPartnerBlocks(const v1::Config& complete, std::vector<ConfigError>* errors) {
  CheckClasses(complete, errors);
  CheckExcluded(complete, errors);
}

}  // namespace collision::server
