// All methods at the poses of one motion and one pair of bodies: asked, timed, judged.
#pragma once

#include <string>
#include <vector>

#include "tests/bench/harness/options.h"
#include "tests/bench/pairs/pose.h"
#include "tests/bench/pairs/timing.h"
#include "tests/bench/precision/report.h"

namespace collision::bench {

struct PrecisionSettings : CommonOptions {
  std::string data_dir;

  std::size_t poses() const { return quick ? 10 : 40; }
  TimingPlan plan() const { return quick ? TimingPlan{1, 0.05, 0} : TimingPlan{3, 0.5, 0}; }
  std::size_t contacts() const { return quick ? 6 : 24; }
  int passes() const { return quick ? 1 : 3; }
  /// A query that takes longer is given up [s], and after so many of them the method.
  double contact_cut_off() const { return quick ? 0.05 : 1; }
  std::size_t endless_max() const { return quick ? 0 : 2; }
};

struct PrecisionCell {
  Motion motion;
  std::string mesh;
  double diameter = 0;  ///< [m]
  std::vector<JudgedPose> poses;
};

void MeasureCell(const PrecisionSettings& settings, const PrecisionCell& cell,
                 const PairMethods& methods, PrecisionReport* report);

/// Whether any method at this cell is wanted: poses take time to draw.
bool WantsAny(const PrecisionSettings& settings, Motion motion, const std::string& mesh,
              const PairMethods& methods);

/// Two bodies of one mesh, and pairs of convex solids: error against time.
void MeshesPart(const PrecisionSettings& settings, PrecisionReport* report);
void ConvexesPart(const PrecisionSettings& settings, PrecisionReport* report);
/// The time of contact likewise, where its answer is closed.
void ContactTimesPart(const PrecisionSettings& settings, PrecisionReport* report);

}  // namespace collision::bench
