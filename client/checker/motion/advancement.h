// When two bodies with shapes are in contact along their exact motion.
#pragma once

#include <vector>

#include "client/checker/motion/motion.h"
#include "client/checker/shape/bodies.h"

namespace collision::checker {

/// Conservative advancement, in contact as well as apart: a step lasts the margin over the greatest
/// relative speed of any two points, so nothing changes in it. Margins below these two [m] count as
/// these, or steps would become too short; then a change back and forth within a step stays unseen.
inline constexpr double kMarginMinApart = 1e-9;
inline constexpr double kMarginMinInContact = 1e-8;

/// A contact is deep if it persists when one body is moved this far in any direction [m]. Shallower
/// contacts are grazes: neither demanded nor forbidden.
inline constexpr double kGrazeDepth = 1e-6;

/// A stretch of time with one finding about the pair.
struct Stretch {
  enum class Kind {
    kNear,     ///< Apart at every step, but so near that a touch in between may be unseen.
    kContact,  ///< In contact all the time.
    kBlind     ///< In contact at every step, but a gap in between may be unseen.
  };
  Kind kind = Kind::kNear;
  long double begin = 0;  ///< [s]
  long double end = 0;
  bool deep = false;  ///< In contact, and deeper than kGrazeDepth at some instant.
};

/// The stretches of [begin, end] in order; between them the two are certainly apart. Begin and end
/// of a contact are exact to 1e-11 s.
std::vector<Stretch> StretchesOf(const Body& a, const Body& b, const PairMotion& motion,
                                 long double begin, long double end);

}  // namespace collision::checker
