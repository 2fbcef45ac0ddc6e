#include "collision_core/sphere_tree/octree/octree_builder.h"

#include <algorithm>
#include <array>
#include <span>

#include "collision_core/base/check.h"
#include "collision_core/geometry/triangle/enclosing_ball.h"
#include "collision_core/numeric/allowances.h"
#include "collision_core/numeric/interval.h"

namespace collision::sphere_tree {
namespace {

using Eigen::Vector3d;

/// What one cut adds to the error of a piece's corners, in units of 2^−53 times the largest
/// coordinate S of the mesh.
///
/// An edge ab is cut at t = fl(fl(c − a_x) / fl(b_x − a_x)), in [0, 1] since rounding is monotone
/// and c lies between. The corner *is* a + t (b − a), exactly: a point of the edge, so that the two
/// pieces unite to the whole whatever t is. What is stored, with u = 2^−53 and |b − a| <= 2 S:
///   across the cut   c, but exactly it is a_x + t (b_x − a_x): off by 3.01 u · 2 S = 6.02 u S;
///   along it         fl(a_y + fl(t fl(b_y − a_y))): off by 2.01 u · 2 S + 1.01 u S = 5.03 u S.
/// That is √(6.02² + 2 · 5.03²) u S < 9.4 u S, if a and b are as stored; where they are off by e
/// themselves, the corner, between them, is off by e more at most. An underflow of t moves the
/// corner by 2^−1074 S, nothing against 0.6 u S. So after n cuts one after the other, 10 n u S.
constexpr double kCutError = 10;

/// An octant's faces cut each triangle three times a level.
constexpr int kCutsPerLevel = 3;

struct Piece {
  std::uint32_t triangle = 0;
  std::uint32_t corners = 0;
};

/// Pieces of triangles: corners one after the other, convex but for rounding. Their part of the
/// surface is the convex hull of each piece's exact corners.
struct Pieces {
  std::vector<Vector3d> corners;
  std::vector<Piece> list;

  void Clear() {
    corners.clear();
    list.clear();
  }
  void Append(std::uint32_t triangle, std::span<const Vector3d> polygon) {
    corners.insert(corners.end(), polygon.begin(), polygon.end());
    list.push_back({triangle, static_cast<std::uint32_t>(polygon.size())});
  }
  void Append(const Pieces& other) {
    corners.insert(corners.end(), other.corners.begin(), other.corners.end());
    list.insert(list.end(), other.list.begin(), other.list.end());
  }
};

struct Octant {
  Vector3d lower, upper;
  std::uint32_t depth = 0;  ///< How often the root's was halved.
};

/// Where an edge meets the plane. Kept between the edge's ends, where the exact corner is, too.
Vector3d CornerOnPlane(const Vector3d& a, const Vector3d& b, int axis, double plane) {
  const double t = (plane - a[axis]) / (b[axis] - a[axis]);
  const Vector3d corner = (a + t * (b - a)).cwiseMax(a.cwiseMin(b)).cwiseMin(a.cwiseMax(b));
  Vector3d result = corner;
  result[axis] = plane;
  return result;
}

/// Cuts pieces by planes, with buffers that are kept.
class Cutter {
 public:
  /// Each piece goes below the plane, above it, or is cut in two. A corner on the plane belongs to
  /// both sides, but a piece that only touches the plane stays whole. The hulls of the two pieces
  /// unite to the hull of the whole: their common corners lie on its boundary, and every other
  /// corner stands on one side of a chord between two common ones next to each other.
  void Cut(const Pieces& pieces, int axis, double plane, Pieces* below, Pieces* above) {
    below->Clear();
    above->Clear();
    const Vector3d* first = pieces.corners.data();
    for (const Piece& piece : pieces.list) {
      const std::span polygon(first, piece.corners);
      first += piece.corners;
      const auto is_below = [&](const Vector3d& p) { return p[axis] < plane; };
      const auto is_above = [&](const Vector3d& p) { return p[axis] > plane; };
      if (std::none_of(polygon.begin(), polygon.end(), is_above)) {
        below->Append(piece.triangle, polygon);
      } else if (std::none_of(polygon.begin(), polygon.end(), is_below)) {
        above->Append(piece.triangle, polygon);
      } else {
        CutOne(polygon, axis, plane);
        below->Append(piece.triangle, below_);
        above->Append(piece.triangle, above_);
      }
    }
  }

 private:
  void CutOne(std::span<const Vector3d> polygon, int axis, double plane) {
    below_.clear();
    above_.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vector3d& a = polygon[i];
      const Vector3d& b = polygon[i + 1 == polygon.size() ? 0 : i + 1];
      if (a[axis] <= plane) below_.push_back(a);
      if (a[axis] >= plane) above_.push_back(a);
      const bool crosses =
          (a[axis] < plane && b[axis] > plane) || (a[axis] > plane && b[axis] < plane);
      if (!crosses) continue;
      below_.push_back(CornerOnPlane(a, b, axis, plane));
      above_.push_back(below_.back());
    }
  }

  std::vector<Vector3d> below_, above_;
};

Octant ChildOf(const Octant& octant, const Vector3d& middle, int child) {
  Octant result{octant.lower, octant.upper, octant.depth + 1};
  for (int axis = 0; axis < 3; ++axis)
    (child >> axis & 1 ? result.lower : result.upper)[axis] = middle[axis];
  return result;
}

Vector3d MiddleOf(const Octant& octant) {
  return octant.lower + 0.5 * (octant.upper - octant.lower);
}

geometry::EnclosingBall CircumscribedBall(const Octant& octant) {
  const Vector3d middle = MiddleOf(octant);
  Vector3d half;
  for (int axis = 0; axis < 3; ++axis) {
    half[axis] = std::max(numeric::AddUp(middle[axis], -octant.lower[axis]),
                          numeric::AddUp(octant.upper[axis], -middle[axis]));
  }
  return {middle, numeric::Norm(numeric::IntervalVector(half)).upper};
}

/// One after the other: the octant of each node, and where its pieces stand among its level's.
struct Pending {
  std::uint32_t node = 0;
  Octant octant;
  std::size_t first_piece = 0, pieces = 0;
  std::size_t first_corner = 0, corners = 0;
};

/// A node's ball: the octant's circumscribed one, or the smaller of it and one about the part.
enum class BallKind { kSmaller, kCircumscribed };

class Builder {
 public:
  Builder(const geometry::TriangleMesh& mesh, const ShapeOptions& options, BallKind balls)
      : mesh_(mesh), options_(options), balls_(balls) {}

  SphereTree Build() {
    AddRoot();
    while (!pending_.empty()) {
      next_pieces_.Clear();
      next_pending_.clear();
      for (const Pending& pending : pending_) Process(pending);
      std::swap(pieces_, next_pieces_);
      std::swap(pending_, next_pending_);
      ++tree_.levels;
    }
    tree_.nodes.shrink_to_fit();
    tree_.elements.shrink_to_fit();
    return std::move(tree_);
  }

 private:
  void AddRoot() {
    Vector3d lower = mesh_.vertices[mesh_.triangles[0][0]], upper = lower;
    Pieces whole;
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
      const geometry::Triangle& t = mesh_.triangles[i];
      const std::array<Vector3d, 3> corners = {mesh_.vertices[t[0]], mesh_.vertices[t[1]],
                                               mesh_.vertices[t[2]]};
      whole.Append(i, corners);
      for (const Vector3d& p : corners) {
        lower = lower.cwiseMin(p);
        upper = upper.cwiseMax(p);
      }
    }
    held_ = whole.list.size();
    coordinate_max_ = lower.cwiseAbs().cwiseMax(upper.cwiseAbs()).maxCoeff();
    // The bounding cube; an octant must contain its corners, so rounding may not make it smaller.
    const Vector3d middle = lower + 0.5 * (upper - lower);
    const Vector3d half = Vector3d::Constant(0.5 * (upper - lower).maxCoeff());
    const Octant cube{(middle - half).cwiseMin(lower), (middle + half).cwiseMax(upper), 0};
    AddNode(0, cube, whole);
    std::swap(pieces_, next_pieces_);
    std::swap(pending_, next_pending_);
  }

  void AddNode(std::uint32_t level, const Octant& octant, const Pieces& pieces) {
    SphereNode node;
    const geometry::EnclosingBall ball = BallOf(octant, pieces);
    node.centre = ball.centre;
    node.radius = node.signed_distance = ball.radius;
    node.level = level;
    next_pending_.push_back({static_cast<std::uint32_t>(tree_.nodes.size()), octant,
                             next_pieces_.list.size(), pieces.list.size(),
                             next_pieces_.corners.size(), pieces.corners.size()});
    tree_.nodes.push_back(node);
    next_pieces_.Append(pieces);
  }

  /// The octant's circumscribed ball, or a smaller one around the pieces' corners; grown by what
  /// the corners may be off.
  geometry::EnclosingBall BallOf(const Octant& octant, const Pieces& pieces) const {
    geometry::EnclosingBall ball = CircumscribedBall(octant);
    if (balls_ == BallKind::kSmaller) {
      const geometry::EnclosingBall small = geometry::SmallBallAround(pieces.corners);
      if (!(ball.radius < small.radius)) ball = small;
    }
    const double cuts = kCutsPerLevel * octant.depth;
    // The product of two small whole numbers and a power of two is exact, the last one rounds.
    ball.radius = numeric::AddUp(
        ball.radius,
        numeric::MultiplyUp(kCutError * cuts * numeric::kUnitRoundoff, coordinate_max_));
    return ball;
  }

  void Process(const Pending& pending) {
    const auto list = std::span(pieces_.list).subspan(pending.first_piece, pending.pieces);
    const auto corners = std::span(pieces_.corners).subspan(pending.first_corner, pending.corners);
    current_.list.assign(list.begin(), list.end());
    current_.corners.assign(corners.begin(), corners.end());
    Octant octant = pending.octant;
    while (MayBeDivided(octant)) {
      Divide(octant);
      if (!HasRoom()) break;
      if (const int only = OnlyChild(); only >= 0) {
        // The same part in half the octant: the node takes it without a node between.
        octant = ChildOf(octant, MiddleOf(octant), only);
        continue;
      }
      AddChildren(pending.node, octant);
      return;
    }
    MakeLeaf(&tree_.nodes[pending.node]);
  }

  bool MayBeDivided(const Octant& octant) const {
    if (current_.list.size() <= options_.triangles_per_leaf) return false;
    if (octant.depth >= options_.levels_max) return false;
    if (tree_.nodes.size() + 8 > options_.nodes_max) return false;
    return current_.list.size() > kFanFactor * options_.triangles_per_leaf || !IsFan();
  }

  /// Whether all triangles meet in one corner.
  bool IsFan() const {
    for (const std::uint32_t corner : mesh_.triangles[current_.list[0].triangle]) {
      const Vector3d& apex = mesh_.vertices[corner];
      const auto meets = [&](const Piece& piece) {
        const geometry::Triangle& t = mesh_.triangles[piece.triangle];
        return std::any_of(t.begin(), t.end(),
                           [&](std::uint32_t other) { return mesh_.vertices[other] == apex; });
      };
      if (std::all_of(current_.list.begin(), current_.list.end(), meets)) return true;
    }
    return false;
  }

  /// Child i lies above the middle in those axes whose bit of i is set.
  void Divide(const Octant& octant) {
    const Vector3d middle = MiddleOf(octant);
    cutter_.Cut(current_, 0, middle[0], &halves_[0], &halves_[1]);
    for (int x = 0; x < 2; ++x) {
      cutter_.Cut(halves_[x], 1, middle[1], &quarters_[x], &quarters_[x + 2]);
    }
    for (int xy = 0; xy < 4; ++xy) {
      cutter_.Cut(quarters_[xy], 2, middle[2], &eighths_[xy], &eighths_[xy + 4]);
    }
  }

  /// Whether the tree may hold the pieces that the division made; then they count.
  bool HasRoom() {
    std::size_t pieces = held_ - current_.list.size();
    for (const Pieces& eighth : eighths_) pieces += eighth.list.size();
    if (pieces > PiecesMax(mesh_.triangles.size())) return false;
    held_ = pieces;
    return true;
  }

  /// The only child that has pieces; −1: there are several.
  int OnlyChild() const {
    int only = -1;
    for (int child = 0; child < 8; ++child) {
      if (eighths_[child].list.empty()) continue;
      if (only >= 0) return -1;
      only = child;
    }
    return only;
  }

  void AddChildren(std::uint32_t parent, const Octant& octant) {
    const Vector3d middle = MiddleOf(octant);
    const std::uint32_t level = tree_.nodes[parent].level + 1;
    tree_.nodes[parent].first_child = static_cast<std::uint32_t>(tree_.nodes.size());
    for (int child = 0; child < 8; ++child) {
      if (eighths_[child].list.empty()) continue;
      ++tree_.nodes[parent].children;
      AddNode(level, ChildOf(octant, middle, child), eighths_[child]);
    }
  }

  void MakeLeaf(SphereNode* node) {
    node->first_element = static_cast<std::uint32_t>(tree_.elements.size());
    node->elements = static_cast<std::uint32_t>(current_.list.size());
    for (const Piece& piece : current_.list) tree_.elements.emplace_back(piece.triangle);
  }

  const geometry::TriangleMesh& mesh_;
  const ShapeOptions& options_;
  const BallKind balls_;
  double coordinate_max_ = 0;
  SphereTree tree_;
  std::size_t held_ = 0;         ///< Pieces in leaves, and in nodes that are not divided yet.
  Pieces pieces_, next_pieces_;  ///< Of the level at work, and of the next.
  std::vector<Pending> pending_, next_pending_;
  Cutter cutter_;
  Pieces current_;
  std::array<Pieces, 2> halves_;
  std::array<Pieces, 4> quarters_;
  std::array<Pieces, 8> eighths_;
};

}  // namespace

SphereTree BuildOctree(const geometry::TriangleMesh& mesh, const ShapeOptions& options) {
  CORE_CHECK(geometry::IsWellFormed(mesh), "a tree is built of a well-formed mesh",
             mesh.triangles.size());
  return Builder(mesh, options, BallKind::kSmaller).Build();
}

SphereTree BuildCircumscribedOctree(const geometry::TriangleMesh& mesh,
                                    const ShapeOptions& options) {
  CORE_CHECK(geometry::IsWellFormed(mesh), "a tree is built of a well-formed mesh",
             mesh.triangles.size());
  return Builder(mesh, options, BallKind::kCircumscribed).Build();
}

}  // namespace collision::sphere_tree
