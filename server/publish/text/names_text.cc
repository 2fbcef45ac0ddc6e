#include "server/publish/text/names_text.h"

#include <spdlog/fmt/fmt.h>

namespace collision::server {
namespace {

std::string TextOf(const std::vector<std::string>& names, std::size_t shown) {
  const auto end = names.begin() + static_cast<std::ptrdiff_t>(shown);
  std::string text = fmt::format("{}", fmt::join(names.begin(), end, ", "));
  if (shown == names.size()) return text;
  return text + fmt::format("{}+{} more", shown > 0 ? ", " : "", names.size() - shown);
}

}  // namespace

std::string NamesText(const std::vector<std::string>& names, std::size_t length_max) {
  // All names of the most that may be shown are longer than a comma and a blank.
  std::size_t shown = 0;
  std::size_t length = 0;
  while (shown < names.size() && length <= length_max) length += names[shown++].size() + 2;
  std::string text = TextOf(names, shown);
  while (text.size() > length_max && shown > 0) text = TextOf(names, --shown);
  return text.substr(0, length_max);
}

}  // namespace collision::server
