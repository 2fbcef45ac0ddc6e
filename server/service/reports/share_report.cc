#include "server/service/reports/share_report.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "idl/limits.h"
#include "server/publish/text/names_text.h"

namespace collision::server {

bool ShareReport::Take(const std::vector<detection::OwnerWork>& work, const World& world) {
  std::vector<Held> held;
  for (const detection::OwnerWork& one : work) {
    if (one.held_since.is_never()) continue;
    const double seconds =
        1e-9 * static_cast<double>(world.now().nanoseconds() - one.held_since.nanoseconds());
    if (seconds < kHeldNamed) continue;
    const auto simulator = world.simulators().find(one.owner.simulator);
    if (simulator == world.simulators().end()) continue;
    const std::string& name = simulator->second.name();
    held.push_back({one.owner, name,
                    fmt::format("{} (held to its share of 1/{} for {:.0f} s; {} pairs wait)", name,
                                one.sharing, seconds, one.waiting)});
  }
  const auto within = [](const std::vector<Held>& all, const Held& of) {
    return std::any_of(all.begin(), all.end(),
                       [&](const Held& one) { return one.owner == of.owner; });
  };
  const std::vector<Held> before = std::exchange(held_, std::move(held));
  bool changed = false;
  for (const Held& one : held_) {
    if (within(before, one)) continue;
    begins_.Add(one.text);
    changed = true;
  }
  for (const Held& one : before) {
    if (within(held_, one)) continue;
    ends_.Add(one.name);
    changed = true;
  }
  return changed;
}

void ShareReport::Write(std::int64_t monotonic_ns) {
  begins_.Write(monotonic_ns);
  ends_.Write(monotonic_ns);
}

void ShareReport::AddExtensions(std::vector<v1::KeyValue>* extensions) const {
  if (held_.empty()) return;
  std::vector<std::string> texts;
  for (const Held& one : held_) texts.push_back(one.text);
  v1::KeyValue& extension = extensions->emplace_back();
  extension.set_key("narrow_phase_held");
  extension.set_value(NamesText(texts, wire::kExtensionValueMax));
}

}  // namespace collision::server
