// The methods of the neighbour index, for a caller that chooses one by name.
#pragma once

namespace collision::broad_phase {

/// How a neighbour index finds candidate pairs. All methods give the same answers, bit for bit;
/// they differ in cost alone. The face sweep is not among them: it answers one query about a
/// whole set of bounds (face_sweep/face_sweep.h) and has no incremental form.
enum class BroadPhaseMethod {
  kAuto,          ///< All pairs or the spatial index, by counted work.
  kAllPairs,      ///< Every pair is tested by a cheap filter.
  kSpatialIndex,  ///< Grids by reach.
  kExhaustive,    ///< Every pair is given to the canonical routine: the reference of the others.
};

/// "all pairs", "spatial index", "exhaustive", "chosen by the scene".
const char* Name(BroadPhaseMethod method);

}  // namespace collision::broad_phase
