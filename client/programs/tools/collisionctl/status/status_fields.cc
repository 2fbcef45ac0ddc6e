#include "client/programs/tools/collisionctl/status/status_fields.h"

#include <algorithm>
#include <string_view>

#include "collision/event_text.h"

namespace collision::client {

std::uint64_t CounterOf(const v1::ServiceStatus& status, const std::string& name) {
  for (const v1::Counter& counter : status.counters()) {
    if (counter.name() == name) return counter.value();
  }
  return 0;
}

std::string CountersText(const v1::ServiceStatus& status, bool rejections) {
  constexpr std::string_view kRejected = "rejected_";
  std::string text;
  for (const v1::Counter& counter : status.counters()) {
    const bool is_rejection = counter.name().starts_with(kRejected);
    if (counter.value() == 0 || is_rejection != rejections) continue;
    const std::string name = rejections ? counter.name().substr(kRejected.size()) : counter.name();
    text += (text.empty() ? "" : ", ") + name + " " + std::to_string(counter.value());
  }
  return text.empty() ? "none" : text;
}

std::string ExtensionOf(const v1::ServiceStatus& status, const std::string& key) {
  for (const v1::KeyValue& extension : status.extensions()) {
    if (extension.key() == key) return extension.value();
  }
  return "";
}

std::vector<std::string> Parts(const std::string& list) {
  constexpr std::string_view kListSeparator = ", ";
  std::vector<std::string> parts;
  for (std::size_t from = 0; from < list.size();) {
    const std::size_t to = std::min(list.find(kListSeparator, from), list.size());
    parts.push_back(list.substr(from, to - from));
    from = to + kListSeparator.size();
  }
  return parts;
}

std::string Line(const std::string& label, const std::string& text) {
  constexpr std::size_t kLabelColumns = 13;
  return Padded(label, kLabelColumns) + text + "\n";
}

}  // namespace collision::client
