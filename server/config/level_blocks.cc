#include "server/config/level_blocks.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <set>

#include "idl/limits.h"
#include "server/config/config_blocks.h"

namespace collision::server {
namespace {

constexpr const char* kLevels = "levels";
constexpr double kLookAheadMax = 86400;  // [s] As of announce_within_s.

constexpr const char* kAllowedLevelName =
    "1 to 32 of A-Z a-z 0-9 _ -, each once; not contact, which names contact itself";
constexpr const char* kAllowedBasis = "POSSIBLE, EXPECTED";
constexpr const char* kAllowedPair = "CLASS/CLASS, two of classes that meet each other";
static_assert(wire::kLevelNameMax == 32, "the text says so");

std::string MarginRange() { return fmt::format("{} to {} [m]", kLevelMarginMin, wire::kRadiusMax); }
std::string HysteresisRange() { return fmt::format("0 to {} [m]", wire::kRadiusMax); }

bool Lists(const v1::AgentClass& one, const std::string& other) {
  return std::ranges::count(one.meets(), other) > 0;
}

/// Whether there are two classes of these names, or one, that meet each other.
bool Meet(const v1::Config& config, const std::string& first, const std::string& second) {
  const auto named = [&config](const std::string& name) {
    return std::ranges::find(config.classes(), name, &v1::AgentClass::name);
  };
  const auto a = named(first), b = named(second), none = config.classes().end();
  return a != none && b != none && (Lists(*a, second) || Lists(*b, first));
}

/// Checks one block.
class BlockCheck {
 public:
  BlockCheck(const v1::Config& config, int block, std::vector<ConfigError>* errors)
      : config_(config), level_(config.levels(block)), block_(block), errors_(errors) {}

  void Check(std::set<std::string>* names) {
    const std::string& name = level_.name();
    const bool is_name = name.size() <= wire::kLevelNameMax && wire::IsName(name);
    if (!is_name || name == "contact" || !names->insert(name).second) {
      Refuse("name", "\"" + name + "\"", kAllowedLevelName);
    }
    Number("margin_m", level_.margin_m(), kLevelMarginMin, wire::kRadiusMax, MarginRange());
    Number("hysteresis_m", level_.hysteresis_m(), 0, wire::kRadiusMax, HysteresisRange());
    const double least = config_.temporal_resolution_s();
    if (level_.has_look_ahead_s()) {
      Number("look_ahead_s", level_.look_ahead_s(), least, kLookAheadMax,
             fmt::format("temporal_resolution_s ({}) to {} [s]", least, kLookAheadMax));
    }
    CheckBetween();
  }

 private:
  void Refuse(const std::string& field, const std::string& value, const std::string& allowed) {
    errors_->push_back(
        {BlockPath(kLevels, block_) + "." + field, value + " is not allowed; allowed: " + allowed});
  }

  void Number(const std::string& field, double value, double least, double most,
              const std::string& allowed) {
    if (!(value >= least && value <= most)) Refuse(field, fmt::format("{}", value), allowed);
  }

  void CheckBetween() {
    for (const std::string& pair : level_.between()) {
      const auto [first, second] = SplitAtSlash(pair);
      if (Meet(config_, first, second)) continue;
      return Refuse("between", "\"" + pair + "\"", kAllowedPair);
    }
  }

  const v1::Config& config_;
  const v1::Level& level_;
  const int block_;
  std::vector<ConfigError>* errors_;
};

}  // namespace

std::string AllowedInLevelBlock(std::string_view field) {
  if (field == "name") return kAllowedLevelName;
  if (field == "margin_m") return MarginRange();
  if (field == "look_ahead_s") return fmt::format("temporal_resolution_s to {} [s]", kLookAheadMax);
  if (field == "basis") return kAllowedBasis;
  if (field == "hysteresis_m") return HysteresisRange();
  return field == "between" ? kAllowedPair : FieldNames(*v1::Level::descriptor());
}

void CheckLevelBlocks(const v1::Config& complete, std::vector<ConfigError>* errors) {
  const int blocks = complete.levels_size();
  if (blocks > wire::kLevelsMax) {
    errors->push_back(
        {BlockPath(kLevels, wire::kLevelsMax),
         fmt::format("{} blocks are not allowed; allowed: at most {}", blocks, wire::kLevelsMax)});
  }
  std::set<std::string> names;
  for (int block = 0; block < std::min(blocks, wire::kLevelsMax); ++block) {
    BlockCheck(complete, block, errors).Check(&names);
  }
}

}  // namespace collision::server
