#include "client/programs/simulators/terrain/terrain.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "client/programs/simulators/motion/random.h"

namespace collision::client {
namespace {

constexpr int kOctaves = 4;
constexpr double kCellsAtFirst = 5;  ///< Of the coarsest noise, along an edge.
constexpr double kFloor = 0.25;      ///< Of the relief: so far the block reaches down.

/// Rate of the ground's clock [Hz]: that of the simulators that fly above it.
constexpr double kRate = 60;

/// In [0, 1], belongs to a point of the grid.
double Knot(std::uint64_t seed, int octave, std::int64_t i, std::int64_t j) {
  std::uint64_t key = seed * 0x9e3779b97f4a7c15 + static_cast<std::uint64_t>(octave);
  for (const std::int64_t coordinate : {i, j}) {
    key = SeededRandom(key ^ static_cast<std::uint64_t>(coordinate)).Next();
  }
  return SeededRandom(key).Uniform(0, 1);
}

/// 3 t² − 2 t³: flat at both ends.
double Eased(double t) { return t * t * (3 - 2 * t); }

double Noise(std::uint64_t seed, int octave, double x, double y) {
  const double i = std::floor(x), j = std::floor(y);
  const double u = Eased(x - i), v = Eased(y - j);
  const auto knot = [&](int di, int dj) {
    return Knot(seed, octave, static_cast<std::int64_t>(i) + di, static_cast<std::int64_t>(j) + dj);
  };
  return (1 - v) * ((1 - u) * knot(0, 0) + u * knot(1, 0)) +
         v * ((1 - u) * knot(0, 1) + u * knot(1, 1));
}

/// In [0, 1] over the unit square: wide valleys, few summits.
double Height(std::uint64_t seed, double x, double y) {
  double height = 0, weight = 0.5, cells = kCellsAtFirst, all = 0;
  for (int octave = 0; octave < kOctaves; ++octave) {
    height += weight * Noise(seed, octave, x * cells, y * cells);
    all += weight;
    weight /= 2;
    cells *= 2;
  }
  const double share = height / all;
  return share * share;
}

/// The grid's cells along an edge: 2 n² triangles above, 8 n in the walls, 4 n below.
std::uint32_t CellsFor(std::size_t triangles) {
  const double most = std::sqrt(9 + static_cast<double>(triangles) / 2) - 3;
  return static_cast<std::uint32_t>(std::max(1.0, std::floor(most)));
}

/// The grid's outermost points, anticlockwise from above.
std::vector<std::uint32_t> Rim(std::uint32_t n) {
  std::vector<std::uint32_t> rim;
  const std::uint32_t row = n + 1;
  for (std::uint32_t i = 0; i < n; ++i) rim.push_back(i);
  for (std::uint32_t j = 0; j < n; ++j) rim.push_back(j * row + n);
  for (std::uint32_t i = n; i > 0; --i) rim.push_back(n * row + i);
  for (std::uint32_t j = n; j > 0; --j) rim.push_back(j * row);
  return rim;
}

void AddHills(const TerrainOptions& options, std::uint32_t n, Triangles* mesh) {
  for (std::uint32_t j = 0; j <= n; ++j) {
    for (std::uint32_t i = 0; i <= n; ++i) {
      const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
      mesh->vertices_m.push_back({(x - 0.5) * options.size_m, (y - 0.5) * options.size_m,
                                  options.relief_m * Height(options.seed, x, y)});
    }
  }
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 2, d = a + n + 1;
      mesh->indices.push_back({a, b, c});
      mesh->indices.push_back({a, c, d});
    }
  }
}

/// Closes the surface, so that everything below the ground is inside.
void AddWallsAndFloor(const TerrainOptions& options, std::uint32_t n, Triangles* mesh) {
  const std::vector<std::uint32_t> rim = Rim(n);
  const double floor_m = -kFloor * options.relief_m;
  const auto first = static_cast<std::uint32_t>(mesh->vertices_m.size());
  for (const std::uint32_t above : rim) {
    const Vector3& p = mesh->vertices_m[above];
    mesh->vertices_m.push_back({p[0], p[1], floor_m});
  }
  const auto middle = static_cast<std::uint32_t>(mesh->vertices_m.size());
  mesh->vertices_m.push_back({0, 0, floor_m});
  for (std::uint32_t k = 0; k < rim.size(); ++k) {
    const auto next = static_cast<std::uint32_t>((k + 1) % rim.size());
    mesh->indices.push_back({rim[k], first + k, first + next});
    mesh->indices.push_back({rim[k], first + next, rim[next]});
    mesh->indices.push_back({middle, first + next, first + k});
  }
}

}  // namespace

Triangles TerrainMesh(const TerrainOptions& options) {
  const std::uint32_t n = CellsFor(options.triangles);
  Triangles mesh;
  AddHills(options, n, &mesh);
  AddWallsAndFloor(options, n, &mesh);
  return mesh;
}

void ServeTerrain(const TerrainOptions& options, Pace* pace, MotionLog* log) {
  AgentDescription description;
  description.name = options.name;
  description.shape = Shape::Make(TerrainMesh(options));
  description.acceleration_max_m_s2 = 0;
  description.angular_acceleration_max_rad_s2 = 0;
  State state;
  state.stamp_ns = pace->start_ns();
  state.position_m = {options.size_m / 2, options.size_m / 2, options.base_m};
  const Agent ground = pace->world().AddAgent(description, state);
  log->Agent(description.name, description.shape->radius_m(), description.shape);
  MotionPiece piece{pace->start_ns(), pace->start_ns(), {}};
  for (int axis = 0; axis < 3; ++axis) piece.coefficients[axis][0] = state.position_m[axis];
  pace->Fly(kRate, 1, [&](const PaceStep& step) {
    piece.t1_ns = step.t1_ns;
    return true;
  });
  if (piece.t1_ns > piece.t0_ns) log->Piece(description.name, piece);
  pace->Linger();
}

}  // namespace collision::client
