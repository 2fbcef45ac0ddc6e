// Two rigid bodies that move, and when they begin to touch.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tests/bench/narrow_query.h"

namespace collision::bench {

/// At the start of the step; velocity and turning are constant.
struct MovingBody {
  enum class Kind { kBall, kBox, kMesh };
  Kind kind = Kind::kBox;
  std::array<double, 3> half{};           ///< Half extents of a box; of a ball its radius, first.
  std::shared_ptr<const PlainMesh> mesh;  ///< Of a mesh.
  std::array<double, 4> q{1, 0, 0, 0};    ///< w, x, y, z: body to world.
  std::array<double, 3> p{}, v{}, w{};    ///< World frame; m, m/s, rad/s.

  /// After `seconds`: what a library is told of the end of a step.
  MovingBody After(double seconds) const;
};

struct ContactCase {
  std::string name;
  MovingBody a, b;
  double duration = 1;               ///< The step [s].
  bool both_ends = false;            ///< States are told at both ends of the step.
  std::optional<double> begin = {};  ///< The closed answer [s]; nullopt: they do not touch.
  bool touches_by_nothing = false;   ///< They touch, but do not overlap: nobody can be sure.
};

/// Closed answers: see the table of `./run bench narrow-phase`.
std::vector<ContactCase> ClosedContactCases();

/// When they begin to touch [s], as a library says; nullopt: not in this step.
using ContactTeller = std::function<std::optional<double>(const ContactCase&)>;
struct ContactLibrary {
  std::string name;
  ContactTeller tell;
  /// Takes meshes as well, and builds what it needs of one; null: it does not.
  std::function<void(std::shared_ptr<const PlainMesh>)> prepare = nullptr;
};
std::vector<ContactLibrary> FclContact();
std::vector<ContactLibrary> BulletContact();
std::vector<ContactLibrary> ContactPeers();

}  // namespace collision::bench
