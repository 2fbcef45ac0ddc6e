// ./run bench narrow-phase: our narrow phase beside the libraries and itself.
//
// Parts. decision: do the two touch. distance: to 1e-6 of it. bracket: to 1 % of the diameter; its
// figure compares with FCL's distance. convex decision, convex distance: the same for capsules,
// boxes and hulls, each kind against each. trees: overshoot r + s of a cut over the octree's, at
// the octree's own counts per level up to 700, and the share of the surface that is proven to be
// covered (tests/support/tree_coverage.h). build: the processor time to build a tree, beside FCL's.
// refinement: sixty pairs that share a budget, level by level and largest contribution first; total
// width of the brackets. budget: the most units by which a query exceeds its budget. cases: when
// moving bodies begin to touch, where the answer is closed. contact: the same for two meshes of 80k
// triangles; distribution of time and work.
//
// - Meshes are closed: homer with its edges collapsed to 500 triangles (pairs/edge_collapse.h),
//   spot (5,856), rocker-arm (20,088), rocker-arm with each triangle in four (80,352). The middle
//   of a mesh's box is its origin, its radius about it 1 m, so its bounding diameter 2 m. Both
//   bodies have the same mesh, and each contestant shares what it built of it.
// - Poses: 200 (quick: 40) for each mesh and gap. Rotation and direction are drawn uniformly from
//   one seed; B moves along the direction from where the centres coincide, and bisection finds the
//   offset. For a gap the certified distance is that share of the diameter, within a hundredth of
//   it. For an overlap B moves inwards by that share from where the bodies begin to touch; a pose
//   without certain contact there is drawn anew, and `redrawn` counts those. The frame of A is the
//   world's.
// - Warm: the same query again for at least 4 us; contestants take turns, and the best of several
//   such passes counts for a pose. Cold: one query after a walk over 64 MB, which empties the
//   caches of a core but not necessarily the last cache of a large processor. The table has the
//   median over the poses. The clock is the wall clock: reading the processor's takes too long for
//   a query of 50 ns.
// - Convex solids: a capsule, a box and a hull of 18 points, each with a bounding diameter of 2 m;
//   gaps, poses, warm, cold and judgement as for meshes. Ours are the core's routines for two
//   solids (pairs/convex_pair.h), from the caller's pose to the certified answer. FCL runs with
//   both of its solvers and with its own routines for boxes and for capsules, Bullet with GJK and
//   EPA, without margins. Their figures begin with `convex_`; a pair for which no library answers
//   within 1e-6 counts in none.
// - Ours starts from the caller's pose, with the tree that the service builds, without a hint from
//   an earlier query. "ours, octree" is the same with the reference builder.
// - FCL uses the trees that serve the query (OBB and OBBRSS to decide, RSS and OBBRSS for the
//   distance), one contact, none refined. GImpact runs by its own two steps, pairs of boxes and
//   then triangles until two meet: its dispatcher would collect all contacts. OPCODE runs through
//   ODE's collider with one unimportant contact. CGAL's trees are traversed together with exact
//   predicates. Neither FCL nor ODE tests whether one body is inside the other; at these poses none
//   is.
// - A decision must be what is certain of the pose, a distance must agree with the certified one
//   within 1e-6, a bracket must contain it and be narrow enough. A library's time counts while at
//   most one answer in twenty is wrong.
// - Figures are least ratios over meshes and gaps: `decision` over overlaps of 10 % and 0.1 % and
//   gaps of 1 % and 10 %, with gaps of 0.1 % and 50 % apart; `distance` and `bracket` over the four
//   gaps. Figures without `_cold` are warm. `build_vs_fcl_bvh_worst` is FCL's time over ours.
//   `tree_*_vs_octree` compares with TreeBuilder::kOctree, whose balls are smaller than the
//   octants' own where that helps; `tree_*_vs_circumscribed_octree` with balls that circumscribe
//   the octants, as in the paper.
// - BSP trees (tests/baselines/bsp_tree.h), the paper's exact comparison, run on the smallest mesh
//   only: they look at every face.
// - cases: ours has a tolerance of 1e-12 of the time. A row ends in WRONG, MISSES IT or FALSE ALARM
//   where an answer is off by more than 1e-3 of the step, or where ours does not contain the truth.
//   Bodies that touch without overlap may be undecided, but not free. FCL and Bullet take two
//   poses, so that they cannot express more than half a turn.
// - contact: steps of 1 s in which a turning body passes another one, up to 1.2 diameters aside;
//   some meet, some pass. FCL's advancement runs in a process of its own that ends after 5 s: where
//   it makes no progress it does not end. Its time is compared where both give the same answer. It
//   has not been seen to find the time of meshes that meet, so these are steps in which they pass.
#include <CLI/CLI.hpp>

#include "tests/bench/narrow_phase/parts.h"

int main(int count, char** arguments) {
  using namespace collision::bench;
  CLI::App app("Measures the narrow phase beside its peers, one thread, inputs seeded.",
               "narrow-phase-bench");
  NarrowSettings settings;
  settings.data_dir = COLLISION_DATA_DIR;
  settings.AddTo(&app, "fewer meshes and poses: a few minutes",
                 "only rows whose name PART/MESH/GAP/CONTESTANT contains this");
  app.add_option("--data", settings.data_dir, "the folder with meshes/*.obj");
  CLI11_PARSE(app, count, arguments);
  if (!HasContestMeshes(settings.data_dir)) return 66;
  NarrowReport report;
  ContestPart(settings, &report);
  ConvexPart(settings, &report);
  TreesPart(settings, &report);
  BuildPart(settings, &report);
  RefinementPart(settings, &report);
  BudgetPart(settings, &report);
  ContactCasesPart(settings, &report);
  ContactPart(settings, &report);
  return Finish(report, settings.json);
}
