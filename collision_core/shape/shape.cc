#include "collision_core/shape/shape.h"

#include <algorithm>
#include <span>
#include <utility>

#include "collision_core/base/check.h"
#include "collision_core/shape/compound_builder.h"
#include "collision_core/shape/hull_builder.h"
#include "collision_core/sphere_tree/fitted/fitted_builder.h"
#include "collision_core/sphere_tree/median_split/median_split_builder.h"
#include "collision_core/sphere_tree/octree/octree_builder.h"
#include "collision_core/sphere_tree/surface_query.h"
#include "collision_core/sphere_tree/tree_check.h"

namespace collision::shape {
namespace {

/// Negative only where certain: inside a closed solid the ball of that radius meets no triangle.
double SignedDistanceAt(const sphere_tree::SphereNode& node, sphere_tree::SurfaceKind kind,
                        sphere_tree::SurfaceQuery* query) {
  // The node's ball contains some of the surface, so its radius bounds the distance.
  const numeric::Interval distance = query->DistanceTo(node.centre, node.radius);
  const bool is_inside = kind == sphere_tree::SurfaceKind::kClosed &&
                         query->WindingNumberAt(node.centre).value_or(0) != 0;
  return is_inside ? -distance.lower : distance.upper;
}

/// Number of balls of a quick tree that are measured: enough to recognise a deep contact.
constexpr std::size_t kHalvedMeasured = 1024;

/// The most nodes and triangles examined per ball, on average. Ordinary meshes need up to 240;
/// coincident copies are all equally far from every point, and without a limit all of them would be
/// measured for each ball.
constexpr std::size_t kWorkPerBall = 1024;

/// Measures the signed distances of the first `count` nodes while the work suffices; for other
/// nodes the radius stays.
void MeasureCentres(const geometry::TriangleMesh& mesh, sphere_tree::SurfaceKind kind,
                    std::size_t count, sphere_tree::SphereTree* tree) {
  sphere_tree::SurfaceQuery query(mesh, *tree);
  const auto nodes = std::span(tree->nodes).first(std::min(count, tree->nodes.size()));
  for (sphere_tree::SphereNode& node : nodes) {
    if (query.work() >= kWorkPerBall * nodes.size()) return;
    node.signed_distance = SignedDistanceAt(node, kind, &query);
  }
}

bool IsOfBody(const Shape& shape, const geometry::TriangleMesh& mesh, std::size_t solids) {
  return shape.mesh().vertices == mesh.vertices && shape.mesh().triangles == mesh.triangles &&
         shape.solids().size() == solids;
}

/// Walks a tree that a builder made. In release builds the tests do.
void WalkInDebugBuilds([[maybe_unused]] const sphere_tree::SphereTree& tree,
                       [[maybe_unused]] const sphere_tree::TreeElements& elements) {
#ifndef NDEBUG
  const auto refusal = RefusalOf(tree, elements);
  CORE_CHECK(!refusal, refusal->c_str(), elements.triangles, elements.solids);
#endif
}

/// Builds the tree, without its packed layout.
sphere_tree::SphereTree BuildTree(const geometry::TriangleMesh& mesh,
                                  const sphere_tree::ShapeOptions& options,
                                  sphere_tree::SurfaceKind kind) {
  if (options.builder == sphere_tree::TreeBuilder::kFitted) return BuildFitted(mesh, options, kind);
  const bool halved = options.builder == sphere_tree::TreeBuilder::kMedianSplit;
  sphere_tree::SphereTree tree =
      halved ? BuildMedianSplit(mesh, options) : BuildOctree(mesh, options);
  MeasureCentres(mesh, kind, halved ? kHalvedMeasured : tree.nodes.size(), &tree);
  return tree;
}

}  // namespace

std::shared_ptr<const Shape> Shape::Build(geometry::TriangleMesh mesh,
                                          const sphere_tree::ShapeOptions& options,
                                          const Shape* twin) {
  CORE_CHECK(geometry::IsWellFormed(mesh), "a surface has a well-formed mesh",
             mesh.triangles.size());
  CORE_CHECK(!twin || IsOfBody(*twin, mesh, 0), "a twin has the same surface, and no solid");
  std::shared_ptr<Shape> shape(new Shape());
  if (twin) shape->body_ = twin->body_;
  shape->facts_ = FactsOf(mesh);
  shape->tree_ = BuildTree(
      mesh, options,
      shape->closed() ? sphere_tree::SurfaceKind::kClosed : sphere_tree::SurfaceKind::kOpen);
  WalkInDebugBuilds(shape->tree_, {.triangles = mesh.triangles.size()});
  shape->component_points_ = ComponentPoints(mesh);
  shape->mesh_ = std::move(mesh);
  shape->packed_ = sphere_tree::PackedTree(shape->mesh_, shape->tree_);
  shape->hull_ = HullAround(shape->mesh_, {});
  return shape;
}

std::shared_ptr<const Shape> Shape::FromTree(geometry::TriangleMesh mesh,
                                             sphere_tree::SphereTree tree) {
  CORE_CHECK(geometry::IsWellFormed(mesh), "a surface has a well-formed mesh",
             mesh.triangles.size());
  CORE_CHECK(!RefusalOf(tree, mesh), "a tree has the structure of one of its mesh");
  std::shared_ptr<Shape> shape(new Shape());
  shape->facts_ = FactsOf(mesh);
  shape->tree_ = std::move(tree);
  shape->component_points_ = ComponentPoints(mesh);
  shape->mesh_ = std::move(mesh);
  shape->packed_ = sphere_tree::PackedTree(shape->mesh_, shape->tree_);
  shape->hull_ = HullAround(shape->mesh_, {});
  return shape;
}

std::shared_ptr<const Shape> Shape::Compound(std::shared_ptr<const Shape> surface,
                                             std::vector<ConvexSolid> solids, const Shape* twin) {
  CORE_CHECK(!solids.empty() && solids.size() <= kSolidsMax,
             "a compound has 1 to kSolidsMax solids", solids.size());
  CORE_CHECK(!surface || surface->solids().empty(), "the surface of a compound has no solids");
  std::shared_ptr<Shape> shape(new Shape());
  if (twin) shape->body_ = twin->body_;
  if (surface) {
    shape->facts_ = surface->facts();
    shape->component_points_ = surface->component_points();
  }
  AddSolids(solids, &shape->facts_);
  for (const ConvexSolid& solid : solids) {
    const geometry::ConvexSet& set = solid.set();
    shape->component_points_.push_back(set.centre + set.SupportPoint(Eigen::Vector3d::UnitX()));
  }
  const auto triangles = static_cast<std::uint32_t>(surface ? surface->mesh().triangles.size() : 0);
  shape->tree_ = BuildCompound(surface ? &surface->tree() : nullptr, triangles, solids);
  WalkInDebugBuilds(shape->tree_, {.triangles = triangles, .solids = solids.size()});
  shape->surface_ = std::move(surface);
  shape->solids_ = std::move(solids);
  CORE_CHECK(!twin || IsOfBody(*twin, shape->mesh(), shape->solids_.size()),
             "a twin has the same surface, and as many solids", shape->solids_.size());
  shape->packed_ = sphere_tree::PackedTree(shape->mesh(), shape->tree_);
  shape->hull_ = HullAround(shape->mesh(), shape->solids_);
  return shape;
}

numeric::Interval Shape::DistanceTo(const Eigen::Vector3d& point) const {
  if (surface_) return surface_->DistanceTo(point);
  if (mesh_.triangles.empty()) return {numeric::kInfinity, numeric::kInfinity};
  return sphere_tree::SurfaceQuery(mesh_, tree_).DistanceTo(point, numeric::kInfinity);
}

std::optional<int> Shape::WindingNumberAt(const Eigen::Vector3d& point) const {
  CORE_CHECK(closed(), "an open surface has no winding number");
  if (surface_) return surface_->WindingNumberAt(point);
  if (mesh_.triangles.empty()) return 0;
  const bool is_outside_box =
      (point.array() < facts_.lower.array()).any() || (point.array() > facts_.upper.array()).any();
  if (is_outside_box) return 0;
  return sphere_tree::SurfaceQuery(mesh_, tree_).WindingNumberAt(point);
}

std::size_t Shape::bytes() const {
  std::size_t bytes = surface_ ? surface_->bytes() : 0;
  for (const ConvexSolid& solid : solids_) bytes += solid.bytes();
  return bytes + sizeof *this + mesh_.vertices.capacity() * sizeof(Eigen::Vector3d) +
         mesh_.triangles.capacity() * sizeof(geometry::Triangle) + tree_.bytes() + packed_.bytes() +
         hull_.bytes() + component_points_.capacity() * sizeof(Eigen::Vector3d);
}

}  // namespace collision::shape
