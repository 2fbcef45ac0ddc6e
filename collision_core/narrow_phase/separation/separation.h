// The certified bracket of the distance between two posed bodies, by their sphere trees.
//
// A query opens pairs of nodes. `lower` is the least lower bound of what is not opened, `upper` a
// running minimum, so both ends hold at any moment and only become narrower. A query ends when its
// answer cannot change any more: certainly apart with at least half of the distance, certainly in
// contact, or resolved down to the triangles. Contact is certain by balls within the solids that
// overlap (upper <= 0; the depth is at least −upper), or by an edge that passes through a triangle
// wherever the corners lie within the uncertainty: the only way for open surfaces, and for solids
// the way that finds shallow contacts.
//
// Free needs one point of each component outside the other solid as well (TestContainment). It is asked
// once for each advance: from there on the surfaces stay apart, so nothing gets in.
//
// Yes or no (DecideAt) first asks the two roots: 20 ns for bodies whose balls are apart. Then the
// convex bodies around both (hull_gap.h): for bodies a tenth of their diameter apart they decide
// 85, 72 and 99 % of the poses on the first line (homer, spot, rocker-arm), nearly all on the
// others, in 0.1 µs instead of 0.4 µs; bodies that are deep in each other lose 0.1 µs by it. One
// inside the other is found at once where a body has an extreme vertex off the other's box. The
// search that follows compares squares instead of roots, because only the limit matters, and visits
// the newest pairs first.
#pragma once

#include <vector>

#include "collision_core/base/work_budget.h"
#include "collision_core/geometry/triangle/triangle_pair.h"
#include "collision_core/narrow_phase/pose/relative_pose.h"

namespace collision::narrow_phase {

/// A body as a traversal sees it: the nodes of its tree, or one node for a ball.
class BodyTree {
 public:
  explicit BodyTree(const BodySegment& body)
      : shape_(body.shape.get()), reach_(shape_ ? shape_->facts().radius : body.ball.radius) {
    ball_.radius = body.ball.radius;
    ball_.signed_distance = -body.ball.radius;
  }

  const sphere_tree::SphereNode& node(std::uint32_t index) const {
    return shape_ ? shape_->tree().nodes[index] : ball_;
  }
  const shape::Shape* shape() const { return shape_; }  ///< Null: a ball.
  double reach() const {
    return reach_;
  }  ///< Distance of its farthest point from the reference point [m].
  double turning_reach() const { return shape_ ? reach_ : 0; }

 private:
  const shape::Shape* shape_;
  sphere_tree::SphereNode ball_;
  double reach_;
};

/// How far a query goes before it ends by itself.
enum class Goal {
  kDecision,  ///< Certainly apart, with at least half of the distance; certainly in contact; or
              ///< neither can become certain at this pose.
  kContact,   ///< As kDecision, but where contact is certain the query looks for a wider margin
              ///< for a while: the wider the margin, the longer contact lasts.
  kNearest,   ///< Down to the triangles, so that the shortest way between the two is known.
  kYesNo      ///< Certainly apart, or certainly in contact, and nothing more; or neither can become
              ///< certain at this pose.
};

/// Units for which Goal::kContact looks for a wider margin.
inline constexpr std::uint64_t kMarginUnits = 1000;

/// A witness: what makes contact certain at a pose, to be tested again at the next one.
struct ContactWitness {
  enum class Kind {
    kNone,
    kNodes,      ///< Balls within the solids, or about the surface, that overlap.
    kTriangles,  ///< Two triangles that cross, or one that reaches into a ball.
    kLeaves      ///< Any triangles of two leaves.
  };
  Kind kind = Kind::kNone;
  std::uint32_t a = 0;
  std::uint32_t b = 0;
};

/// A way between the two surfaces that may be the shortest one; in A's body frame.
struct NearestWay {
  Eigen::Vector3d a, b;
  double lower, upper;  ///< Its length, the turning of both counted in.
};

/// The result of one query at a pose. The uncertainty of rounding and turning is included, that of
/// translation is not: the true distance lies in [lower − translation, upper + translation].
struct SeparationBracket {
  double lower = -numeric::kInfinity;  ///< The surfaces are apart by at least this.
  double upper = numeric::kInfinity;  ///< At most; below 0: the bodies overlap by at least −upper.
  /// Crossing triangles: contact is certain while no corner of theirs moves further than this.
  double crossing_margin = -numeric::kInfinity;
  ContactWitness evidence;  ///< The witness of contact, where contact is certain.
  std::uint32_t level = 0;
  bool exhausted = false;  ///< The work allowed is spent.

  /// A point common to both where contact is certain, else half-way between them where they are
  /// nearest; A's body frame. Within `point_error`, uncertainty of translation aside.
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double point_error = numeric::kInfinity;
  std::vector<NearestWay> ways;  ///< With Goal::kNearest: one of them is the shortest way.
};

/// Queries the separation best-first over pairs of nodes: the pair that may be nearest is opened
/// next, ties by node number, so that the query may end at any moment with a bracket that only
/// became narrower. `hint`: leaves that are likely to be the nearest; what is farther away need not
/// be examined so closely.
SeparationBracket QuerySeparation(const BodyTree& a, const BodyTree& b, const RelativePose& pose,
                                  Goal goal, WorkBudget* work, const ContactWitness& hint = {});

/// Queries until the bracket of the distance is at most `width` [m] wide, or at most the fraction
/// `share` of its lower end, or nothing makes it narrower. It ends at once where contact is
/// certain.
SeparationBracket BracketSeparation(const BodyTree& a, const BodyTree& b, const RelativePose& pose,
                                    double width, double share, WorkBudget* work);

/// Re-tests this witness only: contact is reported in full, `lower` stays −infinity.
SeparationBracket RecheckWitness(const BodyTree& a, const BodyTree& b, const RelativePose& pose,
                                 const ContactWitness& evidence, WorkBudget* work);

/// Whether one of two solids whose surfaces are certainly apart is inside the other. One point of
/// each connected component decides, because the components are apart. If the work ends before all
/// components were asked, nothing is certain.
struct Containment {
  bool neither = false;  ///< Certainly neither is inside the other, not even in part.
  /// A point of one that is certainly inside the other, in A's body frame, within `point_error`;
  /// +infinity: there is none.
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double point_error = numeric::kInfinity;

  bool certain() const { return point_error < numeric::kInfinity; }
};
/// The containment test. An open surface has no inside, so nothing is inside of it.
Containment TestContainment(const BodyTree& a, const BodyTree& b, const RelativePose& pose,
                            WorkBudget* work);

/// Whether two bodies are apart or touch; for solids, one inside the other is touching.
enum class Verdict { kApart, kTouching, kUndecided };

/// A verdict, and the bracket that was found on the way.
struct Decision {
  Verdict verdict = Verdict::kUndecided;
  SeparationBracket look;  ///< The bracket of the surfaces, as far as it was needed.
};

/// Goal::kYesNo, and where the surfaces are apart, whether one is inside the other. The uncertainty
/// of translation is counted in.
Decision DecideAt(const BodyTree& a, const BodyTree& b, const RelativePose& pose, WorkBudget* work);

}  // namespace collision::narrow_phase
