// Faulty surfaces, by the thousand.
#pragma once

#include <cstdint>

#include "tests/support/meshes.h"
#include "tests/support/random.h"

namespace collision {

/// Kinds of dirt; see DirtyMesh().
inline constexpr std::uint32_t kDirtKinds = 18;

namespace dirt {

inline Eigen::Vector3d Point(Random& random, double size) {
  return {random.Uniform(-size, size), random.Uniform(-size, size), random.Uniform(-size, size)};
}

/// Closed, with a corner at each point.
inline void AddTetrahedron(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                           const Eigen::Vector3d& c, const Eigen::Vector3d& d,
                           geometry::TriangleMesh* mesh) {
  const auto first = static_cast<std::uint32_t>(mesh->vertices.size());
  mesh->vertices.insert(mesh->vertices.end(), {a, b, c, d});
  const geometry::Triangle faces[] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  for (const geometry::Triangle& t : faces) {
    mesh->triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
}

inline void AddTriangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                        const Eigen::Vector3d& c, geometry::TriangleMesh* mesh) {
  const auto first = static_cast<std::uint32_t>(mesh->vertices.size());
  mesh->vertices.insert(mesh->vertices.end(), {a, b, c});
  mesh->triangles.push_back({first, first + 1, first + 2});
}

/// Triangles anywhere, of sizes from 1e-9 to 1.
inline geometry::TriangleMesh Soup(Random& random) {
  geometry::TriangleMesh mesh;
  for (std::uint64_t i = 1 + random.Below(150); i > 0; --i) {
    const Eigen::Vector3d a = Point(random, 1);
    const double size = random.LogUniform(1e-9, 1);
    AddTriangle(a, a + Point(random, size), a + Point(random, size), &mesh);
  }
  return mesh;
}

/// Needles, some with corners nearly or exactly on a line.
inline geometry::TriangleMesh Slivers(Random& random) {
  geometry::TriangleMesh mesh;
  for (std::uint64_t i = 1 + random.Below(80); i > 0; --i) {
    const Eigen::Vector3d a = Point(random, 1), b = Point(random, 1);
    const double off = random.Chance(0.1) ? 0 : random.LogUniform(1e-16, 1e-3);
    AddTriangle(a, b, a + random.Uniform(0, 1) * (b - a) + off * random.UnitVector(), &mesh);
  }
  return mesh;
}

/// All triangles in one corner, or along one edge.
inline geometry::TriangleMesh Fan(Random& random) {
  geometry::TriangleMesh mesh;
  const Eigen::Vector3d apex = Point(random, 1), other = Point(random, 1);
  const bool along_edge = random.Chance(0.5);
  for (std::uint64_t i = 1 + random.Below(120); i > 0; --i) {
    const Eigen::Vector3d p = Point(random, 1);
    AddTriangle(apex, along_edge ? other : Eigen::Vector3d(p + 0.1 * random.UnitVector()), p,
                &mesh);
  }
  return mesh;
}

/// The same triangles several times, some turned round.
inline geometry::TriangleMesh Repeated(Random& random) {
  geometry::TriangleMesh mesh = random.Chance(0.5) ? Cube(0.5) : Soup(random);
  const std::size_t once = mesh.triangles.size();
  for (std::uint64_t copies = 1 + random.Below(12); copies > 0; --copies) {
    for (std::size_t i = 0; i < once; ++i) {
      geometry::Triangle t = mesh.triangles[i];
      if (random.Chance(0.3)) std::swap(t[0], t[1]);
      mesh.triangles.push_back(t);
    }
  }
  return mesh;
}

/// Exactly flat, with triangles upon each other.
inline geometry::TriangleMesh Flat(Random& random) {
  geometry::TriangleMesh mesh = Soup(random);
  const int axis = static_cast<int>(random.Below(3));
  for (Eigen::Vector3d& p : mesh.vertices) p[axis] = 0.25;
  return mesh;
}

/// Closed, but some triangles are missing, turned round or corners of others.
inline geometry::TriangleMesh Damaged(Random& random) {
  geometry::TriangleMesh mesh = Star(2, random);
  for (geometry::Triangle& t : mesh.triangles) {
    if (random.Chance(0.05)) std::swap(t[0], t[1]);
    if (random.Chance(0.02)) t[0] = static_cast<std::uint32_t>(random.Below(mesh.vertices.size()));
  }
  while (random.Chance(0.7)) mesh.triangles.pop_back();
  return mesh;
}

/// One part a million times finer than the other.
inline geometry::TriangleMesh Uneven(Random& random) {
  const double size = random.LogUniform(1e-7, 1e-3);
  return Joined(Box({-1, -1, -1}, {1, 1, 1}),
                Moved(Scaled(Star(2, random), size), Point(random, 1)));
}

/// Needles from one corner in all directions, or in nearly one; or closed ones.
inline geometry::TriangleMesh NeedleFan(Random& random) {
  geometry::TriangleMesh mesh;
  const Eigen::Vector3d apex = Point(random, 1), along = random.UnitVector();
  const bool closed = random.Chance(0.5);
  const double spread = random.Chance(0.5) ? 2 : random.LogUniform(1e-9, 1e-2);
  for (std::uint64_t i = 1 + random.Below(closed ? 15 : 60); i > 0; --i) {
    const Eigen::Vector3d p = apex + along + Point(random, spread);
    const double width = random.LogUniform(1e-12, 1e-3);
    const Eigen::Vector3d q = p + width * random.UnitVector();
    if (closed) {
      AddTetrahedron(apex, p, q, p + width * random.UnitVector(), &mesh);
    } else {
      AddTriangle(apex, p, q, &mesh);
    }
  }
  return mesh;
}

/// Large triangles, or tetrahedra, most of which cross each other.
inline geometry::TriangleMesh Crossing(Random& random) {
  geometry::TriangleMesh mesh;
  const bool closed = random.Chance(0.5);
  for (std::uint64_t i = 1 + random.Below(closed ? 15 : 60); i > 0; --i) {
    const Eigen::Vector3d a = Point(random, 1), b = Point(random, 1), c = Point(random, 1);
    if (closed) {
      AddTetrahedron(a, b, c, Point(random, 1), &mesh);
    } else {
      AddTriangle(a, b, c, &mesh);
    }
  }
  return mesh;
}

/// Copies nearly upon each other.
inline geometry::TriangleMesh NearCopies(Random& random) {
  const geometry::TriangleMesh one = random.Chance(0.5) ? Cube(0.5) : Crossing(random);
  geometry::TriangleMesh mesh = one;
  while (mesh.triangles.size() + one.triangles.size() <= 60) {
    mesh = Joined(std::move(mesh), Moved(one, Point(random, random.LogUniform(1e-17, 1e-9))));
  }
  return mesh;
}

/// Triangles or boxes from 1 to 1e-9, the small ones near a corner of the large.
inline geometry::TriangleMesh Shrinking(Random& random) {
  geometry::TriangleMesh mesh;
  const bool closed = random.Chance(0.5);
  for (int i = 0; i < 10; ++i) {
    const double size = std::ldexp(1.0, -3 * i);
    if (closed) {
      mesh = Joined(std::move(mesh), Moved(Cube(size), Eigen::Vector3d::Constant(size)));
    } else {
      const Eigen::Vector3d a = Point(random, size);
      AddTriangle(a, a + Point(random, size), a + Point(random, size), &mesh);
    }
  }
  return mesh;
}

}  // namespace dirt

/// As meshes come: soup, slivers, fans, copies, flat ones, thin ones, uneven ones, ones that cross
/// themselves, nest, touch, fall apart; closed and open; near to the origin and far away. Without
/// degenerate triangles; not one that RefusalOf() refuses, if some triangle is left.
inline geometry::TriangleMesh DirtyMesh(std::uint32_t kind, Random& random) {
  const auto make = [&]() -> geometry::TriangleMesh {
    switch (kind % kDirtKinds) {
      case 0:
        return dirt::Soup(random);
      case 1:
        return dirt::Slivers(random);
      case 2:
        return dirt::Fan(random);
      case 3:
        return dirt::Repeated(random);
      case 4:
        return dirt::Flat(random);
      case 5:
        return dirt::Damaged(random);
      case 6:
        return dirt::Uneven(random);
      case 7:
        return Tangle(2, random);
      case 8:
        return Joined(Star(2, random), Moved(Star(2, random), dirt::Point(random, 1)));
      case 9:
        return Joined(Cube(1), Reversed(Cube(random.Chance(0.3) ? 1 : 0.5)));
      case 10:
        return Box({0, 0, 0}, {1, random.LogUniform(1e-9, 1), random.LogUniform(1e-9, 1)});
      case 11:
        return Subdivided(LShape(), 2);
      case 12:
        return Reversed(Star(2, random));
      case 13:
        return dirt::NeedleFan(random);
      case 14:
        return dirt::Crossing(random);
      case 15:
        return dirt::NearCopies(random);
      case 16:
        return dirt::Shrinking(random);
      default:
        return Joined(Sheet(1, 6), dirt::Soup(random));
    }
  };
  geometry::TriangleMesh mesh = make();
  if (random.Chance(0.3)) mesh = Scaled(mesh, random.LogUniform(1e-3, 1e3));
  if (random.Chance(0.3)) mesh = Moved(mesh, dirt::Point(random, random.LogUniform(1, 5e6)));
  DropDegenerate(&mesh);
  return mesh;
}

}  // namespace collision
