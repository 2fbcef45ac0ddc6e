// What collisionctl shows of the files that a service keeps, also when none runs.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>

namespace collision::client {

struct KeptOptions {
  std::string since, until;  ///< As on the command line; empty: not given.
  std::string state_dir;
  std::string folder;  ///< Of `recordings`.
};

/// --since, --until and --state-dir of `events`.
void AddKeptEvents(CLI::App* events, KeptOptions* options);

/// The command `recordings`.
CLI::App* AddRecordings(CLI::App* app, KeptOptions* options);

/// Whether `events` is to show the journal of contacts, in place of what the service tells now.
bool AsksForJournal(const KeptOptions& options);

/// --since as a number of seconds, if it is one.
std::optional<double> SinceSeconds(const KeptOptions& options);

/// Wall time of a word of --since or --until [ns]; nullopt: it is none.
std::optional<std::int64_t> WallTimeOf(const std::string& word, std::int64_t now_ns);

/// The folder of the service: the one given, or that of systemd for the world.
std::string StateFolder(const KeptOptions& options, const std::string& world);

}  // namespace collision::client
