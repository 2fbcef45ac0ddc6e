#include <google/protobuf/text_format.h>

#include <sstream>

#include "server/config/config.h"
#include "server/config/config_options.h"

namespace collision::server {
namespace {

constexpr std::size_t kColumns = 100;

constexpr std::string_view kHead =
    "The configuration of collisiond: protobuf text, read with --config FILE. Every field may be "
    "left out; its "
    "default then holds. --check-config checks a file, --print-config prints one like this.";

constexpr std::string_view kLimitsMeaning =
    "What a simulator may have of the limits above: limits { name: \"drone-*\" agents_max: 100 }, "
    "as "
    "often as needed. The first block whose name fits counts; * stands for any characters. A block "
    "whose names all fit an earlier one is refused. Fields: "
    "guaranteed (the part of each limit that is kept for it as long as it is in the world, or "
    "always "
    "if the name has no *; unset: 1 / (simulators_max + 1)), agents_max, pairs_max, shapes_max, "
    "shape_bytes_max, tree_bytes_max, rejections_per_second_max (unset: all). A simulator may have "
    "what is free, less what the others have not used of what they are guaranteed.";

constexpr std::string_view kLimitsFacts =
    "Unit: that of the limit; of guaranteed none. Range: from 1 to the limit of the world; of "
    "guaranteed 0 to 1; at most 64 blocks. Default: no block.";

constexpr std::string_view kClassesMeaning =
    "Which agents can meet at all, by the classes that their descriptions name: classes { name: "
    "\"robot\" meets: \"robot\" meets: \"person\" }, as often as needed. Two classes meet if "
    "either of "
    "them lists the other; one that lists none meets those that list it. An agent that names no "
    "class meets all. A description with a class that is not here is refused.";

constexpr std::string_view kClassesFacts =
    "Unit: none. Range: names of 1 to 32 of A-Z a-z 0-9 _ -; at most 31 blocks. Default: no block.";

constexpr std::string_view kExcludedMeaning =
    "Pairs of agents, of one simulator or of two, that never meet: excluded { first: "
    "\"cell/table\" second: \"arm/base\" }, as often as needed. Each is named as simulator/agent, "
    "and need not be there.";

constexpr std::string_view kExcludedFacts =
    "Unit: none. Range: two different agents; at most 4096 blocks. Default: no block.";

constexpr std::string_view kLevelsMeaning =
    "What is told beside contacts: levels { name: \"near\" margin_m: 0.5 look_ahead_s: 5 "
    "hysteresis_m: 0.1 between: \"robot/person\" }, as often as needed. Two agents that come "
    "within "
    "margin_m of each other (beside their own margins) get events like those of a contact, under "
    "the "
    "name of the level; clearances and grants do not change. look_ahead_s stands for "
    "announce_within_s; basis EXPECTED leaves out forecasts of pairs that pass each other if both "
    "keep the motion they told. With hysteresis_m a pair is told again only after it was certainly "
    "farther apart than margin_m + hysteresis_m. between names pairs of classes that meet each "
    "other (agents without "
    "a "
    "class are then not watched); without it all that can meet are watched. A level costs about as "
    "much as the detection of contacts, one with a hysteresis twice that; all together have a "
    "quarter of step_budget_us.";

constexpr std::string_view kLevelsFacts =
    "Unit: m, s. Range: names of 1 to 32 of A-Z a-z 0-9 _ -; margin_m 2e-06 to 1e12, hysteresis_m "
    "0 "
    "to 1e12, look_ahead_s temporal_resolution_s to 86400 (unset: announce_within_s); at most 8 "
    "blocks. Default: no block.";

/// As a comment, broken between words.
void PrintComment(std::string_view text, const std::string& indent, std::ostream& out) {
  std::istringstream words{std::string(text)};
  std::string line = indent + "#";
  for (std::string word; words >> word; line += " " + word) {
    if (line.size() + 1 + word.size() > kColumns) {
      out << line << '\n';
      line = indent + "#";
    }
  }
  out << line << '\n';
}

std::string Facts(const ConfigOption& option) {
  std::string facts = "Unit: " + std::string(option.unit) + ". Range: " + AllowedRange(option) +
                      ". Default: " + std::string(option.value);
  if (!option.wall_value.empty()) facts += "; with REAL_TIME " + std::string(option.wall_value);
  if (!option.only_with.empty()) facts += "; only with " + std::string(option.only_with);
  return facts + ".";
}

void PrintOption(const v1::Config& config, const ConfigOption& option, const std::string& indent,
                 std::ostream& out) {
  PrintComment(option.meaning, indent, out);
  PrintComment(Facts(option), indent, out);
  const std::string_view name = option.path.substr(option.path.rfind('.') + 1);
  out << indent << name << ": " << ValueText(config, option) << '\n';
}

template <typename Blocks>
void PrintBlocks(const char* name, std::string_view meaning, std::string_view facts,
                 const Blocks& blocks, std::ostream& out) {
  out << '\n';
  PrintComment(meaning, "", out);
  PrintComment(facts, "", out);
  for (const auto& block : blocks) {
    std::string text;
    google::protobuf::TextFormat::PrintToString(block, &text);
    std::istringstream lines(text);
    out << name << " {\n";
    for (std::string line; std::getline(lines, line);) out << "  " << line << '\n';
    out << "}\n";
  }
}

}  // namespace

std::string PrintConfig(const v1::Config& complete) {
  std::ostringstream out;
  PrintComment(kHead, "", out);
  bool in_clock = false;
  for (const ConfigOption& option : ConfigOptions()) {
    const bool of_clock = option.path.starts_with("clock.");
    if (in_clock && !of_clock) out << "}\n";
    out << '\n';
    if (!in_clock && of_clock) out << "clock {\n";
    in_clock = of_clock;
    PrintOption(complete, option, of_clock ? "  " : "", out);
  }
  PrintBlocks("limits", kLimitsMeaning, kLimitsFacts, complete.limits(), out);
  PrintBlocks("classes", kClassesMeaning, kClassesFacts, complete.classes(), out);
  PrintBlocks("excluded", kExcludedMeaning, kExcludedFacts, complete.excluded(), out);
  PrintBlocks("levels", kLevelsMeaning, kLevelsFacts, complete.levels(), out);
  return out.str();
}

}  // namespace collision::server
