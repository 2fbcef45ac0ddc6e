#include "collision_core/sphere_tree/fitted/fitted_builder.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "collision_core/base/check.h"
#include "collision_core/geometry/triangle/enclosing_ball.h"
#include "collision_core/numeric/allowances.h"
#include "collision_core/numeric/interval.h"
#include "collision_core/sphere_tree/fitted/fitted_cover.h"
#include "collision_core/sphere_tree/fitted/fitted_distance.h"

namespace collision::sphere_tree {
namespace {

using Eigen::Vector3d;

constexpr std::uint32_t kChildren = 8;

/// The first nodes get their eight balls by way of this many groups, where levels can be
/// spared: a cut of any size then finds nodes to divide that do not cost seven balls each.
constexpr std::size_t kGroups = 3;
constexpr std::size_t kGroupedNodes = 700;
constexpr std::uint32_t kGroupedSpare = 3;

/// The first nodes are also searched from so many starts: little work, as they are few.
constexpr std::size_t kCarefulNodes = 12;
constexpr std::uint32_t kCarefulStarts = 4;

/// A ball that overshoots by a smaller share of its part's width fits well enough for the children
/// as well: they keep the centre, and nothing is searched.
constexpr double kFits = 0.05;

/// Pieces with an edge longer than this share of their part's width are halved, unless the part has
/// no more pieces than so many leaves, or there are too many in all.
constexpr double kLargePiece = 0.35;
constexpr std::size_t kFewPieces = 4, kManyPieces = 64;
constexpr std::size_t kPiecesPerTriangle = 2, kPiecesMore = 1000;

/// Signed distances are rounded up by no more than these shares of the overshoot and of the part's
/// width: that leaves out most triangles about a centre that is nearly as far from many.
constexpr double kSlackOfOvershoot = 1.0 / 256, kSlackOfWidth = 1.0 / 4096;

/// Boxes and triangles looked at, for each triangle of the mesh, and so many more: beyond, nodes
/// are halved by place, with balls about their parts, and no distance is measured. Meshes as people
/// make them take up to 4,000; among thousands of needles that cross each other nothing is near to
/// one only.
constexpr std::uint64_t kWorkPerTriangle = 8192, kWorkMore = 1 << 20;

/// A node whose part is still to be divided.
struct Pending {
  std::uint32_t node = 0;
  std::size_t first = 0, count = 0;  ///< Its pieces, in its level's list.
  FittedBall ball;
  double width = 0;                  ///< The part's box has this diagonal.
  std::optional<FittedCover> cover;  ///< Of the part, if it is known already.
};

class Builder {
 public:
  Builder(const geometry::TriangleMesh& mesh, const ShapeOptions& options, SurfaceKind kind)
      : options_(options),
        boxes_(mesh),
        pieces_(mesh),
        pieces_max_(kPiecesPerTriangle * pieces_.size() + kPiecesMore),
        work_max_(kWorkPerTriangle * pieces_.size() + kWorkMore),
        search_(boxes_, pieces_, kind, options.triangles_per_leaf),
        distance_(boxes_, kind) {}

  SphereTree Build() {
    for (std::uint32_t i = 0; i < pieces_.size(); ++i) next_list_.push_back(i);
    AddNode(0, search_.FindOne(next_list_), 0, {});
    while (!next_.empty()) {
      std::swap(list_, next_list_);
      std::swap(pending_, next_);
      next_list_.clear();
      next_.clear();
      for (const Pending& pending : pending_) Process(pending);
      ++tree_.levels;
    }
    tree_.nodes.shrink_to_fit();
    tree_.elements.shrink_to_fit();
    return std::move(tree_);
  }

 private:
  /// With the pieces from `first` on of the next level's list. `parent`: facts of its centre.
  void AddNode(std::uint32_t level, const FittedBall& ball, std::size_t first,
               const CentreFacts& parent) {
    SphereNode node;
    node.centre = ball.centre;
    node.level = level;
    const Vector3d& any = pieces_.PointAt(pieces_[next_list_[first]].corners[0]);
    Vector3d lower = any, upper = any;
    for (std::size_t i = first; i < next_list_.size(); ++i) {
      for (const std::uint32_t corner : pieces_[next_list_[i]].corners) {
        const Vector3d& p = pieces_.PointAt(corner);
        lower = lower.cwiseMin(p);
        upper = upper.cwiseMax(p);
        node.radius = std::max(node.radius, RadiusTo(corner, node.centre));
      }
    }
    Pending pending{static_cast<std::uint32_t>(tree_.nodes.size()),
                    first,
                    next_list_.size() - first,
                    ball,
                    (upper - lower).norm(),
                    {}};
    pending.ball.radius = node.radius;
    facts_.push_back(node.centre == parent.centre && level > 0 ? parent : FactsOf(pending, parent));
    node.signed_distance = facts_.back().signed_distance;
    next_.push_back(std::move(pending));
    tree_.nodes.push_back(node);
  }

  CentreFacts FactsOf(const Pending& pending, const CentreFacts& parent) const {
    const FittedBall& ball = pending.ball;
    // The ball contains some of the surface.
    if (!HasWorkLeft()) return {ball.centre, ball.radius, false};
    const double slack =
        std::max(kSlackOfOvershoot * ball.overshoot(), kSlackOfWidth * pending.width);
    return distance_.Certify(ball.centre, slack, parent, ball.triangle);
  }

  bool HasWorkLeft() const { return boxes_.work() < work_max_; }

  /// Far enough for the exact corner. A computed |d|² is off by a relative 5 u at most, u = 2^−53,
  /// the root by 3.5 u: kFewRoundingsUp covers them. Squares below 1e-308 lose
  /// their error, distances are therefore raised by kDistanceUnderflow.
  double RadiusTo(std::uint32_t corner, const Vector3d& centre) const {
    const double d =
        (pieces_.PointAt(corner) - centre).norm() * numeric::kFewRoundingsUp + kDistanceUnderflow;
    return numeric::AddUp(d, pieces_.ErrorAt(corner));
  }

  void Process(const Pending& pending) {
    const auto part = std::span(list_).subspan(pending.first, pending.count);
    if (!MayBeDivided(pending, part)) return MakeLeaf(part, &tree_.nodes[pending.node]);
    part_.assign(part.begin(), part.end());
    tree_.nodes[pending.node].first_child = static_cast<std::uint32_t>(tree_.nodes.size());
    if (pending.cover) return AddChildren(pending, *pending.cover);
    const std::uint32_t spare = SpareLevels(pending);
    const bool fits = pending.ball.overshoot() <= kFits * pending.width;
    if (fits || spare == 0 || !HasWorkLeft()) {
      return Halve(pending, fits ? ChildBalls::kOfParent : ChildBalls::kOwn);
    }
    HalveLargePieces(pending.width);
    const FittedCover cover =
        search_.Find(part_, kChildren, tree_.nodes.size() < kCarefulNodes ? kCarefulStarts : 1);
    if (cover.balls.size() < 2) return Halve(pending, ChildBalls::kOwn);
    const bool is_early = tree_.nodes.size() < kGroupedNodes && spare > kGroupedSpare;
    if (is_early && cover.balls.size() > kGroups) return AddGroups(pending, cover);
    AddChildren(pending, cover);
  }

  bool MayBeDivided(const Pending& pending, std::span<const std::uint32_t> part) {
    if (part.size() <= options_.triangles_per_leaf) return false;
    if (tree_.nodes[pending.node].level >= options_.levels_max) return false;
    if (tree_.nodes.size() + kChildren > options_.nodes_max) return false;
    // Pieces of few triangles are few as well.
    return part.size() > kManyPieces * options_.triangles_per_leaf ||
           TrianglesOf(part).size() > options_.triangles_per_leaf;
  }

  /// Levels that are left over if every division from here on were in eight equal parts.
  std::uint32_t SpareLevels(const Pending& pending) const {
    std::uint32_t levels = options_.levels_max - tree_.nodes[pending.node].level;
    for (std::size_t size = options_.triangles_per_leaf; size < pending.count && levels > 0;
         --levels)
      size *= kChildren;
    return levels;
  }

  /// Pieces as wide as their part leave balls no choice.
  void HalveLargePieces(double width) {
    if (part_.size() <= kFewPieces * options_.triangles_per_leaf) return;
    const double most2 = kLargePiece * width * kLargePiece * width;
    for (std::size_t i = 0; i < part_.size(); ++i) {
      while (pieces_.size() < pieces_max_ && pieces_.LongestEdge2(part_[i]) > most2)
        part_.push_back(pieces_.Halve(part_[i]));
    }
  }

  void Add(const Pending& pending, const FittedBall& ball, std::size_t first) {
    ++tree_.nodes[pending.node].children;
    AddNode(tree_.nodes[pending.node].level + 1, ball, first, CentreFacts(facts_[pending.node]));
  }

  void AddChildren(const Pending& pending, const FittedCover& cover) {
    for (std::uint32_t k = 0; k < cover.balls.size(); ++k) {
      const std::size_t first = next_list_.size();
      for (std::size_t i = 0; i < part_.size(); ++i)
        if (cover.ball_of[i] == k) next_list_.push_back(part_[i]);
      Add(pending, cover.balls[k], first);
    }
  }

  void AddGroups(const Pending& pending, const FittedCover& cover) {
    for (const FittedGroup& group : search_.Merge(cover, kGroups)) {
      const std::size_t first = next_list_.size();
      FittedCover own;
      for (const std::uint32_t member : group.members) {
        for (std::size_t i = 0; i < part_.size(); ++i) {
          if (cover.ball_of[i] != member) continue;
          next_list_.push_back(part_[i]);
          own.ball_of.push_back(static_cast<std::uint32_t>(own.balls.size()));
        }
        own.balls.push_back(cover.balls[member]);
      }
      Add(pending, group.ball, first);
      if (own.balls.size() > 1) next_.back().cover = std::move(own);
    }
  }

  /// The balls of a node's children: the node's own, which fits well enough, or one for each.
  enum class ChildBalls { kOfParent, kOwn };

  /// Divides a part into equal parts by place, whatever balls that makes.
  void Halve(const Pending& pending, ChildBalls balls) {
    const std::size_t leaves =
        (part_.size() + options_.triangles_per_leaf - 1) / options_.triangles_per_leaf;
    HalveOrder(pending, balls, part_, std::min<std::size_t>(kChildren, leaves));
  }

  FittedBall BallFor(std::span<const std::uint32_t> part, const FittedBall& start) {
    if (HasWorkLeft()) return search_.FitTo(part, start);
    corners_.clear();
    for (const std::uint32_t piece : part) {
      for (const std::uint32_t corner : pieces_[piece].corners)
        corners_.push_back(pieces_.PointAt(corner));
    }
    FittedBall ball;
    ball.centre = geometry::SmallBallAround(corners_).centre;
    return ball;
  }

  Vector3d MiddleOf(std::uint32_t piece) const {
    const auto& [a, b, c] = pieces_[piece].corners;
    return pieces_.PointAt(a) + pieces_.PointAt(b) + pieces_.PointAt(c);
  }

  void HalveOrder(const Pending& pending, ChildBalls balls, std::span<std::uint32_t> order,
                  std::size_t children) {
    if (children == 1) {
      const std::size_t first = next_list_.size();
      next_list_.insert(next_list_.end(), order.begin(), order.end());
      const bool own = balls == ChildBalls::kOwn;
      return Add(pending, own ? BallFor(order, pending.ball) : pending.ball, first);
    }
    Vector3d lower = MiddleOf(order[0]), upper = lower;
    for (const std::uint32_t piece : order) {
      lower = lower.cwiseMin(MiddleOf(piece));
      upper = upper.cwiseMax(MiddleOf(piece));
    }
    int axis;
    (upper - lower).maxCoeff(&axis);
    const std::size_t half = order.size() * (children / 2) / children;
    std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(half), order.end(),
                     [&](std::uint32_t i, std::uint32_t j) {
                       const double x = MiddleOf(i)[axis], y = MiddleOf(j)[axis];
                       return x != y ? x < y : i < j;
                     });
    HalveOrder(pending, balls, order.first(half), children / 2);
    HalveOrder(pending, balls, order.subspan(half), children - children / 2);
  }

  /// Each once, in ascending order.
  std::span<const ElementIndex> TrianglesOf(std::span<const std::uint32_t> part) {
    triangles_.clear();
    for (const std::uint32_t piece : part) triangles_.push_back(pieces_[piece].triangle);
    std::sort(triangles_.begin(), triangles_.end());
    triangles_.erase(std::unique(triangles_.begin(), triangles_.end()), triangles_.end());
    return triangles_;
  }

  void MakeLeaf(std::span<const std::uint32_t> part, SphereNode* node) {
    const auto triangles = TrianglesOf(part);
    node->first_element = static_cast<std::uint32_t>(tree_.elements.size());
    node->elements = static_cast<std::uint32_t>(triangles.size());
    tree_.elements.insert(tree_.elements.end(), triangles.begin(), triangles.end());
  }

  const ShapeOptions& options_;
  const TriangleBoxTree boxes_;
  FittedPieces pieces_;
  const std::size_t pieces_max_;
  const std::uint64_t work_max_;
  CoverSearch search_;
  const FittedDistance distance_;
  SphereTree tree_;
  std::vector<CentreFacts> facts_;               ///< Of each node.
  std::vector<std::uint32_t> list_, next_list_;  ///< Pieces of the level at work, and of the next.
  std::vector<Pending> pending_, next_;
  std::vector<std::uint32_t> part_;      ///< At work.
  std::vector<ElementIndex> triangles_;  ///< Likewise.
  std::vector<Vector3d> corners_;
};

}  // namespace

SphereTree BuildFitted(const geometry::TriangleMesh& mesh, const ShapeOptions& options,
                       SurfaceKind kind) {
  CORE_CHECK(geometry::IsWellFormed(mesh), "a tree is built of a well-formed mesh",
             mesh.triangles.size());
  return Builder(mesh, options, kind).Build();
}

}  // namespace collision::sphere_tree
