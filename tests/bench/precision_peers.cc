// The libraries over their tolerances, and the baselines.
#include <map>

#include "tests/bench/json.h"
#include "tests/bench/precision_query.h"

namespace collision::bench {
namespace {

/// What keeps those from being right that answer yes or no, and have no tolerance.
const char* LimitOf(const std::string& name) {
  static const std::map<std::string, const char*> limits = {
      {"FCL OBB", "plain doubles, without a bound of their error"},
      {"FCL OBBRSS", "plain doubles, without a bound of their error"},
      {"ODE OPCODE", "single precision within OPCODE"},
      {"CGAL", "nothing: exact predicates; the posed corners are rounded to doubles"},
      {"BSP trees", "plain doubles with a tolerance of 1e-12 of the size"}};
  const auto found = limits.find(name);
  return found == limits.end() ? "not stated" : found->second;
}

}  // namespace

std::string SettingText(const char* what, double value, const char* unit) {
  std::string text = Format("%g", value);
  if (what[0] != '\0') text = std::string(what) + " " + text;
  return unit[0] == '\0' ? text : text + " " + unit;
}

PrecisionMethods MeshPeers(const PlainMesh& mesh) {
  PrecisionMethods methods;
#ifdef COLLISION_HAS_FCL
  Append(FclMeshMethods(mesh), &methods);
#endif
#ifdef COLLISION_HAS_BULLET
  Append(BulletMeshMethods(mesh), &methods);
#endif
  for (NarrowQuery& query : PeerQueries(mesh)) {
    // GImpact stands there over its margins.
    if (query.task != Task::kDecision || query.contestant == "Bullet GImpact") continue;
    PrecisionMethod method;
    method.name = query.contestant, method.who = query.who;
    method.decides = true;
    method.limited_by = LimitOf(query.contestant);
    method.ask = std::move(query.ask);
    methods.push_back(std::move(method));
  }
  return methods;
}

}  // namespace collision::bench
