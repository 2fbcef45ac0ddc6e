#include "server/config/config.h"

#include <google/protobuf/text_format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <sstream>
#include <system_error>

#include "server/config/config_blocks.h"
#include "server/config/config_options.h"
#include "server/config/config_text.h"
#include "server/config/level_blocks.h"
#include "server/config/limit_blocks.h"
#include "server/config/partner_blocks.h"

namespace collision::server {
namespace {

using google::protobuf::TextFormat;

/// Where a field stands in the text; line -1: it is not there.
TextPlace PlaceOf(TextFormat::ParseInfoTree* tree, const std::string& path) {
  const google::protobuf::Descriptor* type = v1::Config::descriptor();
  const std::size_t dot = path.find('.');
  if (const auto block = FindBlock(path)) {
    const auto whole = tree->GetLocation(block->field, block->block);
    if (dot == path.npos) return {whole.line, whole.column};
    // Of a list within the block, its first entry.
    const auto* field = block->field->message_type()->FindFieldByName(path.substr(dot + 1));
    const auto place = tree->GetTreeForNested(block->field, block->block)
                           ->GetLocation(field, field->is_repeated() ? 0 : -1);
    if (place.line < 0) return {whole.line, whole.column};
    return {place.line, place.column};
  }
  if (dot != path.npos) {
    const auto* nested = type->FindFieldByName(path.substr(0, dot));
    tree = tree->GetTreeForNested(nested, -1);
    type = nested->message_type();
  }
  if (tree == nullptr) return {-1, -1};
  const auto place = tree->GetLocation(type->FindFieldByName(path.substr(dot + 1)), -1);
  return {place.line, place.column};
}

/// What does nothing with this kind of clock must keep its default: it was set for something.
void CheckKind(const v1::Config& config, std::vector<ConfigError>* errors) {
  if (config.clock().kind() != v1::Clock::REAL_TIME &&
      config.clock().kind() != v1::Clock::LOCK_STEP) {
    return;
  }
  const std::string kind = v1::Clock::Kind_Name(config.clock().kind());
  v1::Config defaults;
  defaults.mutable_clock()->set_kind(config.clock().kind());
  defaults = CompleteConfig(defaults);
  for (const ConfigOption& option : ConfigOptions()) {
    if (option.only_with.empty() || option.only_with == kind) continue;
    const std::string value = ValueText(defaults, option);
    if (ValueText(config, option) == value) continue;
    errors->push_back({std::string(option.path), "allowed only with kind " +
                                                     std::string(option.only_with) + "; with " +
                                                     kind + " leave it at " + value});
  }
}

void CheckAgainst(const v1::Config& config, std::vector<ConfigError>* errors) {
  const v1::Clock& clock = config.clock();
  const double resolution = config.temporal_resolution_s();
  const std::string not_below = "must not be less than temporal_resolution_s (both in seconds)";
  if (config.announce_within_s() < resolution) errors->push_back({"announce_within_s", not_below});
  if (clock.grant_ahead_max_s() < resolution) {
    errors->push_back({"clock.grant_ahead_max_s", not_below});
  }
  if (config.simulators_max() < clock.simulators_awaited()) {
    errors->push_back({"clock.simulators_awaited", "must not be more than simulators_max"});
  }
  if (clock.kind() == v1::Clock::REAL_TIME && clock.skew_max_s() == 0) {
    errors->push_back(
        {"clock.skew_max_s", "with kind REAL_TIME it must be greater than 0, up to 60 [s]"});
  }
  CheckKind(config, errors);
  const double release_default = CompleteConfig({}).clock().release_after_s();
  if (clock.on_silent_simulator() == v1::Clock::WAIT &&
      clock.release_after_s() != release_default) {
    errors->push_back({"clock.release_after_s", "allowed only with on_silent_simulator RELEASE"});
  }
}

/// Where fields disagree, the error stands at the one that the text sets.
TextPlace PlaceOfEither(TextFormat::ParseInfoTree* tree, const ConfigError& error) {
  const TextPlace place = PlaceOf(tree, error.field);
  if (place.first >= 0) return place;
  const bool awaited = error.field == "clock.simulators_awaited";
  return PlaceOf(tree, awaited ? "simulators_max" : "temporal_resolution_s");
}

}  // namespace

ConfigResult ParseConfig(const std::string& text, const std::string& name) {
  ConfigResult result;
  ErrorsByPlace errors;
  const auto locations = ReadConfigText(text, &result.config, &errors);
  result.config = CompleteConfig(result.config);
  for (const ConfigError& error : CheckConfig(result.config)) {
    errors.try_emplace(PlaceOfEither(locations.get(), error), error.field + ": " + error.what);
  }
  for (const auto& [place, what] : errors) {
    result.errors.push_back(name + ":" + std::to_string(place.first + 1) + ": " + what);
  }
  return result;
}

ConfigResult LoadConfig(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file && file.peek() != std::ifstream::traits_type::eof()) text << file.rdbuf();
  if (file.is_open() && !file.bad()) return ParseConfig(text.str(), path);
  return {{}, {path + ": cannot be read: " + std::generic_category().message(errno)}};
}

v1::Config CompleteConfig(v1::Config config) {
  for (const ConfigOption& option : ConfigOptions()) {
    if (!IsSet(config, option)) SetValue(&config, option, DefaultOf(option, config));
  }
  return config;
}

std::uint64_t WorkUnitsPerEvaluation(const v1::Config& complete) {
  return static_cast<std::uint64_t>(
      std::llround(complete.time_budget_us() * complete.work_units_per_us()));
}

std::uint64_t WorkUnitsPerStep(const v1::Config& complete) {
  const double units = complete.step_budget_us() * complete.work_units_per_us();
  return units > 0 ? std::max<std::uint64_t>(1, std::llround(units)) : 0;
}

std::vector<ConfigError> CheckConfig(const v1::Config& complete) {
  std::vector<ConfigError> errors;
  for (const ConfigOption& option : ConfigOptions()) {
    std::string what = CheckValue(complete, option);
    if (!what.empty()) errors.push_back({std::string(option.path), std::move(what)});
  }
  CheckAgainst(complete, &errors);
  CheckLimitBlocks(complete, &errors);
  CheckPartnerBlocks(complete, &errors);
  CheckLevelBlocks(complete, &errors);
  return errors;
}

}  // namespace collision::server
