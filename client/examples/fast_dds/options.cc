// The command line of both programs: parsing and ranges.
#include "options.h"

#include <charconv>
#include <cstdlib>

namespace example {
namespace {

constexpr std::uint32_t kDomainMax = 230;  // Higher domains have ports beyond 65535.
constexpr std::size_t kNameMax = 64;
constexpr double kSecondsMax = 1e6;

/// Worlds and simulators become parts of a partition: no dot, no wildcard. fixed_string would cut
/// a longer name without a word.
std::string Name(const std::string& option, const std::string& text) {
  const char* allowed = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
  if (text.empty() || text.size() > kNameMax ||
      text.find_first_not_of(allowed) != std::string::npos) {
    throw UsageError(option + ": '" + text + "'; allowed: 1 to 64 of A-Z a-z 0-9 _ -");
  }
  return text;
}

template <typename Number>
Number InRange(const std::string& option, const std::string& text, Number least, Number most) {
  Number number{};
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || rest != end || !(number >= least && number <= most)) {
    throw UsageError(option + ": '" + text + "'; allowed: a number from " + std::to_string(least) +
                     " to " + std::to_string(most));
  }
  return number;
}

void Set(const std::string& option, const std::string& text, Options* options) {
  if (option == "--world" || option == "COLLISION_WORLD") {
    options->world = Name(option, text);
  } else if (option == "--domain" || option == "COLLISION_DOMAIN") {
    options->domain = InRange<std::uint32_t>(option, text, 0, kDomainMax);
  } else if (option == "--seconds") {
    options->seconds = InRange(option, text, 0.1, kSecondsMax);
  } else if (option == "--simulator" && !options->simulator.empty()) {
    options->simulator = Name(option, text);
  } else {
    throw UsageError("unknown option " + option + "; --help lists them");
  }
}

}  // namespace

Options ParseOptions(int argc, char** argv, Options defaults) {
  Options options = std::move(defaults);
  options.world = "default";
  for (const char* variable : {"COLLISION_WORLD", "COLLISION_DOMAIN"}) {
    const char* value = std::getenv(variable);
    if (value != nullptr && *value != '\0') Set(variable, value, &options);
  }
  for (int word = 1; word < argc; word += 2) {
    const std::string option = argv[word];
    if (option == "--help") {
      options.help = true;
      return options;
    }
    if (word + 1 == argc) throw UsageError(option + " has no value; --help lists the options");
    Set(option, argv[word + 1], &options);
  }
  return options;
}

}  // namespace example
