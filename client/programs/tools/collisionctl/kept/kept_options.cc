#include "client/programs/tools/collisionctl/kept/kept_options.h"

#include <cmath>
#include <cstdlib>
#include <regex>

#include "idl/recording/utc.h"

namespace collision::client {
namespace {

constexpr double kSecondsMax = 1e9;
constexpr std::int64_t kSecond = 1'000'000'000, kDay = 86'400 * kSecond;
constexpr char kStateFolders[] = "/var/lib/collisiond/";

double SecondsOfUnit(char unit) {
  switch (unit) {
    case 'd':
      return 86'400;
    case 'h':
      return 3600;
    case 'm':
      return 60;
    default:
      return 1;
  }
}

/// "2h", "30m", "1.5d", or a number of seconds; nullopt: it is none, or out of range.
std::optional<double> SecondsIn(const std::string& word) {
  static const std::regex form(R"((\d{1,10}(?:\.\d{1,9})?(?:e\d)?)([smhd]?))");
  std::smatch match;
  if (!std::regex_match(word, match, form)) return std::nullopt;
  const double seconds =
      std::stod(match[1]) * SecondsOfUnit(match[2].length() == 0 ? 's' : *match[2].first);
  return seconds <= kSecondsMax ? std::optional(seconds) : std::nullopt;
}

CLI::Validator TimeWord() {
  const auto check = [](const std::string& word) {
    if (WallTimeOf(word, 0)) return std::string();
    return "\"" + word + "\", allowed: seconds from 0 to 1e9, a time ago (45s, 30m, 2h, 3d), " +
           "YESTERDAY, TODAY, or " + wire::kUtcAllowed;
  };
  return CLI::Validator(check, "TIME");
}

}  // namespace

std::optional<std::int64_t> WallTimeOf(const std::string& word, std::int64_t now_ns) {
  if (const auto seconds = SecondsIn(word)) return now_ns - std::llround(*seconds * 1e9);
  if (word == "TODAY") return now_ns - now_ns % kDay;
  if (word == "YESTERDAY") return now_ns - now_ns % kDay - kDay;
  return wire::FromUtc(word);
}

std::optional<double> SinceSeconds(const KeptOptions& options) {
  const std::string& since = options.since;
  if (since.empty() || std::string("smhd").find(since.back()) != std::string::npos) return {};
  return SecondsIn(since);
}

bool AsksForJournal(const KeptOptions& options) {
  const bool is_time = !options.since.empty() && !SinceSeconds(options);
  return is_time || !options.until.empty() || !options.state_dir.empty();
}

void AddKeptEvents(CLI::App* events, KeptOptions* options) {
  events
      ->add_option("--since", options->since,
                   "A number: only revisions of the last so many seconds, 0 to 1e9. A time: the "
                   "contacts published since then, from the journal in the service's folder: 2h, "
                   "3d, YESTERDAY, TODAY, 2026-11-28, 2026-11-28T03:00 (UTC)")
      ->check(TimeWord());
  events->add_option("--until", options->until, "Of the journal: the contacts until then, likewise")
      ->check(TimeWord());
  events->add_option("--state-dir", options->state_dir,
                     "Show the journal in this folder; default: STATE_DIRECTORY, else "
                     "/var/lib/collisiond/WORLD");
}

CLI::App* AddRecordings(CLI::App* app, KeptOptions* options) {
  CLI::App* recordings = app->add_subcommand(
      "recordings", "Table of the flight recorder's segments; reads each to its end");
  recordings->add_option("DIR", options->folder,
                         "Their folder, or the service's state_dir; default: STATE_DIRECTORY, else "
                         "/var/lib/collisiond/WORLD");
  recordings->add_option("--state-dir", options->state_dir, "The same");
  return recordings;
}

std::string StateFolder(const KeptOptions& options, const std::string& world) {
  if (!options.folder.empty()) return options.folder;
  if (!options.state_dir.empty()) return options.state_dir;
  const char* of_systemd = std::getenv("STATE_DIRECTORY");
  if (of_systemd != nullptr && *of_systemd != '\0') return of_systemd;
  return kStateFolders + world;
}

}  // namespace collision::client
