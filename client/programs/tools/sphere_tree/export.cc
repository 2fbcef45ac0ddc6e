#include "client/programs/tools/sphere_tree/export.h"

#include <cmath>
#include <cstdio>
#include <map>
#include <utility>

#include "client/programs/tools/collisionctl/json/message_json.h"
#include "idl/tree_message.h"

namespace collision::client {
namespace {

/// With more balls each is a plain icosahedron, so that viewers can load the file.
constexpr std::size_t kRoundBallsMax = 2000;

/// An icosahedron in the unit ball.
geometry::TriangleMesh Icosahedron() {
  const double a = std::sqrt((5 - std::sqrt(5.0)) / 10), b = std::sqrt((5 + std::sqrt(5.0)) / 10);
  geometry::TriangleMesh mesh;
  mesh.vertices = {{-a, b, 0},  {a, b, 0},  {-a, -b, 0}, {a, -b, 0}, {0, -a, b},  {0, a, b},
                   {0, -a, -b}, {0, a, -b}, {b, 0, -a},  {b, 0, a},  {-b, 0, -a}, {-b, 0, a}};
  mesh.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                    {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                    {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                    {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  return mesh;
}

/// Divides each triangle in four and moves the new corners out to the unit ball.
geometry::TriangleMesh Divided(geometry::TriangleMesh mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto next = static_cast<std::uint32_t>(mesh.vertices.size());
    const auto [found, is_new] = middles.try_emplace(std::minmax(a, b), next);
    if (is_new) {
      mesh.vertices.emplace_back((mesh.vertices[a] + mesh.vertices[b]).normalized());
    }
    return found->second;
  };
  std::vector<geometry::Triangle> triangles;
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    triangles.insert(triangles.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  mesh.triangles = std::move(triangles);
  return mesh;
}

}  // namespace

std::string LevelObj(const MeshTree& mesh_tree, std::uint32_t level) {
  const std::vector<NodeIndex> cut = mesh_tree.tree().Cut(level);
  geometry::TriangleMesh unit = Icosahedron();
  if (cut.size() <= kRoundBallsMax) unit = Divided(std::move(unit));
  std::string text = "# level " + std::to_string(level) + " of the " +
                     BuilderName(mesh_tree.options.builder) + " tree of " + mesh_tree.file +
                     ", in metres\n";
  char line[128];
  std::size_t before = 1;  // OBJ counts from 1, through all objects.
  for (const NodeIndex index : cut) {
    const sphere_tree::SphereNode& node = mesh_tree.tree().node(index);
    text += "o ball_" + std::to_string(index.value()) + "\n";
    for (const Eigen::Vector3d& direction : unit.vertices) {
      const Eigen::Vector3d p = node.centre + node.radius * direction;
      std::snprintf(line, sizeof line, "v %.9g %.9g %.9g\n", p.x(), p.y(), p.z());
      text += line;
    }
    for (const auto& [a, b, c] : unit.triangles) {
      std::snprintf(line, sizeof line, "f %zu %zu %zu\n", before + a, before + b, before + c);
      text += line;
    }
    before += unit.vertices.size();
  }
  return text;
}

std::string LevelJson(const MeshTree& mesh_tree, std::uint32_t level) {
  v1::TreeLevel message;
  message.set_file(mesh_tree.file);
  message.set_builder(BuilderName(mesh_tree.options.builder));
  message.set_level(level);
  for (const NodeIndex index : mesh_tree.tree().Cut(level)) {
    const sphere_tree::SphereNode& node = mesh_tree.tree().node(index);
    v1::TreeBall* ball = message.add_balls();
    ball->set_node(index.value());
    ball->set_x_m(node.centre.x());
    ball->set_y_m(node.centre.y());
    ball->set_z_m(node.centre.z());
    ball->set_radius_m(node.radius);
    ball->set_signed_distance_m(node.signed_distance);
  }
  return MessageJson(message) + "\n";
}

std::string TreeBinary(const MeshTree& mesh_tree) {
  return ToMessage(mesh_tree.tree()).SerializeAsString();
}

}  // namespace collision::client
