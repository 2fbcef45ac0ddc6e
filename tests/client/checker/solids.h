// Bodies with few triangles for the checker's tests, written as motion logs are.
#pragma once

#include <cstdio>
#include <initializer_list>
#include <sstream>
#include <string>
#include <vector>

#include "client/checker/motion/true_contacts.h"

namespace collision::checker {

using Faces = std::vector<std::array<std::uint32_t, 3>>;

/// The twelve triangles of a box of these half extents about the reference point, outward.
inline Mesh BoxMesh(double x, double y, double z) {
  std::vector<Vector> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back({(i & 1) ? x : -x, (i & 2) ? y : -y, (i & 4) ? z : -z});
  const Faces faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                       {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return Mesh(corners, faces);
}

/// Corners at ±size, the even ones of a cube.
inline Mesh TetrahedronMesh(double s) {
  return Mesh({{s, s, s}, {s, -s, -s}, {-s, s, -s}, {-s, -s, s}},
              {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}});
}

/// A square in the plane z = 0: an open surface.
inline Mesh SquareMesh(double half) {
  return Mesh({{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}},
              {{0, 1, 2}, {0, 2, 3}});
}

/// One agent with one piece from 0 to `seconds`, at p + v t.
inline AgentMotion Moving(const std::string& name, const Mesh& mesh, const Vector& p,
                          const Vector& v, double seconds) {
  Piece piece{0, static_cast<std::int64_t>(seconds * 1e9), {}};
  piece.p_WA = {{{p.x, v.x}, {p.y, v.y}, {p.z, v.z}}};
  return {"s", name, mesh.radius_m(), {piece}, {}, std::make_shared<Mesh>(mesh)};
}

inline AgentMotion MovingBall(const std::string& name, double radius, const Vector& p,
                              const Vector& v, double seconds) {
  AgentMotion motion = Moving(name, SquareMesh(1), p, v, seconds);
  motion.mesh = nullptr;
  motion.radius_m = radius;
  return motion;
}

/// Turns all along at the constant rate w, from the world's axes.
inline AgentMotion Turning(AgentMotion motion, const Vector& w) {
  motion.pieces[0].turn = Turn{{1, 0, 0, 0}, {w.x, w.y, w.z}, {0, 0, 0}};
  return motion;
}

}  // namespace collision::checker
