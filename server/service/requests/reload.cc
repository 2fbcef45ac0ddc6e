#include "server/service/requests/reload.h"

#include "server/config/config_options.h"

namespace collision::server {

bool CanChange(std::string_view path) { return path.starts_with("log_"); }

LogOptions LogOptionsOf(const v1::Config& config) {
  return {.level = config.log_level(),
          .file = config.log_file(),
          .json = config.log_format() == v1::Config::JSON};
}

Reloaded Reloader::Read() const {
  Reloaded reloaded{.accepted = true, .config = in_force_};
  if (!load_) return reloaded;
  const ConfigResult loaded = load_();
  if (!loaded.ok()) return {.errors = loaded.errors};
  for (const ConfigOption& option : ConfigOptions()) {
    const std::string before = ValueText(in_force_, option);
    const std::string after = ValueText(loaded.config, option);
    if (before == after) continue;
    const std::string path(option.path);
    if (!CanChange(path)) {
      reloaded.unchanged.push_back(path);
    } else if (SetValue(&reloaded.config, option, after)) {
      reloaded.changed.push_back(path + ": " + before + " -> " + after);
    }
  }
  return reloaded;
}

}  // namespace collision::server
