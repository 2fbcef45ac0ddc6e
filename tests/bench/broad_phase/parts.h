// The parts of the benchmark, and what they share.
#pragma once

#include <string>

#include "tests/baselines/ball_scene.h"
#include "tests/bench/broad_phase/contestant.h"
#include "tests/bench/broad_phase/report.h"
#include "tests/bench/harness/options.h"

namespace collision::bench {

struct Settings : CommonOptions {
  std::string swarm_report;  ///< The JSON of a demo run; empty: none.

  /// A cell that takes longer is given up [s].
  double cut_off() const { return quick ? 5 : 10; }
  /// Repetitions end when they took so long, but there are three at least [s].
  double patience() const { return quick ? 0.4 : 1.0; }
};

/// Whether any contestant is wanted there: scenes take time to draw.
bool WantsAny(const Settings& settings, const std::string& part, const std::string& scene,
              std::size_t agents);

/// A scene, its name, and the part of the benchmark to which its rows belong.
struct NamedScene {
  std::string part, name;
  baselines::BallScene balls;
};

/// One contestant on one scene from scratch, repeated; adds the row, and returns it.
Row MeasureFromScratch(const Settings& settings, const NamedScene& scene, const Entrant& entrant,
                       Report* report);

/// Every entrant on one scene; marks answers that do not agree.
std::vector<Row> MeasureAll(const Settings& settings, const NamedScene& scene, Report* report);

/// The least time of the libraries over the time of what the service would pick; nullopt if either
/// is missing.
std::optional<double> PeerOverOurs(const std::vector<Row>& rows);

void ScratchPart(const Settings& settings, Report* report);
void IncrementalPart(const Settings& settings, Report* report);
void TurkPart(const Settings& settings, Report* report);
void ScenesPart(const Settings& settings, Report* report);
void SwarmPart(const Settings& settings, Report* report);

}  // namespace collision::bench
