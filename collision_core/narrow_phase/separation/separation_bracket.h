// What a query of the separation of two bodies asks for, and the certified bracket that it returns.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "collision_core/narrow_phase/pose/pair_parts.h"
#include "collision_core/numeric/interval.h"

namespace collision::narrow_phase {

/// The goal of a query: it ends as soon as its bracket satisfies the goal, or when nothing can make
/// the bracket narrower at this pose.
enum class Goal {
  /// Certainly apart, with at least half of the distance known; or certainly in contact.
  kDecision,
  /// As kDecision, but where contact is certain the query goes on for kMarginUnits: the wider the
  /// margin, the longer contact certainly lasts.
  kContact,
  kNearest,  ///< Down to the triangles, so that the shortest way between the two is known.
  kYesNo     ///< Certainly apart, or certainly in contact; no distance.
};

/// How narrow a bracket of the distance has to be: the wider of the two.
struct BracketTolerance {
  double absolute = 0;  ///< Width of the bracket [m].
  double relative = 0;  ///< Width over the lower end.
};

/// Units for which Goal::kContact looks for a wider margin.
inline constexpr std::uint64_t kMarginUnits = 1000;

/// A witness: what makes contact certain at a pose, to be tested again at the next one.
struct ContactWitness {
  enum class Kind {
    kNone,
    kNodes,     ///< Balls within the solids, or about the surface, that overlap.
    kElements,  ///< Two elements that overlap or cross, or one that reaches into a ball.
    kLeaves     ///< Any elements of two leaves.
  };
  Kind kind = Kind::kNone;
  NodePair nodes;        ///< With kNodes and kLeaves.
  ElementPair elements;  ///< With kElements; if one body is a ball, both name the other's.

  static ContactWitness Nodes(NodePair pair) { return {Kind::kNodes, pair, {}}; }
  static ContactWitness Elements(ElementPair pair) { return {Kind::kElements, {}, pair}; }
  static ContactWitness Leaves(NodePair pair) { return {Kind::kLeaves, pair, {}}; }

  bool is_none() const { return kind == Kind::kNone; }
};

/// A way between the two surfaces that may be the shortest one; in A's body frame.
struct NearestWay {
  Eigen::Vector3d a, b;
  double lower, upper;   ///< Its length, the turning of both counted in.
  ElementPair elements;  ///< That it joins; if one body is a ball, both name the other's.
};

/// The result of one query at a pose. The uncertainty of rounding and turning is included, that of
/// translation is not: the true distance lies in [lower − translation, upper + translation].
struct SeparationBracket {
  double lower = -numeric::kInfinity;  ///< The surfaces are apart by at least this.
  double upper = numeric::kInfinity;
  /// The surfaces are apart by at most this; below 0: the bodies overlap by at least −upper.
  /// Crossing triangles: contact is certain while no corner of theirs moves further than this.
  double crossing_margin = -numeric::kInfinity;
  ContactWitness witness;   ///< Of contact, where it is certain.
  std::uint32_t level = 0;  ///< The deepest level of the sphere trees that was opened.
  bool exhausted = false;   ///< The work allowed is spent.

  /// A point common to both where contact is certain, else half-way between them where they are
  /// nearest; A's body frame. Within `point_error`, uncertainty of translation aside.
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double point_error = numeric::kInfinity;
  std::vector<NearestWay> ways;  ///< With Goal::kNearest: one of them is the shortest way.
  /// The elements that `point` belongs to, or lies between; if one body is a ball, both name the
  /// other's. None where only balls of the trees were compared.
  std::optional<ElementPair> elements;

  /// The surfaces are apart wherever B is displaced by at most `translation` [m]. Says nothing of
  /// one body inside the other.
  bool CertainlyApart(double translation) const { return lower > translation; }
  /// Balls within the solids overlap wherever B is displaced by at most `translation`.
  bool CertainlyOverlapping(double translation) const { return upper <= -translation; }
  /// Two triangles cross likewise: seen from half-way between the bodies, each moves by half.
  bool CertainlyCrossing(double translation) const { return crossing_margin >= translation / 2; }
  bool CertainlyTouching(double translation) const {
    return CertainlyOverlapping(translation) || CertainlyCrossing(translation);
  }
};

}  // namespace collision::narrow_phase
