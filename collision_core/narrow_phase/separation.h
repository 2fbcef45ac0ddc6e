// The certified bracket of the distance between two posed bodies, by their sphere trees.
#pragma once

#include <vector>

#include "collision_core/narrow_phase/relative_pose.h"
#include "collision_core/narrow_phase/triangle_pair.h"
#include "collision_core/narrow_phase/work.h"

namespace collision {

/// A body as the traversal sees it: the nodes of its tree, or one node for a ball.
class Surface {
 public:
  explicit Surface(const BodySegment& body)
      : shape_(body.shape.get()), reach_(shape_ ? shape_->facts().radius : body.ball.radius) {
    ball_.radius = body.ball.radius;
    ball_.signed_distance = -body.ball.radius;
  }

  const SphereNode& node(std::uint32_t index) const {
    return shape_ ? shape_->tree().nodes[index] : ball_;
  }
  const Shape* shape() const { return shape_; }  ///< Null: a ball.
  double reach() const { return reach_; }        ///< Of its points about the reference point [m].
  double turning_reach() const { return shape_ ? reach_ : 0; }

 private:
  const Shape* shape_;
  SphereNode ball_;
  double reach_;
};

/// How far a look goes before it ends of itself.
enum class Goal {
  kDecision,  ///< Certainly apart, with at least half of the distance; certainly in contact; or
              ///< neither can become certain at this pose.
  kContact,  ///< Likewise, but where contact is certain the look goes on for a while: the wider the
             ///< margin, the longer contact lasts.
  kNearest,  ///< Down to the triangles, so that the shortest way between the two is known.
  kYesNo     ///< Certainly apart, or certainly in contact, and nothing more; or neither can become
             ///< certain at this pose.
};

/// Units for which Goal::kContact looks for a wider margin.
inline constexpr std::uint64_t kMarginUnits = 1000;

/// What makes contact certain at a pose, to be looked at again at the next one.
struct Evidence {
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

/// What one look at a pose tells. The uncertainty of rounding and turning is counted in, that of
/// translation is not: the true distance lies in [lower − translation, upper + translation].
struct Look {
  double lower = -kInfinity;  ///< The surfaces are apart by at least this.
  double upper = kInfinity;   ///< At most; below 0: the bodies overlap by at least −upper.
  /// Crossing triangles: contact is certain while no corner of theirs moves further than this.
  double crossing_margin = -kInfinity;
  Evidence evidence;  ///< Of contact, where it is certain.
  std::uint32_t level = 0;
  bool exhausted = false;  ///< The work allowed is spent.

  /// A point common to both where contact is certain, else half-way between them where they are
  /// nearest; A's body frame. Within `point_error`, uncertainty of translation aside.
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double point_error = kInfinity;
  std::vector<NearestWay> ways;  ///< With Goal::kNearest: one of them is the shortest way.
};

/// Best-first over pairs of nodes: the pair that may be nearest is opened next, ties by node number,
/// so that a look may end at any moment with a bracket that only became narrower.
/// `hint`: leaves that are likely to be the nearest; what is further away then need not be looked
/// at so closely.
Look LookAt(const Surface& a, const Surface& b, const RelativePose& pose, Goal goal, Work* work,
            const Evidence& hint = {});

/// Until the bracket of the distance is at most `width` [m] wide, or relative to its lower end at
/// most `share`, or nothing makes it narrower; where contact is certain it ends at once.
Look BracketAt(const Surface& a, const Surface& b, const RelativePose& pose, double width,
               double share, Work* work);

/// Nothing but this evidence: of contact all is said, of the distance nothing below.
Look LookAgain(const Surface& a, const Surface& b, const RelativePose& pose,
               const Evidence& evidence, Work* work);

/// Solids whose surfaces are certainly apart. One point of each connected component decides, since
/// the components are apart.
/// Where the work ends before all components were asked, nothing is certain.
struct Nesting {
  bool neither = false;  ///< Certainly neither is inside the other, not even in part.
  /// A point of one that is certainly inside the other, in A's body frame, within `point_error`;
  /// +infinity: there is none.
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double point_error = kInfinity;

  bool certain() const { return point_error < kInfinity; }
};
Nesting NestingOf(const Surface& a, const Surface& b, const RelativePose& pose, Work* work);

/// Whether two bodies are apart or touch; for solids, one inside the other is touching.
enum class Verdict { kApart, kTouching, kUndecided };

struct Decision {
  Verdict verdict = Verdict::kUndecided;
  Look look;  ///< Of the surfaces, as far as it was needed.
};

/// Goal::kYesNo, and where the surfaces are apart, whether one is inside the other. The uncertainty
/// of translation is counted in.
Decision DecideAt(const Surface& a, const Surface& b, const RelativePose& pose, Work* work);

}  // namespace collision
