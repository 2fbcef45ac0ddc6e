#include "client/programs/tools/collisionctl/examples.h"

namespace collision::client {
namespace {

struct Example {
  const char* command;
  const char* line;  ///< Behind the program's name, and what it does.
};

constexpr const char* kIndent = "                                        ";

constexpr Example kExamples[] = {
    {"status", "status                   whether all is well; else what is wrong, and what to do"},
    {"status", "status --all             every simulator, the broad phase and why, all counters"},
    {"doctor", "doctor                   why a world is silent, and what to type next"},
    {"doctor", "doctor --host 10.0.0.1   likewise; that host is asked by unicast, too"},
    {"health", "health                   for probes: one sentence, and exit code 0, 1 or 2"},
    {"health",
     "health --require-simulators 3 --max-age 2\n"
     "@critical if fewer are alive, or no new status comes within 2 s"},
    {"earliest", "earliest                 the pair that can touch first, and the earliest time"},
    {"agents", "agents                   every agent, and how long it is clear"},
    {"agents", "agents --watch           likewise every second, with fresh states, until Ctrl-C"},
    {"shapes", "shapes                   every shape: owner, triangles and solids, parts received"},
    {"events", "events                   the current revision of every event"},
    {"events", "events --follow          one line per revision as it comes, until Ctrl-C"},
    {"events",
     "events --agent ada --status possible,confirmed --within 10 --explain\n"
     "@what ada can meet in the next 10 s, in sentences"},
    {"events", "events --top 5           the five that are nearest in time"},
    {"events", "--world lab events --follow --json | jq 'select(.status == \"confirmed\")'"},
    {"events", "events --since YESTERDAY   the contacts since then, from the service's journal"},
    {"recordings", "recordings               the segments of the flight recorder, for --replay"},
    {"top", "top                      a live table of the nearest pairs"},
    {"why", "why ada bob              when the two can meet, why then, what would narrow it"},
    {"evict", "evict NAME               remove a simulator with its agents"},
    {"restart-time", "restart-time             lock-step: let time begin anew, for all simulators"},
    {"suggest-bounds",
     "suggest-bounds run.rec   bounds that the agents of a recording keep; also CSV, --live"},
    {"sphere-tree",
     "sphere-tree ship.obj     how well the spheres of a mesh fit it (needs no service)"},
};

constexpr const char* kForAll = R"(
Only evict and restart-time change anything in the world. The network is that of Cyclone DDS, set
by CYCLONEDDS_URI; it is printed on standard error at the start, with world and domain. Exit codes:
0 done, 1 refused, not answered within the timeout, or no such agent, 2 usage, 69 no service within
the timeout or no DDS, 74 the output cannot be written.)";

std::string LineOf(const Example& example) {
  std::string line = example.line;
  const std::size_t mark = line.find('@');
  if (mark != std::string::npos) line.replace(mark, 1, kIndent);
  return "  collisionctl " + line + "\n";
}

}  // namespace

std::string AllExamples() {
  std::string all = "\nExamples:\n";
  for (const Example& example : kExamples) all += LineOf(example);
  return all + kForAll;
}

std::string ExamplesOf(const std::string& command) {
  std::string own;
  for (const Example& example : kExamples) {
    if (command == example.command) own += LineOf(example);
  }
  return own.empty() ? own : "\nExamples:\n" + own;
}

}  // namespace collision::client
