// The parts of the narrow phase's benchmark, and what they share.
#pragma once

#include <string>

#include "tests/bench/harness/options.h"
#include "tests/bench/narrow_phase/report.h"
#include "tests/bench/pairs/timing.h"

namespace collision::bench {

struct NarrowSettings : CommonOptions {
  std::string data_dir;

  std::size_t poses() const { return quick ? 40 : 200; }
  std::size_t contacts() const { return quick ? 8 : 24; }
  TimingPlan plan() const { return quick ? TimingPlan{2, 1, 10} : TimingPlan{}; }
};

/// Decision, distance and bracket beside the libraries: meshes by gap classes.
void ContestPart(const NarrowSettings& settings, NarrowReport* report);
/// Decision and distance of capsules, boxes and hulls: pairs of kinds by gap classes.
void ConvexPart(const NarrowSettings& settings, NarrowReport* report);
/// How well the fitted builder's balls fit, beside the octree's.
void TreesPart(const NarrowSettings& settings, NarrowReport* report);
/// How long building takes, beside FCL's.
void BuildPart(const NarrowSettings& settings, NarrowReport* report);
/// Many pairs, one budget: the two orders of refinement beside each other.
void RefinementPart(const NarrowSettings& settings, NarrowReport* report);
/// By how much a budget is overrun.
void BudgetPart(const NarrowSettings& settings, NarrowReport* report);
/// When two bodies begin to touch, where the answer is closed: ours and the libraries'.
void ContactCasesPart(const NarrowSettings& settings, NarrowReport* report);
/// The same of two large meshes: the distribution of time and work.
void ContactPart(const NarrowSettings& settings, NarrowReport* report);

}  // namespace collision::bench
