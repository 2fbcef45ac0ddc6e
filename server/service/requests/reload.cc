#include "server/service/requests/reload.h"

#include "server/config/config_options.h"

namespace collision::server {

bool CanChange(std::string_view path) { return path == "log_level" || path == "log_file"; }

Reloaded Reloader::Reload() {
  Reloaded reloaded{.accepted = true};
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
    } else if (SetValue(&in_force_, option, after)) {
      reloaded.changed.push_back(path + ": " + before + " -> " + after);
    }
  }
  return reloaded;
}

}  // namespace collision::server
