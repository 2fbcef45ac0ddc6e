#include "client/programs/tools/collisionctl/view_options.h"

#include "client/programs/shared/command_line.h"
#include "client/programs/tools/collisionctl/events/event_printer.h"
#include "idl/limits.h"

namespace collision::client {
namespace {

/// Words of a status, one or several, separated by commas.
CLI::Validator StatusWord() {
  const auto check = [](const std::string& text) {
    if (StatusOf(text)) return std::string();
    return "\"" + text + "\", allowed: possible, confirmed, dismissed, undecided, withdrawn, ended";
  };
  return CLI::Validator(check, "STATUS");
}

/// The name of an agent, alone or behind its simulator's.
CLI::Validator AgentWord() {
  const auto check = [](const std::string& text) {
    if (!text.empty() && text.size() <= 2 * wire::kNameMax + 1) return std::string();
    return "\"" + text + "\", allowed: AGENT or SIMULATOR:AGENT, 1 to 129 bytes";
  };
  return CLI::Validator(check, "NAME");
}

void AddEvents(CLI::App* app, ViewOptions* options) {
  constexpr double kSecondsMax = 1e9;
  CLI::App* events = app->add_subcommand("events", "The current events");
  events->add_flag("--follow", options->follow, "Print every further revision as it arrives");
  events->add_flag("--explain", options->explain, "One plain sentence for each event");
  events
      ->add_option("--agent", options->agents,
                   "Only events of this agent, on either side: AGENT or SIMULATOR:AGENT")
      ->check(AgentWord());
  events
      ->add_option("--status", options->statuses,
                   "Only these: possible, confirmed, dismissed, undecided, withdrawn, ended")
      ->delimiter(',')
      ->check(StatusWord());
  events->add_flag("--expected", options->expected,
                   "Of possible events only those in which the two touch if both keep the motion "
                   "that they told");
  events
      ->add_option("--level", options->levels,
                   "Only events of these levels of the service; contact: of contact itself")
      ->delimiter(',');
  events
      ->add_option("--within", options->within_s,
                   "Only what begins at most so many seconds ahead of now, 0 to 1e9")
      ->check(Finite(kSecondsMax, true));
  AddKeptEvents(events, &options->kept);
  events
      ->add_option(
          "--top", options->top,
          "Only the so many that are nearest in time, 1 to 4096; expected ones first, then "
          "the nearest")
      ->check(WholeBetween(1, EventSelection::kRememberedMax));
}

void AddTop(CLI::App* app, ViewOptions* options) {
  constexpr double kPeriodMin = 0.1, kPeriodMax = 3600;
  constexpr std::size_t kRowsMax = 1000;
  CLI::App* top = app->add_subcommand(
      "top", "The pairs that are nearest in time, drawn anew every period until Ctrl-C or q");
  top->add_option("--rows", options->top_view.rows, "Pairs to show at most, 1 to 1000")
      ->check(WholeBetween(1, kRowsMax))
      ->capture_default_str();
  top->add_option("--period", options->period_s, "Seconds between two pictures, 0.1 to 3600")
      ->check(Between(kPeriodMin, kPeriodMax))
      ->capture_default_str();
  top->add_flag("--once", options->top_view.once, "Print it once");
}

void AddWhy(CLI::App* app, ViewOptions* options) {
  CLI::App* why = app->add_subcommand(
      "why", "Of two agents: their bounds, when they can meet, and what would narrow it");
  why->add_option("A", options->pair[0], "AGENT or SIMULATOR:AGENT")
      ->required()
      ->check(AgentWord());
  why->add_option("B", options->pair[1], "Likewise")->required()->check(AgentWord());
}

}  // namespace

void AddViews(CLI::App* app, ViewOptions* options) {
  AddWorldOptions(app, "World to look at", &options->monitor.world, &options->monitor.domain,
                  &options->monitor.credentials);
  app->add_option("--timeout", options->timeout_s, "Seconds to wait for a service, 0 to 1e6")
      ->check(Between(0.0, 1e6))
      ->capture_default_str();
  app->add_flag("--json", options->json, "JSON for programs: one document, or one line per event");
  app->require_subcommand(1);
  app->fallthrough();
  app->add_subcommand("status", "In 12 lines: what is wrong and what to do, service, simulators")
      ->add_flag("--all", options->all, "All that the service tells, with every simulator");
  CLI::App* agents = app->add_subcommand("agents", "Table of all agents");
  CLI::Option* watch = agents->add_flag(
      "--watch", options->watch,
      "Print it again and again; meanwhile simulators send states at least once a period");
  agents->add_option("--period", options->period_s, "Seconds between two tables, 0.02 to 3600")
      ->check(Between(1e-9 * wire::kWatchPeriodMin, 1e-9 * wire::kWatchPeriodMax))
      ->needs(watch)
      ->capture_default_str();
  app->add_subcommand("shapes", "Table of all shapes that agents have");
  app->add_subcommand("earliest", "The earliest intersection that is possible now");
  AddEvents(app, options);
  AddTop(app, options);
  AddWhy(app, options);
}

}  // namespace collision::client
