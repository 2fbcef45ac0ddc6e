// The command line of the commands that show something of a running world.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "client/programs/tools/collisionctl/kept/kept_contacts.h"
#include "client/programs/tools/collisionctl/top/top.h"
#include "collision/monitor.h"

namespace collision::client {

/// What the command line says of the commands that show something.
struct ViewOptions {
  MonitorOptions monitor{.simulators = true};
  double timeout_s = 3;
  bool json = false;
  bool follow = false;
  bool watch = false;
  bool all = false;
  TopOptions top_view;
  std::string pair[2];  ///< Of why.
  bool explain = false;
  bool expected = false;
  std::vector<std::string> agents, statuses, levels;
  std::optional<double> within_s;
  KeptOptions kept;
  std::optional<std::size_t> top;
  double period_s = 1;
};

/// The options of all commands, and those commands.
void AddViews(CLI::App* app, ViewOptions* options);

}  // namespace collision::client
