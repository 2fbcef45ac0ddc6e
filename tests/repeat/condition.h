// Under what conditions a scene is flown.
#pragma once

#include <string>
#include <vector>

namespace collision::repeat {

struct Condition {
  std::string name;
  std::string text;
  bool paced = false;            ///< Simulators keep to the clock, in lock-step all the same.
  bool starves_service = false;  ///< Low priority beside busy loops, stopped again and again.
  bool starves_simulators = false;
  bool slow_network = false;  ///< Between simulators and service; needs root.

  bool starves() const { return starves_service || starves_simulators; }
};

/// The first one is undisturbed.
const std::vector<Condition>& AllConditions();

}  // namespace collision::repeat
