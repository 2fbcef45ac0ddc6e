// The methods of the broad phase, for those who choose one by name.
#pragma once

namespace collision::broad_phase {

/// How the broad phase finds candidate pairs. All methods give the same answers, bit for bit; they
/// differ in cost alone.
enum class BroadPhaseMethod {
  kAuto,         ///< All pairs or the spatial index, by counted work.
  kAllPairs,     ///< Every pair is tested.
  kFaceSweep,    ///< The paper's face sweep; a question about one agent tests every partner.
  kSpatialIndex  ///< Grids by reach.
};

/// "all pairs", "face sweep", "spatial index", "chosen by the scene".
const char* Name(BroadPhaseMethod method);

}  // namespace collision::broad_phase
