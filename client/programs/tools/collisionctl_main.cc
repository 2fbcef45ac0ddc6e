// collisionctl: shows a running world from outside.
#include <CLI/CLI.hpp>
#include <csignal>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <vector>

#include "client/library/deadline.h"
#include "client/library/network/dds_transport.h"
#include "client/library/notices/notices.h"
#include "client/programs/shared/command_line.h"
#include "client/programs/shared/exit_code.h"
#include "client/programs/tools/certificates/command.h"
#include "client/programs/tools/collisionctl/agents_watcher.h"
#include "client/programs/tools/collisionctl/doctor/doctor.h"
#include "client/programs/tools/collisionctl/events/event_printer.h"
#include "client/programs/tools/collisionctl/examples.h"
#include "client/programs/tools/collisionctl/health.h"
#include "client/programs/tools/collisionctl/json/status_json.h"
#include "client/programs/tools/collisionctl/json/world_json.h"
#include "client/programs/tools/collisionctl/kept/kept_contacts.h"
#include "client/programs/tools/collisionctl/kept/recordings.h"
#include "client/programs/tools/collisionctl/operator_request.h"
#include "client/programs/tools/collisionctl/pages/text_pages.h"
#include "client/programs/tools/collisionctl/service_notes.h"
#include "client/programs/tools/collisionctl/status/status_details.h"
#include "client/programs/tools/collisionctl/status/status_page.h"
#include "client/programs/tools/collisionctl/top/top.h"
#include "client/programs/tools/collisionctl/view_options.h"
#include "client/programs/tools/collisionctl/why/agent_lookup.h"
#include "client/programs/tools/collisionctl/why/why_page.h"
#include "client/programs/tools/recordings/commands.h"
#include "client/programs/tools/sphere_tree/command.h"
#include "client/programs/tools/suggest_bounds/command.h"
#include "idl/limits.h"

namespace collision::client {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kQuiet{150};       // Nothing new for this long: the picture is complete.
constexpr milliseconds kFollowWait{250};  // Longest time to notice Ctrl-C.
constexpr milliseconds kBusy{1000};       // A world that is never quiet: likewise.

volatile std::sig_atomic_t stopped = 0;

/// Gathers the values that late readers receive, until `enough` and quiet, or until the deadline.
template <typename Enough>
void Gather(MessageMonitor* monitor, const Deadline& deadline, Enough enough) {
  std::optional<Deadline> busy;
  while (stopped == 0 && deadline.Remaining().count() > 0) {
    const auto wait = std::min<std::chrono::nanoseconds>(kQuiet, deadline.Remaining());
    const bool quiet = monitor->Poll(wait) == 0;
    if (!enough()) continue;
    if (!busy) busy.emplace(kBusy);
    if (quiet || busy->Remaining().count() == 0) return;
  }
}

bool WaitForService(MessageMonitor* monitor, const WorldView& view, const Deadline& deadline) {
  while (!view.status() && stopped == 0) {
    if (deadline.Remaining().count() == 0) return false;
    monitor->Poll(std::min<std::chrono::nanoseconds>(kFollowWait, deadline.Remaining()));
  }
  return view.status().has_value();
}

void Follow(MessageMonitor* monitor, WorldView* view, EventPrinter* printer) {
  ServiceNotes notes;
  while (stopped == 0 && std::cout) {
    printer->PrintGap(monitor->contacts_missed());
    printer->PrintNew(view);
    monitor->Poll(kFollowWait);
    const auto note = notes.Take(monitor->service_alive(), view->status());
    if (note) std::cerr << *note << '\n';
  }
  monitor->Poll(std::chrono::nanoseconds(0));  // What had arrived when it was told to stop.
  printer->PrintGap(monitor->contacts_missed());
  printer->PrintNew(view);
  std::cerr << ContactsSummary(view->contacts(), monitor->contacts_missed()) << '\n';
}

std::chrono::nanoseconds Seconds(double seconds) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
      std::chrono::duration<double>(seconds));
}

std::optional<std::int64_t> Nanoseconds(const std::optional<double>& seconds) {
  if (!seconds) return std::nullopt;
  return Seconds(*seconds).count();
}

EventFilter FilterOf(const ViewOptions& options) {
  EventFilter filter{.agents = options.agents,
                     .levels = options.levels,
                     .within_ns = Nanoseconds(options.within_s),
                     .since_ns = Nanoseconds(SinceSeconds(options.kept)),
                     .top = options.top,
                     .expected = options.expected};
  for (const std::string& status : options.statuses) filter.statuses.push_back(*StatusOf(status));
  return filter;
}

Place PlaceOf(const MonitorOptions& options) {
  return {options.world, options.domain, options.credentials};
}

/// Prints the agents once a period, with states that are no older, until Ctrl-C.
void WatchAgents(MessageMonitor* monitor, const WorldView& view, const ViewOptions& options) {
  const std::chrono::nanoseconds period = Seconds(options.period_s);
  AgentsWatcher watcher(ConnectWatcher(PlaceOf(options.monitor)), period);
  auto due = std::chrono::steady_clock::now() + period;
  while (stopped == 0 && std::cout) {
    const auto now = std::chrono::steady_clock::now();
    watcher.Repeat(now);
    if (now >= due) {
      due = now + period;
      std::cout << (options.json ? AgentsJson(view) : AgentsPage(view)) << std::endl;
    }
    monitor->Poll(std::min<std::chrono::nanoseconds>(kFollowWait, due - now));
  }
}

/// Says why a pair meets when it does. Returns the exit code.
int PrintWhy(const ViewOptions& options, WorldView* view) {
  try {
    const AgentView a = FindAgent(*view, options.pair[0]), b = FindAgent(*view, options.pair[1]);
    if (IdOf(a) == IdOf(b)) throw NoSuchAgent("A and B are the same agent, " + options.pair[0]);
    const PairReport report = ReportOn(a, b, NewestOf(IdOf(a), IdOf(b), view), *view);
    std::cout << (options.json ? WhyJson(report, *view) + "\n" : WhyPage(report, *view));
    return kExitOk;
  } catch (const NoSuchAgent& error) {
    std::cerr << "collisionctl: " << error.what() << '\n';
    return kExitRefused;
  }
}

void Print(const std::string& command, const ViewOptions& options, WorldView* view) {
  if (command == "status") {
    std::cout << (options.json  ? StatusJson(*view) + "\n"
                  : options.all ? StatusDetails(*view)
                                : StatusPage(*view));
  } else if (command == "agents") {
    std::cout << (options.json ? AgentsJson(*view) + "\n" : AgentsPage(*view));
  } else if (command == "shapes") {
    std::cout << (options.json ? ShapesJson(*view) + "\n" : ShapesPage(*view));
  } else if (options.json) {
    std::cout << EarliestJson(*view) << '\n';
  } else {
    std::cout << EarliestPage(*view);
  }
}

int Run(const std::string& command, const ViewOptions& options) {
  std::cerr << "collisionctl: " << PlaceText(options.monitor.world, options.monitor.domain) << '\n';
  WorldView view;
  MessageMonitor monitor(options.monitor, view.Callbacks());
  const Deadline deadline(Seconds(options.timeout_s));
  if (!WaitForService(&monitor, view, deadline)) {
    if (stopped != 0) return 0;
    if (!monitor.unreadable().empty()) {
      std::cerr << "collisionctl: " << monitor.unreadable() << '\n';
      return kExitUnavailable;
    }
    std::cerr << "collisionctl: no service in world \"" << options.monitor.world << "\" on domain "
              << options.monitor.domain << " within " << options.timeout_s << " s\n";
    return kExitUnavailable;
  }
  // The earliest intersection is computed for its readers: the last sample may be of long ago.
  const bool awaits_earliest =
      (command == "earliest" || command == "status") && view.status()->phase() == v1::PHASE_SERVING;
  const std::int64_t since_ns = view.status()->now_ns();
  Gather(&monitor, deadline, [&] {
    if (awaits_earliest && !(view.earliest() && view.earliest()->now_ns() >= since_ns))
      return false;
    return view.knows_all_agents();
  });
  if (!view.knows_all_agents() && stopped == 0) {
    std::cerr << "collisionctl: not all agents were heard within " << options.timeout_s
              << " s: what follows may be incomplete; --timeout sets how long to wait\n";
  }
  if (command == "why") {
    if (const int code = PrintWhy(options, &view); code != kExitOk) return code;
  } else if (options.watch) {
    WatchAgents(&monitor, view, options);
  } else if (command == "top") {
    TopOptions top = options.top_view;
    top.period = Seconds(options.period_s);
    top.json = options.json;
    RunTop(top, &monitor, &view, [] { return stopped != 0; });
  } else if (command == "events") {
    const EventFilter filter = FilterOf(options);
    if (const std::string wrong = UnknownLevelText(filter, view); !wrong.empty()) {
      std::cerr << "collisionctl: " << wrong << '\n';
      return kExitUsage;
    }
    if (const std::string absent = AbsentAgentsText(filter, view); !absent.empty()) {
      std::cerr << "collisionctl: " << absent << '\n';
    }
    EventPrinter printer({.json = options.json, .explain = options.explain}, filter, &std::cout);
    options.follow ? Follow(&monitor, &view, &printer) : printer.PrintCurrent(&view);
  } else {
    Print(command, options, &view);
  }
  std::cout.flush();
  if (std::cout) return 0;
  std::cerr << "collisionctl: the output cannot be written\n";
  return kExitOutputFailed;
}

/// To the help of the program all examples, to that of a command its own.
void AddExamples(CLI::App* app) {
  app->footer(AllExamples());
  for (CLI::App* command : app->get_subcommands(nullptr)) {
    const std::string own = ExamplesOf(command->get_name());
    if (command->get_footer().empty()) command->footer(own);
  }
}

HealthOptions With(const ViewOptions& options, HealthOptions health) {
  health.world = options.monitor.world;
  health.domain = options.monitor.domain;
  health.credentials = options.monitor.credentials;
  health.json = options.json;
  return health;
}

DoctorOptions With(const ViewOptions& options, DoctorOptions doctor) {
  doctor.world = options.monitor.world;
  doctor.domain = options.monitor.domain;
  doctor.credentials = options.monitor.credentials;
  doctor.timeout_s = options.timeout_s;
  doctor.json = options.json;
  return doctor;
}

/// The events of the journal, for which no service is needed.
int PrintJournal(const ViewOptions& options) {
  if (options.follow) {
    std::cerr << "collisionctl: --follow shows what comes, the journal what was: give one\n";
    return kExitUsage;
  }
  if (options.top || options.within_s) {
    std::cerr << "collisionctl: --top and --within are of what lies ahead, the journal is of what "
                 "was\n";
    return kExitUsage;
  }
  const MonitorOptions& place = options.monitor;
  return PrintKeptContacts(options.kept, place.world, place.domain,
                           {.json = options.json, .explain = options.explain}, FilterOf(options));
}

int Operate(const ViewOptions& options, const v1::OperatorCommand& command) {
  const Place place = PlaceOf(options.monitor);
  try {
    std::cerr << "collisionctl: " << PlaceText(place.world, place.domain) << '\n';
    return RunOperatorRequest(place, options.timeout_s, command, options.json);
  } catch (const std::runtime_error& error) {
    std::cerr << "collisionctl: " << error.what() << '\n';
    return kExitUnavailable;
  }
}

/// The exit code, where the command line asks for no more than help or is wrong.
std::optional<int> Parse(CLI::App* app, int argc, char** argv) {
  try {
    app->parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::RequiredError& error) {
    const std::vector<std::string> words = app->remaining();
    if (words.empty() || !app->get_subcommands().empty()) return app->exit(error), kExitUsage;
    std::cerr << "collisionctl: \"" << words.front() << "\": no such command; see --help\n";
    return kExitUsage;
  } catch (const CLI::ParseError& error) {
    return app->exit(error) == 0 ? kExitOk : kExitUsage;
  }
}

int Main(int argc, char** argv) {
  CLI::App app("Shows what collisiond and the simulators of a world publish.", "collisionctl");
  ViewOptions options;
  AddViews(&app, &options);
  std::string evicted;
  CLI::App* evict = app.add_subcommand("evict", "Remove a simulator, also if its process lives");
  evict->add_option("NAME", evicted, "Its name")->required()->check(IdentifierWord());
  CLI::App* restart =
      app.add_subcommand("restart-time", "Lock-step: let the world's time begin anew");
  SphereTreeOptions tree;
  const CLI::App* sphere_tree = AddSphereTreeCommand(&app, &tree);
  SuggestBoundsOptions bounds;
  const CLI::App* suggest_bounds = AddSuggestBoundsCommand(&app, &bounds);
  CertificateOptions certificates;
  const CLI::App* make_certificates = AddCertificatesCommand(&app, &certificates);
  HealthOptions health;
  const CLI::App* health_command = AddHealthCommand(&app, &health);
  DoctorOptions doctor;
  const CLI::App* doctor_command = AddDoctorCommand(&app, &doctor);
  const CLI::App* recordings = AddRecordings(&app, &options.kept);
  const RecordingCommands recorded(&app);
  AddExamples(&app);
  AddVersion(&app);
  if (const std::optional<int> code = Parse(&app, argc, argv)) return *code;
  if (health_command->parsed()) return RunHealth(With(options, health));
  if (doctor_command->parsed()) return RunDoctor(With(options, doctor));
  if (sphere_tree->parsed()) {
    if (options.json) tree.report = "json";
    return RunSphereTree(tree);
  }
  if (const auto code = recorded.Run(options.monitor, options.timeout_s)) return *code;
  if (make_certificates->parsed()) return RunMakeCertificates(certificates, GivenPlace(app));
  if (suggest_bounds->parsed()) {
    const MonitorOptions& place = options.monitor;
    return RunSuggestBounds(
        bounds, {place.world, place.domain, options.timeout_s, place.credentials}, options.json);
  }
  if (evict->parsed() || restart->parsed()) {
    const auto kind = evict->parsed() ? v1::OPERATOR_EVICT : v1::OPERATOR_RESTART_TIME;
    return Operate(options, MakeCommand(kind, evicted));
  }
  if (recordings->parsed()) {
    return PrintRecordings(options.kept, options.monitor.world, options.json);
  }
  if (app.got_subcommand("events") && AsksForJournal(options.kept)) return PrintJournal(options);
  const auto stop = [](int) { stopped = 1; };
  std::signal(SIGINT, stop);
  std::signal(SIGTERM, stop);
  try {
    return Run(app.get_subcommands().front()->get_name(), options);
  } catch (const std::runtime_error& error) {
    std::cerr << "collisionctl: " << error.what() << '\n';
    return kExitUnavailable;
  }
}

}  // namespace
}  // namespace collision::client

int main(int argc, char** argv) {
  try {
    return collision::client::Main(argc, argv);
  } catch (const std::invalid_argument& error) {
    // COLLISION_DOMAIN is no domain.
    std::cerr << "collisionctl: " << error.what() << '\n';
    return collision::client::kExitUsage;
  }
}
