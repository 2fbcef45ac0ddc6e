// A scene of balls that move under forces, sent to a detector step by step: what it costs.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "collision_core/detection/detector.h"

namespace collision::bench {

struct SceneAgent {
  motion::MotionState state;
  detection::AgentDeclaration declaration;
};

struct DetectorScene {
  std::string name;
  std::vector<SceneAgent> agents;  ///< As they are at first.
  std::uint64_t seed = 1;          ///< Of the forces.
  double step = 0.1;               ///< From state to state [s].
  int steps = 40;
};

/// The scenes of baselines/scenes.h and the paper's, from 100 to 4000 agents; `few`: those of up to
/// 600 only.
std::vector<DetectorScene> DetectorScenes(bool few, int steps);

/// What is declared on top, of every agent: it must not change how they move.
struct Variation {
  detection::DetectorOptions options;
  std::function<void(SceneAgent*)> change = nullptr;
  bool forces = true;  ///< Random ones, within what is declared; else all coast.
};

struct DetectorCost {
  double broad_units = 0, narrow_units = 0;
  double seconds = 0;                    ///< Processor's time in the detector.
  double bytes = 0;                      ///< More in use at the end than before it was made.
  double messages = 0;                   ///< Events and changed clearances.
  std::string hash;                      ///< Of all events and clearances.
  detection::Detector::Profile profile;  ///< At the end.

  double units() const { return broad_units + narrow_units; }
};

/// Admits all agents, and then tells every agent's state in each step and takes what is new.
DetectorCost Cost(const DetectorScene& scene, const Variation& variation);

}  // namespace collision::bench
