#include "server/service/requests/reload.h"

#include <algorithm>

#include "server/config/config_options.h"

namespace collision::server {
namespace {

constexpr std::string_view kSizesOfWhatIsKept[] = {"recorder_mb_max", "contacts_mb_max"};
constexpr std::string_view kAlsoKept[] = {"recorder_segment_mb", "recorder_segment_s",
                                          "recorder_keep_s"};

bool IsIn(std::span<const std::string_view> paths, std::string_view path) {
  return std::ranges::count(paths, path) > 0;
}

/// Repeated blocks of one name, as one text.
std::string BlocksOf(const v1::Config& config, const google::protobuf::FieldDescriptor* field) {
  std::string text;
  const google::protobuf::Reflection* reflection = v1::Config::GetReflection();
  for (int i = 0; i < reflection->FieldSize(config, field); ++i) {
    text += reflection->GetRepeatedMessage(config, field, i).ShortDebugString() + "\n";
  }
  return text;
}

/// Names of those that differ.
std::vector<std::string> ChangedBlocks(const v1::Config& before, const v1::Config& after) {
  std::vector<std::string> names;
  const google::protobuf::Descriptor* type = v1::Config::descriptor();
  for (int i = 0; i < type->field_count(); ++i) {
    const google::protobuf::FieldDescriptor* field = type->field(i);
    if (!field->is_repeated() || BlocksOf(before, field) == BlocksOf(after, field)) continue;
    names.push_back(field->name());
  }
  return names;
}

}  // namespace

bool CanChange(std::string_view path, std::string_view before, std::string_view after) {
  if (IsIn(kSizesOfWhatIsKept, path)) return before != "0" && after != "0";
  return path.starts_with("log_") || IsIn(kAlsoKept, path);
}

LogOptions LogOptionsOf(const v1::Config& config) {
  return {.level = config.log_level(),
          .file = config.log_file(),
          .json = config.log_format() == v1::Config::JSON};
}

Reloaded Reloader::Read() const {
  if (!load_) return {.accepted = true, .config = in_force_};
  const ConfigResult loaded = load_();
  if (!loaded.ok()) return {.errors = loaded.errors};
  Reloaded reloaded{
      .accepted = true, .unchanged = ChangedBlocks(in_force_, loaded.config), .config = in_force_};
  for (const ConfigOption& option : ConfigOptions()) {
    const std::string before = ValueText(in_force_, option);
    const std::string after = ValueText(loaded.config, option);
    if (before == after) continue;
    const std::string path(option.path);
    if (!CanChange(path, before, after)) {
      reloaded.unchanged.push_back(path);
    } else if (SetValue(&reloaded.config, option, after)) {
      reloaded.changed.push_back(path + ": " + before + " -> " + after);
    }
  }
  return reloaded;
}

}  // namespace collision::server
