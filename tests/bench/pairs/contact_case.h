// Two rigid bodies that move, and the exact time at which they begin to touch.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tests/bench/pairs/method.h"
#include "tests/bench/pairs/motion.h"

namespace collision::bench {

/// At the start of the step; velocity and angular velocity are constant.
struct MovingBody {
  using Triple = std::array<double, 3>;
  enum class Kind { kBall, kBox, kMesh };
  Kind kind = Kind::kBox;
  Triple half{};                          ///< Half extents of a box; for a ball all are its radius.
  std::shared_ptr<const PlainMesh> mesh;  ///< Of a mesh.
  std::array<double, 4> q{1, 0, 0, 0};    ///< w, x, y, z: body to world.
  Triple p{}, v{}, w{};                   ///< World frame; m, m/s, rad/s.

  static MovingBody Box(const Triple& half, const Triple& p = {}, const Triple& v = {});
  static MovingBody Ball(double radius, const Triple& p = {}, const Triple& v = {});

  /// After `seconds`: the state that a library is given for the end of a step.
  MovingBody After(double seconds) const;
};

struct ContactCase {
  std::string name;
  MovingBody a, b;
  double duration = 1;               ///< The step [s].
  bool both_ends = false;            ///< States are given at both ends of the step.
  std::optional<double> begin = {};  ///< The closed answer [s]; nullopt: they do not touch.
  bool touches_by_nothing = false;   ///< They touch but do not overlap: no method can be sure.
};

/// Closed answers: see the table of `./run bench narrow-phase`.
std::vector<ContactCase> ClosedContactCases();

/// Cases of one kind, in steps of 1 s. Their closed answers are rounded from long doubles, to
/// within `slack` [s].
struct ContactFamily {
  Motion motion;
  std::string name;
  std::vector<ContactCase> cases;
  std::vector<double> slack;
};

/// Seeded, `count` cases each: boxes, balls, balls at 10 km/s and plates that move; a bar that
/// turns into a ball, a cube that turns its edge into a plate; and grazing by 1e-3 to 1e-12 of the
/// size, on both sides: balls that pass, a cube that turns its edge past a ball.
std::vector<ContactFamily> ContactFamilies(std::size_t count);

}  // namespace collision::bench
