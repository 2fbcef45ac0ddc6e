// Which scenes are flown under which conditions, and how long.
#pragma once

#include <string>
#include <vector>

#include "client/programs/scene_runner/scene_file.h"
#include "tests/repeat/condition.h"

namespace collision::repeat {

struct Choice {
  bool quick = false;        ///< Two scenes.
  std::string only = {};     ///< Part of SCENE/CONDITION.
  double seconds = 0;        ///< Simulated; 0: as the scene says.
  double paced_max_s = 120;  ///< A longer scene is flown faster than real time where it is paced.
};

/// Flights of a scene under one condition.
struct Series {
  std::string scene;
  double seconds = 0;  ///< Simulated.
  double speed = 0;    ///< Simulated seconds a second; 0: no limit.
  Condition condition;

  std::string name() const { return scene + "/" + condition.name; }
};

struct Chosen {
  std::vector<Series> series;         ///< Scene by scene.
  std::vector<std::string> left_out;  ///< "NAME: why".
};

/// Why the events of a scene need not be the same every time; empty: they are.
std::string WhyNotRepeatable(const v1::Scene& scene);

/// All of one length: only such flights can have the same event log.
std::vector<Series> SeriesOf(const std::string& name, double scene_seconds, const Choice& choice,
                             const std::vector<Condition>& conditions);

/// From all scenes of the folder.
Chosen Choose(const client::Folders& folders, const Choice& choice);

}  // namespace collision::repeat
