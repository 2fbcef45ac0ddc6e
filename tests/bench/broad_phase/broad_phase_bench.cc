// ./run bench broad-phase: our broad phase beside the libraries, the baselines and itself.
//
// Parts. scratch: the earliest intersection of all, every bound new, horizon 1 s, 100 to a million
// agents; the first hit comes at once, at half the horizon, or never. incremental: one agent gets a
// new bound, then the earliest of all is current; mean, p50 and p99 of an update. turk: the paper's
// experiment at 60 Hz until the first collision; total of all frames, and the slowest. scenes: as
// scratch, with clustered, mixed, regular and degenerate scenes.
//
// - Each contestant starts from the same array of 72-byte records. Ours gets every bound by Set()
//   and one query; `fill_s` in the JSON is the part of Set(). Objects and their memory are kept
//   between repetitions; bounds, boxes, grids and trees are new.
// - Freed pages stay in the process, after one query that does not count: memory is warm for all.
// - The clock is the processor time of one process, so that neither another user of the machine nor
//   a second thread distorts it. Single updates, and frames of fewer than 1000 cubes, are too short
//   for that clock and use the wall clock.
// - Libraries get boxes swept over the horizon, one closed-form test in doubles that rejects most
//   pairs without a root, and the best answer so far as a limit. They run once over the whole
//   horizon and once in windows of 1/16, 1/4 and 1; the better run counts. Embree uses its Morton
//   builder, boxes computed once (it asks for each three times), and one thread.
// - Each cell runs in a process of its own that ends at 10 s of processor time (quick: 5 s). A
//   method that was too slow with fewer agents is not tried: its time would have to grow less than
//   the number of agents.
// - Our methods must agree bit for bit with each other. Libraries answer in doubles and must agree
//   within 1e-8 of the time and 2 ns.
// - "Ours" in a figure is AdaptiveBroadPhase. `growth_exponent` is the greatest of three fits, one
//   for each first hit, over 1000 agents and more. `swarm_message_ratio` comes from ./run demo
//   swarm, which a whole run starts first.
// - incremental: balls swing about their homes, half a second to warm up and then on; no two ever
//   touch, and their bounds meet all the time. Ours and Bullet use the same queue
//   (tests/baselines/lazy_earliest.h). "Bullet" asks its tree for the renewed agent at once, the
//   common use; "Bullet, asked lazily" uses our queue's way, which separates the effect of the
//   queue from that of the index.
// - turk: every loop sees the same cubes and must name the same frame and pair. A frame's time is
//   the least of several identical runs. Turk's hash runs with ten cell sizes, and the best total
//   counts. Ours is tests/baselines/window_loop.h, which makes its list with the core's PointGrid;
//   the loop with a queue of agents stands beside it.
#include <CLI/CLI.hpp>

#include "tests/bench/broad_phase/parts.h"

int main(int count, char** arguments) {
  using namespace collision::bench;
  CLI::App app("Measures the broad phase beside its peers, one thread, inputs seeded.",
               "broad-phase-bench");
  Settings settings;
  settings.AddTo(&app, "fewer agents and repetitions: a few minutes",
                 "only cells whose name PART/SCENE/AGENTS/CONTESTANT contains this");
  app.add_option("--swarm-report", settings.swarm_report,
                 "what ./run demo swarm --json wrote: for the swarm's figure")
      ->check(CLI::ExistingFile);
  CLI11_PARSE(app, count, arguments);
  Report report;
  ScratchPart(settings, &report);
  IncrementalPart(settings, &report);
  TurkPart(settings, &report);
  ScenesPart(settings, &report);
  SwarmPart(settings, &report);
  return Finish(report, settings.json);
}
