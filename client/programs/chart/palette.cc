#include "client/programs/chart/palette.h"

namespace collision::chart {

std::string HtmlColour(Colour colour) {
  static constexpr std::array<const char*, kColours> kCodes = {
      "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#7f7f7f"};
  return kCodes.at(static_cast<std::size_t>(colour));
}

std::string GnuplotDash(int dash) {
  // Lengths of lines and gaps in turn.
  static constexpr std::array<const char*, kDashes> kPatterns = {
      "solid", "(12,4)", "(2,4)", "(12,4,2,4)", "(20,4,2,4,2,4)", "(24,8)", "(6,3)", "(2,8)"};
  return kPatterns.at(static_cast<std::size_t>(dash));
}

std::uint32_t HashOfName(const std::string& name) {
  std::uint32_t hash = 2166136261u;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
  return hash;
}

Look LookOf(const std::string& name) {
  const std::uint32_t hash = HashOfName(name);
  return {static_cast<Colour>(hash % kColours), kOpenMarks[hash / kColours % kOpenMarks.size()], 0};
}

}  // namespace collision::chart
