// When two points that move on cubics are within a distance of each other.
#pragma once

#include <array>
#include <vector>

namespace collision::checker {

/// A cubic per axis in seconds, the constant first.
using Cubic3 = std::array<std::array<long double, 4>, 3>;

/// A closed span of seconds.
struct Span {
  long double begin = 0;
  long double end = 0;
};

/// The spans of [0, duration] in which |d(t)| <= reach, in order and disjoint. The Bernstein
/// coefficients of the sextic |d|² - reach² bound it on every part; parts are halved until the sign
/// is certain or they are shorter than 1e-12 s, which is the error of the spans' ends. Values
/// within rounding of zero count as contact.
std::vector<Span> SpansWithin(const Cubic3& d, long double duration, long double reach);

/// The spans of [0, duration] in which a cubic, the constant first, is at most `most`. Likewise.
std::vector<Span> SpansBelow(const std::array<long double, 4>& height, long double duration,
                             long double most);

}  // namespace collision::checker
