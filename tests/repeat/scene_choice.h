// Which scenes are flown under which conditions, and how long.
#pragma once

#include <string>
#include <vector>

#include "client/programs/scene_runner/scene_file.h"
#include "tests/repeat/condition.h"

namespace collision::repeat {

struct Choice {
  bool quick = false;        ///< Two scenes, a few seconds of each.
  std::string only;          ///< Part of SCENE/CONDITION.
  double part_seconds = 20;  ///< Of flights that keep to real time; if quick, of all.
};

/// Flights that are to have the same event log: of one scene, equally long.
struct Series {
  std::string scene;
  double seconds = 0;  ///< Simulated.
  Condition condition;

  std::string name() const { return scene + "/" + condition.name; }
};

struct Chosen {
  std::vector<Series> series;         ///< Scene by scene.
  std::vector<std::string> left_out;  ///< "NAME: why".
};

/// Why the events of a scene need not be the same every time; empty: they are.
std::string WhyNotRepeatable(const v1::Scene& scene);

/// A scene that is longer than the part flies this part at full speed as well: only flights of one
/// length can have the same event log.
std::vector<Series> SeriesOf(const std::string& name, double scene_seconds, const Choice& choice,
                             const std::vector<Condition>& conditions);

/// From all scenes of the folder.
Chosen Choose(const client::Folders& folders, const Choice& choice);

}  // namespace collision::repeat
