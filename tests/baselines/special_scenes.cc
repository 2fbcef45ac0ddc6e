#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "tests/baselines/scenes.h"
#include "tests/support/random.h"

namespace collision::baselines {
namespace {

Eigen::Vector3d InBox(Random& random, const Eigen::Vector3d& half) {
  const double x = random.Uniform(-1, 1), y = random.Uniform(-1, 1), z = random.Uniform(-1, 1);
  return Eigen::Vector3d(x, y, z).cwiseProduct(half);
}

Eigen::Vector3d InCube(Random& random, double half) {
  return InBox(random, Eigen::Vector3d::Constant(half));
}

/// Half the side of a cube in which each agent has `volume` for itself.
double HalfSide(std::uint32_t count, double volume) { return 0.5 * std::cbrt(count * volume); }

/// Crowds of a hundred, dense within and far from each other, drifting each its way.
BallScene Clustered(std::uint32_t count, Random& random) {
  const double half = HalfSide(count, 1000);
  BallScene scene;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(), drift = centre;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (i % 100 == 0) centre = InCube(random, half), drift = InCube(random, 10);
    scene.push_back({centre + InCube(random, 5), drift + InCube(random, 0.2), 0.2, 0.1, 0});
  }
  return scene;
}

/// Radii from 1 mm to 1 km, as many in each power of two as in the next.
BallScene MixedSizes(std::uint32_t count, Random& random) {
  BallScene scene;
  const double half = HalfSide(count, 6.4e9);
  for (std::uint32_t i = 0; i < count; ++i) {
    const double radius = random.LogUniform(1e-3, 1e3);
    scene.push_back({InCube(random, half), InCube(random, 20), radius, 0.5, 0});
  }
  // Both ends are there, whatever was drawn.
  scene.front().radius = 1e-3;
  scene.back().radius = 1e3;
  return scene;
}

/// M from 1e-3 to 1e3 m/s², most of it small.
BallScene MixedAcceleration(std::uint32_t count, Random& random) {
  BallScene scene;
  const double half = HalfSide(count, 1000);
  for (std::uint32_t i = 0; i < count; ++i) {
    const double m = std::min(1e3, 1e-2 / std::max(1e-5, random.Uniform(0, 1)));
    scene.push_back({InCube(random, half), InCube(random, 2), 0.2, m, 0});
  }
  return scene;
}

/// At rest on the points of a cubic lattice, all gaps equal: every neighbour may be met first, at
/// half the horizon.
BallScene Lattice(std::uint32_t count) {
  const auto side = static_cast<std::uint32_t>(std::ceil(std::cbrt(double(count))));
  BallScene scene;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Eigen::Vector3d p(i % side, i / side % side, i / side / side);
    scene.push_back({1.25 * p, Eigen::Vector3d::Zero(), 0.5, 1, 0});
  }
  return scene;
}

/// A tower of boxes a little apart, falling: neighbours above and below, and gravity's M.
BallScene FallingPile(std::uint32_t count, Random& random) {
  const auto side = static_cast<std::uint32_t>(std::ceil(std::cbrt(count / 4.0)));
  BallScene scene;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double x = i % side, y = i / side % side, z = i / side / side;
    const Eigen::Vector3d p(1.3 * x, 1.3 * y, 1.3 * z);
    scene.push_back({p + InCube(random, 0.05), {0, 0, -0.5 - 0.01 * z}, 0.5, 9.81, 0});
  }
  return scene;
}

/// A column ten wide and ten high that flies at 250 m/s, with slight differences.
BallScene Convoy(std::uint32_t count, Random& random) {
  BallScene scene;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Eigen::Vector3d p(5.0 * (i / 100), 5.0 * (i % 10), 5.0 * (i / 10 % 10));
    const Eigen::Vector3d v(250, 0, 0);
    scene.push_back({p + InCube(random, 1), v + InCube(random, 1), 1, 0.2, 0});
  }
  return scene;
}

/// A crowd within one cell of any grid that fits the rest: one agent far out on each side stretches
/// the region a million times beyond it.
BallScene OneCell(std::uint32_t count, Random& random) {
  BallScene scene;
  const double half = HalfSide(count, 100);
  for (std::uint32_t i = 0; i < count; ++i) {
    scene.push_back({InCube(random, half), InCube(random, 0.5), 0.5, 0.2, 0});
  }
  scene.front().p_WA.setConstant(-1e6 * half);
  scene.back().p_WA.setConstant(1e6 * half);
  return scene;
}

/// Everything stands still without M but one agent, which crosses the scene.
BallScene OneFast(std::uint32_t count, Random& random) {
  BallScene scene;
  const double half = HalfSide(count, 1000);
  for (std::uint32_t i = 0; i < count; ++i) {
    scene.push_back({InCube(random, half), Eigen::Vector3d::Zero(), 0.2, 0, 0});
  }
  scene.back() = {{-1.1 * half, 0, 0}, {2.2 * half, 0, 0}, 5, 1, 0};
  return scene;
}

/// No two overlap at the start: of two that would, the smaller is left out, of equal ones the
/// later.
BallScene Apart(const BallScene& scene) {
  std::vector<std::uint32_t> order(scene.size());
  std::iota(order.begin(), order.end(), 0);
  const auto lower = [&](std::uint32_t i) { return scene[i].p_WA.x() - scene[i].radius; };
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return lower(a) < lower(b); });
  std::vector<bool> out(scene.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const BallAgent& a = scene[order[i]];
    for (std::size_t k = i + 1; k < order.size(); ++k) {
      const BallAgent& b = scene[order[k]];
      if (lower(order[k]) > a.p_WA.x() + a.radius) break;
      const double reach = a.radius + b.radius;
      if ((a.p_WA - b.p_WA).squaredNorm() > reach * reach) continue;
      if (out[order[i]] || out[order[k]]) continue;
      const bool drop_a = a.radius != b.radius ? a.radius < b.radius : order[i] > order[k];
      out[drop_a ? order[i] : order[k]] = true;
    }
  }
  BallScene apart;
  for (std::size_t i = 0; i < scene.size(); ++i) {
    if (!out[i]) apart.push_back(scene[i]);
  }
  return apart;
}

BallScene Draw(const std::string& name, std::uint32_t count, Random& random) {
  if (name == "clustered") return Clustered(count, random);
  if (name == "mixed-sizes") return MixedSizes(count, random);
  if (name == "mixed-acceleration") return MixedAcceleration(count, random);
  if (name == "lattice") return Lattice(count);
  if (name == "falling-pile") return FallingPile(count, random);
  if (name == "convoy") return Convoy(count, random);
  if (name == "one-cell") return OneCell(count, random);
  if (name == "one-fast") return OneFast(count, random);
  throw std::invalid_argument("no such scene: " + name);
}

}  // namespace

std::vector<std::string> SceneNames() {
  return {"clustered",    "mixed-sizes", "mixed-acceleration", "lattice",
          "falling-pile", "convoy",      "one-cell",           "one-fast"};
}

BallScene MakeScene(const std::string& name, std::uint32_t count, std::uint64_t seed) {
  Random random(seed);
  return Apart(Draw(name, count, random));
}

}  // namespace collision::baselines
