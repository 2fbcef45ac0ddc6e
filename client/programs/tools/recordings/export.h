// collisionctl export: an event of a recording as a page of one file.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace collision::client {

struct ExportOptions {
  std::string input;  ///< Recording, segment, or folder of segments.
  std::string from, until;
  std::string html;           ///< The page that is written.
  std::string around;         ///< Of which event; empty: the first contact.
  double before_s = 30;       ///< Of the world's time, before the event begins.
  double after_s = 10;        ///< And after it has ended.
  double rate_hz = 10;        ///< States of an agent, at most, a second.
  std::string page_template;  ///< Empty: that of the gateway, as it is installed or was built.
};

/// Adds the subcommand. `options` outlives `app`.
CLI::App* AddExportCommand(CLI::App* app, ExportOptions* options);

/// Returns the exit code; errors are printed on standard error.
int RunExport(const ExportOptions& options);

}  // namespace collision::client
