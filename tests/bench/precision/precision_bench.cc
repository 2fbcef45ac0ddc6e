// ./run bench precision: error against run time, ours beside the libraries.
//
// A row is one point of a curve: each method of ours over its settings, each library over its
// tolerances, one thread, inputs seeded. precision: translation, rotation and grazing of homer with
// 500 triangles, of spot and rocker-arm (full run), and of pairs of capsule, box and hull, judged
// in rational arithmetic. contact: translation, rotation and grazing of boxes, balls, balls at 10
// km/s, plates; a bar that turns into a ball, a cube's edge into a plate; balls that pass, a cube's
// edge past a ball, with closed forms in long doubles.
//
// - Poses: gaps of 1e-3 to 0.5 of the size, and half as many overlaps up to 0.1; grazing: 1e-3,
//   1e-4 ... 1e-12 of the size on either side, as many of each. Exact arithmetic judges each pose,
//   and one that it contradicts is drawn anew.
// - Truth: tests/support/truth/exact_surfaces.h; for meshes over all pairs of triangles that a
//   certified distance leaves as candidates, for solids from the corners of their cores. The
//   numbers in a pose's matrix count as exact. CGAL, whose predicates are exact, is one of the
//   libraries and must never differ.
// - Fields: `seconds` is the median of a query. `width` (certified brackets only) and `error`
//   (|middle of the answer - truth|) are medians over bodies that are apart, in metres, or in
//   seconds of a step of 1 s; also `width_p90`, `error_p90`, `error_max`. `misses` counts "no"
//   where the truth is "yes", `false_alarms` the opposite, `undecided` neither, `without_truth`
//   brackets that do not contain the truth. A method that only answers yes or no has no `error`,
//   but `wrong_at_m`, the widest gap or overlap that it got wrong, and `right_at_m`, the smallest
//   that it got right. `limited_by` says what keeps a curve from going lower.
// - Ours: by budget and by requested width, of the fitted tree and of the octree; both orders of
//   refinement, one budget for all poses; down to the triangles; yes or no; for solids the quick
//   routine and the full search. The time of contact by its tolerance: ours certifies begin and
//   end, libraries give the begin.
// - Figures `..._at_best` take for each library the setting that is wrong least often. FCL 0.7
//   ignores the errors allowed for the distance of meshes and the tolerances of its advancement;
//   its polynomial solver takes meshes in translation only, its ray shooting is not written and
//   always answers no. Given two poses only, its motions turn about a point that is never set: both
//   benchmarks set it.
// - Stepping decides exactly in each frame, and reports the first frame that shows contact.
// - `peer_over_ours_at_equal_error_*` is the least ratio, over all cells, of a library's time
//   (where all its yes and no are right) to that of ours whose certified width is as small as the
//   library's error; errors below 1e-13 m and 1e-11 s count as these. `ours_width_in_peers_time_*`
//   is the widest bracket that ours leaves in the library's time.
#include <CLI/CLI.hpp>

#include "tests/bench/pairs/bench_mesh.h"
#include "tests/bench/precision/cell.h"

int main(int count, char** arguments) {
  using namespace collision::bench;
  CLI::App app("Measures error against run time, one thread, inputs seeded.", "precision-bench");
  PrecisionSettings settings;
  settings.data_dir = COLLISION_DATA_DIR;
  settings.AddTo(&app, "fewer meshes and poses: less than 20 seconds",
                 "only rows whose name PART/MOTION/MESH/METHOD/SETTING contains this");
  app.add_option("--data", settings.data_dir, "the folder with meshes/*.obj");
  CLI11_PARSE(app, count, arguments);
  if (!HasContestMeshes(settings.data_dir)) return 66;
  PrecisionReport report;
  MeshesPart(settings, &report);
  ConvexesPart(settings, &report);
  ContactTimesPart(settings, &report);
  SetFigures(&report);
  return Finish(report, settings.json);
}
