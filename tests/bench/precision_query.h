// Who answers how far apart two bodies are, in what setting, and what keeps the answer from being
// better.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/bench/narrow_query.h"

namespace collision::bench {

/// One point of a curve: a method at one of its settings.
struct PrecisionMethod {
  std::string name;
  std::string setting;  ///< As text, with its unit; empty: it has none.
  Who who = Who::kLibrary;
  bool certified = false;  ///< Both ends of its answers are proven.
  bool decides = false;    ///< Yes (1), no (0) or neither ([0, 1]); no distance.
  std::string limited_by;
  std::function<Reply(const PlainPose&)> ask;
  /// Of methods that share one budget among all poses: instead of `ask`.
  std::function<std::vector<Reply>(const std::vector<PlainPose>&)> ask_all = nullptr;
};
using PrecisionMethods = std::vector<PrecisionMethod>;

inline void Append(PrecisionMethods some, PrecisionMethods* all) {
  for (PrecisionMethod& method : some) all->push_back(std::move(method));
}

/// "1e-06 m"
std::string SettingText(const char* what, double value, const char* unit);

/// Those that were found when this was built, over their tolerances; and the baselines.
PrecisionMethods MeshPeers(const PlainMesh& mesh);
PrecisionMethods FclMeshMethods(const PlainMesh& mesh);
PrecisionMethods BulletMeshMethods(const PlainMesh& mesh);

}  // namespace collision::bench
