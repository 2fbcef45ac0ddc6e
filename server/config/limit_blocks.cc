#include "server/config/limit_blocks.h"

#include <google/protobuf/text_format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "idl/limits.h"
#include "server/config/config_blocks.h"

namespace collision::server {
namespace {

using google::protobuf::FieldDescriptor;

constexpr std::string_view kLimits = "limits";
constexpr const char* kAllowedName = "1 to 64 of A-Z a-z 0-9 _ - *";
constexpr const char* kAllowedPart = "0 to 1";

bool IsNamePattern(std::string name) {
  std::replace(name.begin(), name.end(), '*', 'x');
  return wire::IsName(name);
}

std::string TextOf(const google::protobuf::Message& message, const FieldDescriptor* field) {
  std::string text;
  google::protobuf::TextFormat::PrintFieldValueToString(message, field, -1, &text);
  return text;
}

/// Checks the blocks in their order, each with what those before it have left.
class BlocksCheck {
 public:
  BlocksCheck(const v1::Config& config, std::vector<ConfigError>* errors)
      : config_(config), errors_(errors) {}

  void Check(int block) {
    block_ = block;
    CheckName();
    CheckGuaranteed();
    const google::protobuf::Descriptor* type = v1::SimulatorLimits::descriptor();
    for (int i = 0; i < type->field_count(); ++i) CheckMax(type->field(i));
  }

 private:
  const v1::SimulatorLimits& block() const { return config_.limits(block_); }

  void Refuse(const std::string& field, const std::string& allowed) {
    const FieldDescriptor* at = v1::SimulatorLimits::descriptor()->FindFieldByName(field);
    errors_->push_back({BlockPath(kLimits, block_) + "." + field,
                        TextOf(block(), at) + " is not allowed; allowed: " + allowed});
  }

  void CheckName() {
    if (!IsNamePattern(block().name())) return Refuse("name", kAllowedName);
    for (int before = 0; before < block_; ++before) {
      const std::string& name = config_.limits(before).name();
      if (!FitsPattern(block().name(), name)) continue;
      return Refuse("name", "a name that " + BlockPath(kLimits, before) + " (\"" + name +
                                "\") does not fit: the first block that fits counts");
    }
    if (IsPattern(block().name()) || ++names_ <= config_.simulators_max()) return;
    Refuse("name", "as many names without * as simulators_max, " +
                       std::to_string(config_.simulators_max()));
  }

  void CheckGuaranteed() {
    const double part = block().guaranteed();
    if (!(part >= 0 && part <= 1)) return Refuse("guaranteed", kAllowedPart);
    if (IsPattern(block().name())) return;
    if (guaranteed_ + part > 1) {
      char left[32];
      std::snprintf(left, sizeof left, "%.6g", 1 - guaranteed_);
      return Refuse("guaranteed",
                    std::string("0 to ") + left + ", which the blocks before have left of 1");
    }
    guaranteed_ += part;
  }

  /// A limit of the world has the same name as its part in a block.
  void CheckMax(const FieldDescriptor* field) {
    const FieldDescriptor* of_world = v1::Config::descriptor()->FindFieldByName(field->name());
    if (of_world == nullptr || !block().GetReflection()->HasField(block(), field)) return;
    const auto number = [](const std::string& text) {
      return std::strtoull(text.c_str(), nullptr, 10);
    };
    const std::string most = TextOf(config_, of_world);
    const std::uint64_t value = number(TextOf(block(), field));
    if (value >= 1 && value <= number(most)) return;
    Refuse(field->name(), "1 to " + most + ", which the world has");
  }

  const v1::Config& config_;
  std::vector<ConfigError>* errors_;
  int block_ = 0;
  std::uint64_t names_ = 0;  ///< Without *.
  double guaranteed_ = 0;    ///< To these.
};

}  // namespace

bool FitsPattern(const std::string& name, const std::string& pattern) {
  // fits[i]: the pattern so far fits the first i characters. A * in the name, which no other
  // character fits, stands for what the name may have there.
  std::vector<bool> fits(name.size() + 1, false);
  fits[0] = true;
  for (const char c : pattern) {
    for (std::size_t i = name.size() + 1; c != '*' && i-- > 0;) {
      fits[i] = i > 0 && fits[i - 1] && name[i - 1] == c;
    }
    for (std::size_t i = 1; c == '*' && i <= name.size(); ++i) fits[i] = fits[i] || fits[i - 1];
  }
  return fits[name.size()];
}

bool IsPattern(std::string_view name) { return name.find('*') != std::string_view::npos; }

std::string AllowedInLimitBlock(std::string_view field) {
  const google::protobuf::Descriptor* type = v1::SimulatorLimits::descriptor();
  if (field == "name") return kAllowedName;
  if (field == "guaranteed") return kAllowedPart;
  if (type->FindFieldByName(std::string(field)) != nullptr) {
    return "1 to " + std::string(field) + " of the world";
  }
  return FieldNames(*type);
}

void CheckLimitBlocks(const v1::Config& complete, std::vector<ConfigError>* errors) {
  const int blocks = complete.limits_size();
  if (blocks > kLimitBlocksMax) {
    errors->push_back({BlockPath(kLimits, kLimitBlocksMax),
                       std::to_string(blocks) + " blocks are not allowed; allowed: at most " +
                           std::to_string(kLimitBlocksMax)});
  }
  BlocksCheck check(complete, errors);
  for (int block = 0; block < std::min(blocks, kLimitBlocksMax); ++block) check.Check(block);
}

}  // namespace collision::server
