// When two bodies with triangles are in contact, along their exact motion.
#pragma once

#include <vector>

#include "client/simulators/checker/bodies.h"
#include "client/simulators/checker/motion.h"

namespace collision::checker {

/// Steps are as long as nothing can change in them: the margin over the greatest relative speed of
/// any two points (conservative advancement, in contact as well as apart). Margins below these two
/// would make the steps too short, so they are as long as with them [m]: then a change back and
/// forth within a step stays unseen.
inline constexpr double kMarginMinApart = 1e-9;
inline constexpr double kMarginMinInContact = 1e-8;

/// A contact is deep if it persists when one body is moved this far in any direction [m]. Shallower
/// ones graze: they are neither demanded nor forbidden.
inline constexpr double kGrazeDepth = 1e-6;

/// A stretch of time in which one thing is known about the pair.
struct Stretch {
  enum class Kind {
    kNear,     ///< Apart whenever looked at, but so near that a touch between may be unseen.
    kContact,  ///< In contact all the time.
    kBlind     ///< In contact whenever looked at, but a gap between may be unseen.
  };
  Kind kind = Kind::kNear;
  long double begin = 0;  ///< [s]
  long double end = 0;
  bool deep = false;  ///< In contact: deeper than kGrazeDepth at some instant of it.
};

/// The stretches of [begin, end], in order; between them the two are certainly apart. Where contact
/// begins or ends is found to 1e-11 s.
std::vector<Stretch> StretchesOf(const Body& a, const Body& b, const PairMotion& motion,
                                 long double begin, long double end);

}  // namespace collision::checker
