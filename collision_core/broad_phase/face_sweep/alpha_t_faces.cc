#include "collision_core/broad_phase/face_sweep/alpha_t_faces.h"

#include <algorithm>
#include <cmath>

#include "collision_core/base/check.h"
#include "collision_core/motion/hypertrapezoid.h"
#include "collision_core/motion/speed_cap.h"
#include "collision_core/numeric/seconds.h"

namespace collision::broad_phase {
namespace {

/// MayOverlap() computes a difference of two coordinates of up to 2^51 from products and sums that
/// each round by at most one unit: four in all, and one to spare.
constexpr double kSectionSlack = 5;

/// Faces that reach this many times as far as all others would cost the others ten bits of the
/// grid.
constexpr double kApartFactor = 1024;

FaceLines LinesOf(const motion::Hypertrapezoid& h) {
  FaceLines lines;
  for (int axis = 0; axis < 3; ++axis) {
    lines.start[axis] = h.lower_start[axis];
    lines.end[axis] = h.lower_end[axis];
    lines.start[axis + 3] = h.upper_start[axis];
    lines.end[axis + 3] = h.upper_end[axis];
  }
  return lines;
}

/// The outer one of two values of a face.
double Outer(int face, double a, double b) { return face < 3 ? std::min(a, b) : std::max(a, b); }

double Nanoseconds(Instant from, Instant to) {
  return static_cast<double>(static_cast<__int128>(to.nanoseconds()) - from.nanoseconds());
}

/// The ball's box at two instants, in plain arithmetic: each face is a sum of a few products, off
/// by some units in the last place of the magnitudes that kFacePadding counts.
FaceLines LinesOfBall(const motion::SpaceTimeBound& bound, Instant start, Instant end) {
  const motion::MotionState& state = bound.state;
  const motion::MotionLimits& limits = bound.limits;
  const double errors =
      limits.radius + state.position_error + (bound.skew > 0 ? state.v_WA.norm() : 0) * bound.skew;
  FaceLines lines;
  const auto at = [&](Instant t, std::array<double, 6>* faces) {
    const double elapsed = numeric::kNanosecond * Nanoseconds(state.stamp, t),
                 worked = elapsed + bound.skew;
    const double reach = errors + (state.velocity_error +
                                   0.5 * limits.acceleration_max * (worked + limits.time_step)) *
                                      worked;
    for (int axis = 0; axis < 3; ++axis) {
      const double centre = state.p_WA[axis] + state.v_WA[axis] * elapsed;
      (*faces)[axis] = centre - reach;
      (*faces)[axis + 3] = centre + reach;
    }
  };
  at(start, &lines.start);
  at(end, &lines.end);
  return lines;
}

motion::SpaceTimeBound Grown(motion::SpaceTimeBound bound, double by) {
  bound.limits.radius += by;
  return bound;
}

/// Requires stamp <= start.
FaceLines LinesFrom(const motion::SpaceTimeBound& bound, Instant start, Instant end) {
  const bool is_ball =
      bound.state.direction.isZero(0) && !HasSpeedCap(bound.limits) && !Bends(bound);
  return is_ball ? LinesOfBall(bound, start, end) : LinesOf(MakeHypertrapezoid(bound, start, end));
}

/// Prolongs lines that start at the stamp back to the window's start, as FaceLinesOf() says. What
/// rounds here is far below the padding: no factor is above 1.
void ProlongToStart(Instant start, Instant stamp, Instant end, FaceLines* lines) {
  const double before = Nanoseconds(start, stamp), after = Nanoseconds(stamp, end);
  for (int face = 0; face < 6; ++face) {
    const double at_stamp = lines->start[face], at_end = lines->end[face];
    if (before <= after && after > 0) {
      const double prolonged = at_stamp + (at_stamp - at_end) * (before / after);
      lines->start[face] = Outer(face, at_stamp, prolonged);
    } else {
      lines->start[face] = lines->end[face] = Outer(face, at_stamp, at_end);
    }
  }
}

}  // namespace

std::optional<FaceLines> FaceLinesOf(const motion::SpaceTimeBound& bound, Instant start,
                                     Instant end) {
  const motion::MotionState& state = bound.state;
  CORE_CHECK(state.stamp <= end && start <= end,
             "a window ends after its begin and after the stamp", state.stamp.nanoseconds(),
             start.nanoseconds(), end.nanoseconds());
  const bool is_late = state.stamp > start;
  FaceLines lines = LinesFrom(bound, is_late ? state.stamp : start, end);
  if (is_late) ProlongToStart(start, state.stamp, end, &lines);
  const double elapsed = numeric::kNanosecond * Nanoseconds(state.stamp, end);
  double magnitude = 0;
  for (int axis = 0; axis < 3; ++axis) {
    magnitude += std::abs(state.p_WA[axis]) + std::abs(state.v_WA[axis]) * elapsed;
  }
  for (int face = 0; face < 6; ++face) {
    magnitude += std::abs(lines.start[face]) + std::abs(lines.end[face]);
  }
  if (!std::isfinite(magnitude)) return std::nullopt;
  const double padding = magnitude * kFacePadding;
  for (int face = 0; face < 6; ++face) {
    const double outward = face < 3 ? -padding : padding;
    lines.start[face] += outward;
    lines.end[face] += outward;
  }
  return lines;
}

void AlphaTFaces::Build(const BoundList& bounds, const std::vector<std::uint32_t>& agents,
                        Instant start, Instant end, const intersection::PairRules& rules) {
  agents_.clear();
  apart_.clear();
  lines_.clear();
  for (const std::uint32_t agent : agents) {
    const motion::SpaceTimeBound& bound = bounds[agent]->bound;
    if (bound.state.expiry < start || bound.state.stamp > end) continue;
    // The sum rounds far below the padding.
    const double half_margin = rules.empty() ? 0 : rules.HalfMargin(agent);
    const std::optional<FaceLines> lines = half_margin > 0
                                               ? FaceLinesOf(Grown(bound, half_margin), start, end)
                                               : FaceLinesOf(bound, start, end);
    if (lines) {
      agents_.push_back(agent);
      lines_.push_back(*lines);
    } else {
      apart_.push_back(agent);
    }
  }
  FindOrigin();
  PutOnGrid(SetFarthestApart());
}

/// The median of the lower faces: a few agents far out do not move it.
void AlphaTFaces::FindOrigin() {
  origin_ = {};
  if (agents_.empty()) return;
  for (int axis = 0; axis < 3; ++axis) {
    scratch_.clear();
    for (const FaceLines& lines : lines_) scratch_.push_back(lines.start[axis]);
    const auto middle = scratch_.begin() + scratch_.size() / 2;
    std::nth_element(scratch_.begin(), middle, scratch_.end());
    origin_[axis] = *middle;
  }
}

double AlphaTFaces::SetFarthestApart() {
  scratch_.clear();
  for (const FaceLines& lines : lines_) {
    double reach = 0;
    for (int face = 0; face < 6; ++face) {
      const double origin = origin_[face % 3];
      reach = std::max(
          {reach, std::abs(lines.start[face] - origin), std::abs(lines.end[face] - origin)});
    }
    scratch_.push_back(reach);
  }
  if (scratch_.empty()) return 0;
  const std::size_t apart_max = std::min(kApartMax, scratch_.size() / kAgentsPerApart);
  std::vector<double> reaches = scratch_;
  const auto kept = reaches.begin() + (reaches.size() - 1 - apart_max);
  std::nth_element(reaches.begin(), kept, reaches.end());
  const double reach_max = std::min(*kept * kApartFactor, std::numeric_limits<double>::max());
  double farthest = 0;
  std::size_t slots = 0;
  for (std::size_t i = 0; i < agents_.size(); ++i) {
    if (!(scratch_[i] <= reach_max)) {
      apart_.push_back(agents_[i]);
      continue;
    }
    farthest = std::max(farthest, scratch_[i]);
    agents_[slots] = agents_[i];
    lines_[slots++] = lines_[i];
  }
  agents_.resize(slots);
  lines_.resize(slots);
  return farthest;
}

void AlphaTFaces::PutOnGrid(double reach) {
  // The exponent's bound keeps the scale finite where all agents are within a denormal of a point.
  const int exponent = reach > 0 ? std::max(std::ilogb(reach) + 1 - kCoordinateBits, -1000) : 0;
  const double scale = std::ldexp(1.0, -exponent);
  for (int axis = 0; axis < 3; ++axis) faces_[axis].resize(2 * agents_.size());
  for (std::uint32_t slot = 0; slot < agents_.size(); ++slot) {
    for (int face = 0; face < 6; ++face) {
      // The difference rounds by at most half a unit, the product not at all.
      const auto outward = [&](double value) {
        const double whole = (value - origin_[face % 3]) * scale;
        return face < 3 ? std::floor(whole) - 2 : std::ceil(whole) + 2;
      };
      FaceLines& lines = lines_[slot];
      lines.start[face] = outward(lines.start[face]);
      lines.end[face] = outward(lines.end[face]);
      faces_[face % 3][2 * slot + face / 3] = {static_cast<std::int64_t>(lines.start[face]),
                                               static_cast<std::int64_t>(lines.end[face]),
                                               2 * slot + face / 3};
    }
  }
}

bool AlphaTFaces::MayOverlap(std::uint32_t slot, std::uint32_t other, double fraction_1,
                             double fraction_2) const {
  const auto over = [&](const FaceLines& above, const FaceLines& below, int axis) {
    const double at_start = above.start[axis + 3] - below.start[axis];
    const double change = (above.end[axis + 3] - below.end[axis]) - at_start;
    return at_start + change * fraction_1 >= -kSectionSlack ||
           at_start + change * fraction_2 >= -kSectionSlack;
  };
  const FaceLines& a = lines_[slot];
  const FaceLines& b = lines_[other];
  return over(a, b, 0) && over(b, a, 0) && over(a, b, 1) && over(b, a, 1) && over(a, b, 2) &&
         over(b, a, 2);
}

}  // namespace collision::broad_phase
