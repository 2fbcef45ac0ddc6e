// ./run bench service: latency, throughput and messages of the whole service.
//
// - latency: from writing a state that jumps to a place half a second before a meeting, until its
//   event arrives; 100, 1000 and 10,000 agents, p50 and p99. Then updates per second: all agents
//   send their states in chunks of 64, again as soon as all are acknowledged.
// - security, recorder: the same latency and throughput of 1000 agents, of the service with the
//   option and without, seven pairs one after the other; medians of their ratios. The options are
//   each protection of a secured world, and the flight recorder with the journal of contacts.
// - crowd: the same latency, of a simulator of 100 agents, alone and beside another one with 363
//   agents of one mesh of 3,160 triangles, which all overlap and send 60 states a second each. The
//   ratio of the medians is what a greedy simulator costs the others.
// - messages: states that a swarm sends on demand, as a ratio of those of a 60 Hz stream; M,
//   distance and speed each varied by itself. Client library and daemon run in one process, answers
//   come at once, and the first second does not count.
// - at-rest: a step in which all agents tell that they rest, and every sixth asks for the earliest
//   possible intersection as the daemon does; a lattice, in which all tie, beside a jittered one.
//   The detector alone.
// - "network" is a process with the same DdsBus and no detector: it answers each chunk at once with
//   a clearance and each jump with an event. "ours" is the daemon on the wall clock. The same
//   simulator measures one after the other in the same run, over DDS on loopback, with the same
//   topics, in a world of its own; it uses DdsSession without the client library. All share the
//   processors of the machine.
// - `limited by` names the larger share of a round: what "network" takes too, or the rest. For
//   messages it names what makes states wanted soon, estimated from spacing, speed and M, not
//   measured.
// - Every service is a process that is ended by its id, and ends with the benchmark.
#include <CLI/CLI.hpp>

#include "tests/bench/service/parts.h"
#include "tests/bench/service/process.h"

int main(int count, char** arguments) {
  using namespace collision::bench;
  CLI::App app("Measures the service beside a program that answers at once, on this machine only.",
               "service-bench");
  ServiceSettings settings;
  std::string contestant, world;
  ServiceFolders folders;
  settings.AddTo(&app, "fewer agents and repetitions: less than 30 s",
                 "only cells whose name PART/WHAT contains this");
  app.add_option("--domain", settings.domain, "DDS domain")->check(CLI::Range(0, 230));
  app.add_option("--serve", contestant, "")->group("");  // the child's side
  app.add_option("--world", world, "")->group("");
  app.add_option("--credentials", folders.credentials, "")->group("");
  app.add_option("--state", folders.state, "")->group("");
  CLI11_PARSE(app, count, arguments);
  if (!contestant.empty()) return Serve(contestant, world, settings.domain, folders);
  ServiceReport report;
  AtRestPart(settings, &report);
  MessagesPart(settings, &report);
  LatencyPart(settings, &report);
  OptionsPart(settings, &report);
  CrowdPart(settings, &report);
  return Finish(report, settings.json);
}
