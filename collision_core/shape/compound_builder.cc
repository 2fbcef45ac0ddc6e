#include "collision_core/shape/compound_builder.h"

#include <algorithm>
#include <vector>

#include "collision_core/base/check.h"
#include "collision_core/numeric/allowances.h"
#include "collision_core/numeric/rounding.h"

namespace collision::shape {
namespace {

using Eigen::Vector3d;

/// Siblings, as the packs of a traversal hold them.
constexpr std::size_t kGathered = 8;

/// Relative to the sizes of a point and a solid: a distance is made of differences (two roundings
/// in three coordinates) and sums, below 8 · 2^-53 of them.
constexpr double kDistanceRounding = 0x1p-50;

/// Relative to the coordinates' magnitudes: each of their differences is off by 2^-53 of them;
/// twice that.
constexpr double kDifferenceRounding = 0x1p-52;

/// A root of a sum of three squares is off by 2.5 · 2^-53 of itself, but for underflow; the
/// differences before it by 2^-53 of what they are made of: that is counted where they are made.
double LengthUp(const Vector3d& v) {
  return numeric::kFewRoundingsUp * v.norm() + geometry::kSupportUnderflow;
}

/// A node of the tree to be built, with the parts below it if it is a gathering.
struct Part {
  sphere_tree::SphereNode node;
  enum class Kind { kGathering, kSolid, kSurface } kind = Kind::kGathering;
  ElementIndex solid = {};
  std::vector<Part> children = {};
};

/// An upper bound of the signed distance of a point to a solid, from the ball that is known to lie
/// in it: a point d away from that ball's centre is at most d − inradius from the solid, and where
/// this is negative, the ball of radius inradius − d about the point lies in the solid. For a solid
/// without such a ball it is the distance to a support point of the core, plus its `error` and the
/// rounding of a support.
double DistanceUp(const Vector3d& point, const ConvexSolid& solid) {
  const ConvexFacts& facts = solid.facts();
  const double lost = kDistanceRounding * (point.cwiseAbs().sum() + facts.radius);
  if (facts.inradius > 0) {
    return numeric::AddUp(numeric::AddUp(LengthUp(point - facts.inner_point), lost),
                          -facts.inradius);
  }
  const geometry::ConvexSet& set = solid.set();
  const Vector3d seen = point - set.centre;
  const double off =
      numeric::AddUp(set.error, numeric::MultiplyUp(geometry::kSupportError, set.span));
  return numeric::AddUp(numeric::AddUp(LengthUp(seen - set.SupportPoint(seen)), lost), off);
}

sphere_tree::SphereNode NodeOf(const ConvexSolid& solid) {
  sphere_tree::SphereNode node;
  node.centre = solid.facts().ball_centre;
  node.radius = solid.facts().ball_radius;
  node.signed_distance = DistanceUp(node.centre, solid);
  return node;
}

/// The distance of two centres, rounded up.
double BetweenUp(const sphere_tree::SphereNode& a, const sphere_tree::SphereNode& b) {
  const double lost = kDifferenceRounding * (a.centre.cwiseAbs().sum() + b.centre.cwiseAbs().sum());
  return numeric::AddUp(LengthUp(a.centre - b.centre), lost);
}

/// Fits a ball around the balls of the children: from the middle of their box in steps towards the
/// farthest ball.
void Enclose(Part* parent) {
  Vector3d lower = Vector3d::Constant(numeric::kInfinity), upper = -lower;
  for (const Part& part : parent->children) {
    const sphere_tree::SphereNode& node = part.node;
    lower = lower.cwiseMin((node.centre.array() - node.radius).matrix());
    upper = upper.cwiseMax((node.centre.array() + node.radius).matrix());
  }
  const sphere_tree::SphereNode* farthest = nullptr;
  const auto measure = [&](sphere_tree::SphereNode* node) {
    node->radius = 0;
    for (const Part& part : parent->children) {
      const double far = numeric::AddUp(BetweenUp(*node, part.node), part.node.radius);
      if (far > node->radius) node->radius = far, farthest = &part.node;
    }
  };
  sphere_tree::SphereNode node;
  node.centre = 0.5 * lower + 0.5 * upper;
  measure(&node);
  parent->node = node;
  constexpr int kSteps = 32;
  for (int step = 1; step <= kSteps; ++step) {
    const Vector3d to = farthest->centre - node.centre;
    const double length = to.norm();
    if (!(length > 0)) break;
    const Vector3d goal = farthest->centre + to * (farthest->radius / length);
    node.centre += (goal - node.centre) / (step + 2);
    measure(&node);
    if (node.radius < parent->node.radius) parent->node = node;
  }
  // A point near to a child is as near to the whole.
  parent->node.signed_distance = numeric::kInfinity;
  for (const Part& part : parent->children) {
    const double distance =
        numeric::AddUp(BetweenUp(parent->node, part.node), part.node.signed_distance);
    parent->node.signed_distance = std::min(parent->node.signed_distance, distance);
  }
}

/// Halves the parts along the axis in which their centres spread the widest; ties by their order.
std::size_t Halve(std::span<Part> parts) {
  Vector3d lower = parts[0].node.centre, upper = lower;
  for (const Part& part : parts) {
    lower = lower.cwiseMin(part.node.centre), upper = upper.cwiseMax(part.node.centre);
  }
  Eigen::Index axis = 0;
  (upper - lower).maxCoeff(&axis);
  std::stable_sort(parts.begin(), parts.end(), [axis](const Part& a, const Part& b) {
    return a.node.centre[axis] < b.node.centre[axis];
  });
  return parts.size() / 2;
}

/// Makes up to eight groups of near parts, halving the largest group first.
std::vector<std::span<Part>> Grouped(std::span<Part> parts) {
  std::vector<std::span<Part>> groups = {parts};
  while (groups.size() < kGathered) {
    const auto largest =
        std::max_element(groups.begin(), groups.end(),
                         [](const auto& a, const auto& b) { return a.size() < b.size(); });
    if (largest->size() == 1) break;
    const std::size_t half = Halve(*largest);
    const std::span<Part> second = largest->subspan(half);
    *largest = largest->first(half);
    groups.insert(largest + 1, second);
  }
  return groups;
}

Part Gathered(std::span<Part> parts) {
  if (parts.size() == 1) return std::move(parts[0]);
  Part parent;
  for (const std::span<Part> group : Grouped(parts)) parent.children.push_back(Gathered(group));
  Enclose(&parent);
  return parent;
}

/// Level by level: gatherings and solids from the parts, the surface's nodes from its own tree.
class Flattening {
 public:
  explicit Flattening(const sphere_tree::SphereTree* surface) : surface_(surface) {
    if (surface_) tree_.elements = surface_->elements;
  }

  sphere_tree::SphereTree Run(const Part& root) {
    std::vector<Place> level = {{&root, sphere_tree::SphereTree::kRoot}};
    for (std::uint32_t depth = 0; !level.empty(); ++depth) {
      tree_.levels = depth + 1;
      const auto next = static_cast<std::uint32_t>(tree_.nodes.size() + level.size());
      std::vector<Place> below;
      for (const Place& place : level) {
        sphere_tree::SphereNode node =
            place.part ? place.part->node : surface_->node(place.of_surface);
        node.level = depth;
        node.first_child = next + static_cast<std::uint32_t>(below.size());
        const std::size_t before = below.size();
        AddChildren(place, &below);
        node.children = static_cast<std::uint32_t>(below.size() - before);
        if (node.children == 0) node.first_child = 0;
        if (place.part && place.part->kind == Part::Kind::kSolid)
          AddSolid(place.part->solid, &node);
        tree_.nodes.push_back(node);
      }
      level = std::move(below);
    }
    return std::move(tree_);
  }

 private:
  struct Place {
    const Part* part;  ///< Null: a node of the surface.
    NodeIndex of_surface;
  };

  void AddChildren(const Place& place, std::vector<Place>* below) const {
    if (place.part && place.part->kind != Part::Kind::kSurface) {
      for (const Part& child : place.part->children) below->push_back({&child, {}});
      return;
    }
    const sphere_tree::SphereNode& own = surface_->node(place.of_surface);
    for (std::uint32_t i = 0; i < own.children; ++i) below->push_back({nullptr, own.child(i)});
  }

  void AddSolid(ElementIndex solid, sphere_tree::SphereNode* leaf) {
    leaf->first_element = static_cast<std::uint32_t>(tree_.elements.size());
    leaf->elements = 1;
    tree_.elements.push_back(solid);
  }

  const sphere_tree::SphereTree* const surface_;
  sphere_tree::SphereTree tree_;
};

}  // namespace

sphere_tree::SphereTree BuildCompound(const sphere_tree::SphereTree* surface,
                                      std::uint32_t triangles,
                                      std::span<const ConvexSolid> solids) {
  CORE_CHECK(!solids.empty(), "a compound has a solid");
  std::vector<Part> parts;
  if (surface) parts.push_back({surface->root(), Part::Kind::kSurface});
  for (std::size_t i = 0; i < solids.size(); ++i) {
    parts.push_back({NodeOf(solids[i]), Part::Kind::kSolid, ElementIndex(triangles + i)});
  }
  return Flattening(surface).Run(Gathered(parts));
}

void AddSolids(std::span<const ConvexSolid> solids, geometry::MeshFacts* facts) {
  if (facts->components == 0) {
    facts->closed = true;
    facts->lower = Vector3d::Constant(numeric::kInfinity), facts->upper = -facts->lower;
  }
  facts->components += solids.size();
  for (const ConvexSolid& solid : solids) {
    facts->lower = facts->lower.cwiseMin(solid.facts().lower);
    facts->upper = facts->upper.cwiseMax(solid.facts().upper);
    facts->radius = std::max(facts->radius, solid.facts().radius);
  }
}

}  // namespace collision::shape
