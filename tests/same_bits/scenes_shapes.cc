// Meshes, convex solids and several together, that turn, under budgets large and small.
#include <limits>
#include <string>

#include "idl/shape_bytes.h"
#include "tests/same_bits/scene.h"
#include "tests/same_bits/turning.h"
#include "tests/support/meshes.h"

namespace collision::server {
namespace {

struct Body {
  std::string bytes;  ///< Empty: a ball.
  double radius = 0;
};

void AddMesh(const geometry::TriangleMesh& mesh, ShapeContent* content) {
  for (const auto& p : mesh.vertices) content->vertices.push_back({p.x(), p.y(), p.z()});
  content->triangles.insert(content->triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
}

Body MeshBody(const geometry::TriangleMesh& mesh, double radius) {
  ShapeContent content;
  AddMesh(mesh, &content);
  return {EncodeShape(content), radius};
}

std::vector<Body> Meshes() {
  return {{"", 0.5},
          MeshBody(LShape(), 2),
          MeshBody(Rod(1.2, 0.15), 1.3),
          MeshBody(Sheet(1, 12), 1.5),
          MeshBody(HollowCube(0.7, 0.4), 1.3)};
}

std::vector<Body> Solids() {
  const SolidContent ball{.kind = SolidKind::kBall, .position = {0.2, 0, 0}, .rounding = 0.6};
  const SolidContent capsule{
      .kind = SolidKind::kCapsule, .half_extents = {0, 0, 0.7}, .rounding = 0.25};
  const SolidContent box{.kind = SolidKind::kBox,
                         .orientation = {0.5, 0.5, 0.5, 0.5},
                         .half_extents = {0.3, 0.9, 0.5},
                         .rounding = 0.05};
  const SolidContent ellipsoid{.kind = SolidKind::kEllipsoid, .half_extents = {0.3, 0.6, 1}};
  SolidContent hull{.kind = SolidKind::kHull};
  Random random(31);
  for (int i = 0; i < 14; ++i) {
    const Eigen::Vector3d p = 0.9 * random.UnitVector();
    hull.points.push_back({p.x(), p.y(), p.z()});
  }
  std::vector<Body> bodies;
  for (const SolidContent& solid : {ball, capsule, box, ellipsoid, hull}) {
    bodies.push_back({EncodeShape({.vertices = {}, .triangles = {}, .solids = {solid}}), 1.3});
  }
  ShapeContent several{.vertices = {}, .triangles = {}, .solids = {capsule, box}};
  AddMesh(Moved(Tetrahedron(0.5), {0.8, 0, 0}), &several);
  bodies.push_back({EncodeShape(several), 2.2});
  return bodies;
}

/// Keeps turning; every other tells its orientation with an error.
SimulatedAgent Turner(const Body& body, std::int64_t end_ns, Random* random) {
  const WanderOptions options{.half_side = 4, .speed = 4, .acceleration_max = 2};
  SimulatedAgent agent{.radius = body.radius,
                       .acceleration_max = options.acceleration_max,
                       .motion = Wander(options, end_ns, random),
                       .shape_bytes = body.bytes};
  if (body.bytes.empty()) return agent;
  const double speed = random->Uniform(0, 3);
  const Eigen::Vector3d rate = speed * random->UnitVector();
  const bool exact = random->Chance(0.5);
  agent.declare = [exact](v1::AgentDescription* wire) {
    wire->set_angular_acceleration_max_rad_s2(exact ? 0 : 0.2);
  };
  agent.tell = [rate, exact](v1::AgentState* state) {
    const PlainQuaternion q = Turned(rate, state->stamp_ns());
    state->mutable_orientation()->set_w(q[0]);
    state->mutable_orientation()->set_x(q[1]);
    state->mutable_orientation()->set_y(q[2]);
    state->mutable_orientation()->set_z(q[3]);
    state->mutable_angular_velocity_rad_s()->set_x(rate.x());
    state->mutable_angular_velocity_rad_s()->set_y(rate.y());
    state->mutable_angular_velocity_rad_s()->set_z(rate.z());
    state->set_rotation_error_rad(exact ? 1e-9 : 0.01);
  };
  return agent;
}

struct Tuning {
  v1::Config::TreeBuilder builder = v1::Config::FITTED;
  double pair_us = 100;
  double step_us = 0;
};

Scene Turning(const std::string& name, std::vector<Body> (*bodies_of)(), const Tuning& tuning) {
  v1::Config config = ConfigFor(2);
  config.set_tree_builder(tuning.builder);
  config.set_time_budget_us(tuning.pair_us);
  config.set_step_budget_us(tuning.step_us);
  const auto fill = [bodies_of](Scenario* scenario) {
    constexpr std::int64_t kEnd = 4 * kSecond;
    const std::vector<Body> bodies = bodies_of();
    Random random(21);
    std::vector<SimulatedAgent> agents[2];
    for (int i = 0; i < 16; ++i) {
      agents[i % 2].push_back(Turner(bodies[i / 2 % bodies.size()], kEnd, &random));
    }
    scenario->Add({.name = "alpha", .sender = 1, .period_ns = 50'000'000, .end_ns = kEnd},
                  agents[0]);
    scenario->Add(
        {.name = "beta", .sender = 2, .period_ns = 125'000'000, .end_ns = kEnd, .chunk_size = 2},
        agents[1]);
  };
  return {.name = name, .config = config, .network = Lossy(3), .fill = fill};
}

}  // namespace

std::vector<Scene> ShapeScenes() {
  return {
      Turning("meshes", Meshes, {}),
      Turning("octrees", Meshes, {.builder = v1::Config::OCTREE}),
      Turning("solids", Solids, {}),
      Turning("small-budget", Meshes, {.pair_us = 8, .step_us = 40}),
  };
}

}  // namespace collision::server
