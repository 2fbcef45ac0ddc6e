#include "collision_core/narrow_phase/contact/contact_candidates.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <set>

#include "collision_core/narrow_phase/convex_pair/convex_distance.h"
#include "collision_core/narrow_phase/pose/node_pair.h"
#include "collision_core/narrow_phase/separation/element.h"

namespace collision::narrow_phase {
namespace {

using Eigen::Vector3d;

// The most pairs of elements that are near enough, and the most that are measured. Where large
// faces lie on each other many are near; any two of them show what is needed.
constexpr std::size_t kPairsMax = 64;
constexpr std::size_t kMeasuredMax = 1024;

// So many of each kind are kept, for either body.
constexpr std::size_t kKept = 2;

// Corners of a face that are so near to the least height are as low, as a share of the size.
constexpr double kLevel = 0x1p-44;

constexpr int kNext[3] = {1, 2, 0};

// What lies on what, the widest first.
enum Kind { kFace, kEdge, kCorner, kKinds };

struct Proposal {
  Vector3d x;  // in A's frame
  double extent = 0;
};

Vector3d MeanOf(const std::vector<Vector3d>& points) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

// What of a polygon lies where n·(x − at) >= −slack.
std::vector<Vector3d> Clipped(const std::vector<Vector3d>& polygon, const Vector3d& at,
                              const Vector3d& n, double slack) {
  std::vector<Vector3d> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3d &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double from = n.dot(p - at) + slack, to = n.dot(q - at) + slack;
    if (from >= 0) kept.push_back(p);
    if ((from > 0 && to < 0) || (from < 0 && to > 0))
      kept.push_back(p + from / (from - to) * (q - p));
  }
  return kept;
}

double AreaOf(const std::vector<Vector3d>& polygon) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    sum += (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
  }
  return sum.norm() / 2;
}

double LengthOf(const std::vector<Vector3d>& points) {
  double length = 0;
  for (const Vector3d& p : points) length = std::max(length, (p - points[0]).norm());
  return length;
}

class CandidateSearch {
 public:
  CandidateSearch(const PosedPair& pair, double within, WorkBudget* work)
      : a_(pair.a),
        b_(pair.b),
        pose_(pair.pose),
        within_(within),
        level_(kLevel * (a_.reach() + b_.reach() + pose_.p_AB.norm())),
        work_(*work) {}

  std::vector<ContactCandidate> Run(NodePair first) {
    if (a_.node(first.a).is_leaf() && b_.node(first.b).is_leaf()) Leaves(first);
    stack_.push_back({});
    while (!stack_.empty() && pairs_ < kPairsMax && measured_ < kMeasuredMax &&
           !work_.exhausted()) {
      const NodePair nodes = stack_.back();
      stack_.pop_back();
      Visit(nodes);
    }
    return Best();
  }

 private:
  void Visit(NodePair nodes) {
    work_.Spend(1);
    const sphere_tree::SphereNode &a = a_.node(nodes.a), &b = b_.node(nodes.b);
    if ((pose_.ToA(b.centre) - a.centre).norm() - a.radius - b.radius > within_) return;
    const auto keep = [&](NodePair children) { stack_.push_back(children); };
    if (!OpenLarger(a_, b_, nodes, keep)) Leaves(nodes);
  }

  void Leaves(NodePair leaves) {
    for (const ElementIndex s : a_.shape()->tree().ElementsOf(a_.node(leaves.a))) {
      for (const ElementIndex t : b_.shape()->tree().ElementsOf(b_.node(leaves.b))) {
        if (work_.exhausted()) return;
        AnySolid(a_, b_, {s, t}) ? Solids({s, t}) : Triangles({s, t});
      }
    }
  }

  void Triangles(ElementPair pair) {
    const BoxedTriangle of_a(pair.a, CornersOf(*a_.shape(), pair.a));
    const BoxedTriangle of_b(pair.b, CornersOf(*b_.shape(), pair.b, pose_));
    work_.Spend(kBoxPairUnits);
    if (BoxDistance(of_a, of_b) > within_) return;
    if (!seen_.insert(pair).second) return;
    ++measured_;
    work_.Spend(kTrianglePairUnits);
    if (geometry::DistanceOf(of_a.corners, of_b.corners).distance.lower > within_) return;
    ++pairs_;
    FaceOn(PairMember::kA, of_a.corners, of_b.corners);
    FaceOn(PairMember::kB, of_b.corners, of_a.corners);
  }

  void Solids(ElementPair pair) {
    if (!seen_.insert(pair).second) return;
    ++measured_;
    geometry::GjkHint none;
    const ConvexSeparation found =
        SeparationOf(PosedA(SetOf(a_, pair.a), pose_), PosedB(SetOf(b_, pair.b), pose_),
                     {ConvexGoal::kDistance, 0, within_ / 2}, &none, &work_);
    if (found.separation.lower > within_) return;
    ++pairs_;
    solids_.push_back({{}, ContactWitness::Elements(pair)});
  }

  void Keep(Kind kind, PairMember body, const Vector3d& x, double extent) {
    std::vector<Proposal>& list = proposals_[kind][body == PairMember::kA ? 0 : 1];
    for (Proposal& other : list) {
      if ((other.x - x).norm() > level_) continue;
      other.extent = std::max(other.extent, extent);
      return;
    }
    list.push_back({x, extent});
    std::stable_sort(list.begin(), list.end(),
                     [](const Proposal& p, const Proposal& q) { return p.extent > q.extent; });
    if (list.size() > kKept) list.pop_back();
  }

  // What of one triangle stands over the other, where it is the nearest to its plane; of edges that
  // meet the point or the part where they do, since what stands over the rim counts.
  void FaceOn(PairMember body, const geometry::TrianglePoints& t,
              const geometry::TrianglePoints& base) {
    const Vector3d n = (base[1] - base[0]).cross(base[2] - base[0]).normalized();
    if (!(n.norm() > 0.5)) return;
    std::vector<Vector3d> polygon(t.begin(), t.end());
    for (int i = 0; i < 3 && !polygon.empty(); ++i) {
      const Vector3d inward = n.cross(base[kNext[i]] - base[i]).normalized();
      polygon = Clipped(polygon, base[i], inward, level_);
    }
    double least = numeric::kInfinity;
    for (const Vector3d& p : polygon) least = std::min(least, std::abs(n.dot(p - base[0])));
    if (polygon.empty() || least > within_) return;
    std::vector<Vector3d> low;
    for (const Vector3d& p : polygon) {
      if (std::abs(n.dot(p - base[0])) <= least + level_) low.push_back(p);
    }
    const double area = AreaOf(low), length = LengthOf(low);
    const Kind kind = area > level_ * length ? kFace : length > 4 * level_ ? kEdge : kCorner;
    Keep(kind, body, MeanOf(low), kind == kFace ? area : length);
  }

  std::vector<ContactCandidate> Best() {
    std::vector<ContactCandidate> candidates = std::move(solids_);
    for (int kind = 0; kind < kKinds; ++kind) {
      for (const Proposal& p : proposals_[kind][0]) {
        if (!work_.exhausted()) candidates.push_back({PointOfA(a_, p.x, &work_), {}});
      }
      for (const Proposal& p : proposals_[kind][1]) {
        if (!work_.exhausted()) candidates.push_back({PointOfB(b_, pose_.ToB(p.x), &work_), {}});
      }
    }
    return candidates;
  }

  const BodyTree& a_;
  const BodyTree& b_;
  const RelativePose& pose_;
  const double within_;
  const double level_;
  WorkBudget& work_;
  std::size_t pairs_ = 0, measured_ = 0;
  std::vector<NodePair> stack_;
  std::set<ElementPair> seen_;
  std::vector<ContactCandidate> solids_;
  std::vector<Proposal> proposals_[kKinds][2];
};

}  // namespace

std::vector<ContactCandidate> FindContactCandidates(const PosedPair& pair, double within,
                                                    NodePair first, WorkBudget* work) {
  const BodyTree &a = pair.a, &b = pair.b;
  if (a.shape() == nullptr || b.shape() == nullptr) return {};
  const bool any_solids = !a.shape()->solids().empty() || !b.shape()->solids().empty();
  if (!a.shape()->closed() && !b.shape()->closed() && !any_solids) return {};
  return CandidateSearch(pair, within, work).Run(first);
}

}  // namespace collision::narrow_phase
