// Where two segments, or a segment and a box, are nearest: in closed form.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace collision::geometry {

/// Clamps to [−1, 1]; NaN gives 0.
inline double ClampToMinusOneOne(double t) {
  return t > -1 ? std::min(t, 1.0) : (t <= -1 ? -1 : 0);
}

/// The nearest points of two segments: s and t in [−1, 1] that make d + t h − s g shortest, where d
/// leads from the middle of the first segment to that of the second, and g and h are their half
/// axes. Either axis may be zero. After Ericson, "Real-time collision detection", 2005, section
/// 5.1.9, with the segments' middles as origins.
struct SegmentFractions {
  double s, t;
};
inline SegmentFractions NearestOnSegments(const Eigen::Vector3d& d, const Eigen::Vector3d& g,
                                          const Eigen::Vector3d& h) {
  const double gg = g.squaredNorm(), hh = h.squaredNorm(), gh = g.dot(h);
  const double gd = g.dot(d), hd = h.dot(d);
  if (!(gg > 0)) return {0, hh > 0 ? ClampToMinusOneOne(-hd / hh) : 0};
  if (!(hh > 0)) return {ClampToMinusOneOne(gd / gg), 0};
  const double denominator = gg * hh - gh * gh;
  const double s = denominator > 0 ? ClampToMinusOneOne((gd * hh - gh * hd) / denominator) : 0;
  const double t = ClampToMinusOneOne((s * gh - hd) / hh);
  return {ClampToMinusOneOne((gd + t * gh) / gg), t};
}

/// The t in [−1, 1] at which the point x + t v is nearest to a box. x and v are coordinates along
/// the box's half edges, so that the box is [−1, 1]³; w holds the squared lengths of the half
/// edges.
///
/// Half of the derivative of the squared distance is Σ w_i v_i e_i, with e_i the amount by which
/// x_i + t v_i exceeds [−1, 1]: it never falls and is linear between the planes of the faces.
/// Newton's method ends where a step stays between the same planes, or after kStepsMax steps; a
/// step that leaves the known interval is replaced by a bisection.
inline double FractionNearBox(const double (&x)[3], const double (&v)[3], const double (&w)[3]) {
  constexpr int kStepsMax = 12;
  constexpr double kSameFraction = 0x1p-52;  // A unit in the last place of 1: no step is shorter.
  double least = -1, most = 1, t = 0;
  for (int step = 0; step < kStepsMax; ++step) {
    double rise = 0, slope = 0;
    for (int i = 0; i < 3; ++i) {
      const double at = x[i] + t * v[i];
      const double beyond = at - std::clamp(at, -1.0, 1.0);
      const double weight = w[i] * v[i];
      rise += weight * beyond;
      slope += beyond != 0 ? weight * v[i] : 0;
    }
    if (rise > 0) most = t;
    if (rise < 0) least = t;
    if (!(slope > 0)) return t;
    double next = t - rise / slope;
    if (next <= least) next = rise > 0 && least > -1 ? 0.5 * (least + most) : least;
    if (next >= most) next = rise < 0 && most < 1 ? 0.5 * (least + most) : most;
    if (std::abs(next - t) <= kSameFraction) return next;
    t = next;
  }
  return t;
}

}  // namespace collision::geometry
