// The table of everything that may be configured.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "idl/config.pb.h"

namespace collision::server {

/// One field of the configuration. Validation, defaults, --print-config and
/// config/collisiond.textproto all come from this table.
struct ConfigOption {
  std::string_view path;             ///< "clock.skew_max_s"
  std::string_view unit;             ///< "s", "agents"; "none"
  std::string_view least;            ///< Of numbers, inclusive, as text; otherwise empty.
  std::string_view most;             ///< As `least`.
  std::string_view allowed;          ///< The range in words, if it is not a number.
  std::string_view value;            ///< The default as protobuf text.
  std::string_view meaning;          ///< What it does, for the reader of the configuration file.
  std::string_view wall_value = {};  ///< The default with the wall clock, where it is another.
  std::string_view only_with = {};   ///< The kind of clock without which it must keep its default.
};

/// Every field of v1::Config in the order in which they are declared, those of `clock` where it
/// stands among them.
std::span<const ConfigOption> ConfigOptions();

/// The option whose path ends in the field name `name` (no two end alike), or null.
const ConfigOption* FindConfigOption(std::string_view name);

/// "0.0001 to 10", or the words of `allowed`.
std::string AllowedRange(const ConfigOption& option);

/// The default in this configuration: it depends only on the clock's kind.
std::string_view DefaultOf(const ConfigOption& option, const v1::Config& config);

bool IsSet(const v1::Config& config, const ConfigOption& option);

/// The field's value as protobuf text, whether or not it is set.
std::string ValueText(const v1::Config& config, const ConfigOption& option);

/// Sets the field from protobuf text. False: the text is no value of the field's type.
bool SetValue(v1::Config* config, const ConfigOption& option, std::string_view text);

/// What is wrong with the field's value, with the allowed range; empty if it is allowed.
std::string CheckValue(const v1::Config& config, const ConfigOption& option);

}  // namespace collision::server
