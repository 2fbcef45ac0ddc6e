// What moved between two reports, and by how much more than the noise.
#pragma once

#include <string>
#include <vector>

#include "idl/report.pb.h"

namespace collision::report {

struct Move {
  std::string experiment;
  std::string figure;
  std::string before, after;  ///< As texts; empty: not measured.
  double change = 0;          ///< after / before - 1.
  double factor = 1;  ///< As far up as down: the greater over the smaller, infinite to or from 0.
  double noise = 0;   ///< A factor of 1 + noise says nothing.
  /// By how much more than the noise it moved: (factor - 1) / noise.
  double OverNoise() const { return (factor - 1) / noise; }
  bool moved = false;  ///< It changed by more than the noise, or is measured in one of them only.
};

struct Comparison {
  std::vector<Move> moves;           ///< Of every figure in either, what moved most first.
  std::vector<std::string> remarks;  ///< Other machine, other mode, other hashes.
};

/// The noise of an experiment is the greater of two: how far the times of the reference work lie
/// apart in either report, and how far the single times of the experiment's measurements moved
/// against each other (three times their median deviation from the median move). Figures that count
/// (units, misses, bytes, hashes) have none: every change of theirs has moved.
Comparison Compare(const v1::Results& before, const v1::Results& after);

/// For a terminal: what moved, and how many figures did not.
std::string TextOf(const Comparison& comparison);

}  // namespace collision::report
