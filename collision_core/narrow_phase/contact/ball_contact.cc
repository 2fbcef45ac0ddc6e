#include "collision_core/narrow_phase/contact/ball_contact.h"

#include <algorithm>
#include <cmath>

#include "collision_core/narrow_phase/pose/time_direction.h"
#include "collision_core/numeric/first_approach.h"

namespace collision::narrow_phase {
namespace {

/// Ends of certified contact are found to this part of the segment.
constexpr double kResolution = 1e-13;

/// Steps at most: golden section shrinks its range by 0.62 a step, bisection by half.
constexpr int kSearchSteps = 80;

/// Parts of a contact that are asked at most, where the path bends; then it counts as interrupted.
constexpr int kPartsAsked = 512;

/// Rounds in which the choices of bounds may extend each other's freedom.
constexpr int kRoundsMax = 16;

/// The relative motion from A to B under one choice of a bound of each ball.
struct Choice {
  /// As Difference(), with the sum of both radii, but the centres at base are subtracted instead of
  /// anchors and shifts: the anchor is their difference, the shift 0.
  numeric::MovingBall ball;

  numeric::Interval Distance(double delta) const {
    return numeric::Norm(ball.anchor + ball.PathTo(delta));
  }

  /// r − u − |Δc|: touching where it is >= 0, for all motions within the bounds. Concave unless the
  /// path bends.
  numeric::Interval Depth(double delta) const {
    return ball.radius - ball.u.At(delta) - Distance(delta);
  }
};

std::vector<Choice> ChoicesOf(const BallSegment& a, const BallSegment& b) {
  std::vector<Choice> choices;
  choices.reserve(a.bounds.size() * b.bounds.size());
  for (const numeric::MovingBall& ball_a : a.bounds) {
    for (const numeric::MovingBall& ball_b : b.bounds) {
      choices.push_back({{ball_b.centre() - ball_a.centre(), numeric::IntervalVector(),
                          ball_b.velocity - ball_a.velocity, numeric::Interval(a.radius) + b.radius,
                          ball_a.u + ball_b.u}});
      numeric::MovingBall& ball = choices.back().ball;
      ball.bends = ball_a.bends || ball_b.bends;
      if (ball.bends) ball.bend = ball_b.bend - ball_a.bend;
    }
  }
  return choices;
}

/// Touching is certified on [from, to], or at its ends only; empty if from > to.
struct Contact {
  double from = 1;
  double to = 0;
  bool continuous = true;
};

/// Moves from a certified time towards one that is not, up to the last certified one.
double LastCertified(const Choice& choice, double certified, double uncertified,
                     double resolution) {
  for (int i = 0; i < kSearchSteps && std::abs(uncertified - certified) > resolution; ++i) {
    const double middle = certified + 0.5 * (uncertified - certified);
    (choice.Depth(middle).lower >= 0 ? certified : uncertified) = middle;
  }
  return certified;
}

/// Below this a square loses digits to the denormals.
constexpr double kSquareMin = 0x1p-400;

/// The power of two that takes the largest component near 1; 2^1000 at most.
double Enlarging(const Eigen::Vector3d& v) {
  const double largest = v.cwiseAbs().maxCoeff();
  return largest > 0 ? std::ldexp(1.0, std::min(1000, -std::ilogb(largest))) : 1;
}

/// The time at which the centres are nearest, approximately.
double NearestTime(const Choice& choice, double duration) {
  const Eigen::Vector3d d0 = choice.ball.anchor.middle(), w = choice.ball.velocity.middle();
  if (w.isZero(0)) return 0;
  if (w.cwiseAbs().maxCoeff() >= kSquareMin) {
    return std::clamp(-d0.dot(w) / w.squaredNorm(), 0.0, duration);
  }
  const double of_d0 = Enlarging(d0), of_w = Enlarging(w);
  const Eigen::Vector3d along = of_w * w;
  const double time = -(of_d0 * d0).dot(along) / along.squaredNorm() * (of_w / of_d0);
  return std::clamp(time, 0.0, duration);
}

/// The same where the path bends: the nearest of a few instants, and then nearer ones.
double NearestTimeOfBent(const Choice& choice, double duration) {
  constexpr int kInstants = 16, kHalvings = 40;
  const Eigen::Vector3d d = choice.ball.anchor.middle(), w = choice.ball.velocity.middle();
  const Eigen::Vector3d h = choice.ball.bend.middle();
  const auto distance = [&](double t) { return (d + t * (w + t * h)).norm(); };
  double best = 0, least = distance(0);
  const auto try_at = [&](double t) {
    if (t < 0 || t > duration) return;
    const double found = distance(t);
    if (found < least) best = t, least = found;
  };
  for (int i = 1; i <= kInstants; ++i) try_at(duration * i / kInstants);
  double apart = 0.5 * duration / kInstants;
  for (int i = 0; i < kHalvings; ++i, apart *= 0.5) {
    const double middle = best;
    try_at(middle - apart);
    try_at(middle + apart);
  }
  return best;
}

/// Where the depth is greatest, or any time at which touching is certified.
double DeepestTime(const Choice& choice, double duration) {
  constexpr double kGolden = 0.6180339887498949;
  double low = 0, high = duration;
  double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
  double depth_left = choice.Depth(left).lower, depth_right = choice.Depth(right).lower;
  for (int i = 0; i < kSearchSteps; ++i) {
    if (depth_left >= 0) return left;
    if (depth_right >= 0) return right;
    if (depth_left < depth_right) {
      low = left, left = right, depth_left = depth_right;
      right = low + kGolden * (high - low);
      depth_right = choice.Depth(right).lower;
    } else {
      high = right, right = left, depth_right = depth_left;
      left = high - kGolden * (high - low);
      depth_left = choice.Depth(left).lower;
    }
  }
  return 0.5 * (low + high);
}

/// Whether contact is certified on all of [from, to], where it is at both ends.
///
/// A straight path makes the depth concave, and the ends are enough. A path d + w t + h t² leaves
/// the chord between two of its points, T apart, by |h| (t − from)(to − t) at most; along the chord
/// the depth is concave. With A and B the depths at the ends and λ the share of the way it is thus
/// at least (1 − λ) A + λ B − |h| T² λ (1 − λ), which is >= 0 for all λ if √A + √B >= √|h| T. Else
/// the halves are asked.
bool HoldsBetween(const Choice& choice, double from, double to) {
  if (!choice.ball.bends) return true;
  struct Part {
    double from, to;
  };
  const numeric::Interval root_of_bend = Sqrt(numeric::Norm(choice.ball.bend));
  const auto root_of_depth = [&choice](double delta) {
    return Sqrt(numeric::Interval(std::max(0.0, choice.Depth(delta).lower)));
  };
  std::vector<Part> parts = {{from, to}};
  for (int asked = 0; asked < kPartsAsked; ++asked) {
    if (parts.empty()) return true;
    const Part part = parts.back();
    parts.pop_back();
    const numeric::Interval needed =
        root_of_bend * (numeric::Interval(part.to) - numeric::Interval(part.from));
    if ((root_of_depth(part.from) + root_of_depth(part.to) - needed).lower >= 0) continue;
    const double middle = part.from + 0.5 * (part.to - part.from);
    if (choice.Depth(middle).lower < 0) return false;
    parts.push_back({part.from, middle});
    parts.push_back({middle, part.to});
  }
  return false;
}

Contact ContactOf(const Choice& choice, double duration) {
  const bool at_start = choice.Depth(0).lower >= 0, at_end = choice.Depth(duration).lower >= 0;
  double inside = at_start            ? 0
                  : at_end            ? duration
                  : choice.ball.bends ? NearestTimeOfBent(choice, duration)
                                      : NearestTime(choice, duration);
  if (choice.Depth(inside).lower < 0) {
    if (choice.Distance(inside).lower > choice.ball.radius.upper) return {};
    inside = DeepestTime(choice, duration);
    if (choice.Depth(inside).lower < 0) return {};
  }
  const double resolution = kResolution * duration;
  Contact contact{at_start ? 0 : LastCertified(choice, inside, 0, resolution),
                  at_end ? duration : LastCertified(choice, inside, duration, resolution)};
  contact.continuous = HoldsBetween(choice, contact.from, contact.to);
  return contact;
}

void FindContact(const std::vector<Choice>& choices, double duration, SegmentResult& result) {
  std::vector<Contact> contacts;
  for (const Choice& choice : choices) {
    const Contact contact = ContactOf(choice, duration);
    if (contact.from > contact.to) continue;
    if (contact.continuous) {
      contacts.push_back(contact);
    } else {
      contacts.push_back({contact.from, contact.from});
      contacts.push_back({contact.to, contact.to});
    }
  }
  if (contacts.empty()) return;
  std::sort(contacts.begin(), contacts.end(),
            [](const Contact& a, const Contact& b) { return a.from < b.from; });
  result.contact_from = contacts.front().from;
  result.contact_to = contacts.front().to;
  for (const Contact& contact : contacts) {
    if (contact.from > result.contact_to) result.contact_continuous = false;
    result.contact_to = std::max(result.contact_to, contact.to);
  }
}

/// From one end of the segment: how far towards the other the two stay apart. The end itself is the
/// answer if they may touch there at once; ±infinity if they are apart on all of it, both ends
/// included. A choice that is certified free from where another gave up carries on from there.
double FreeFrom(const std::vector<Choice>& choices, double duration, TimeDirection direction) {
  const bool backward = direction == TimeDirection::kBackward;
  double at = backward ? duration : 0;
  for (int round = 0; round < kRoundsMax; ++round) {
    double step = 0;
    for (const Choice& choice : choices) {
      const numeric::MovingBall& ball = choice.ball;
      const numeric::IntervalVector velocity = ball.VelocityAt(at);
      numeric::MovingBall difference{ball.anchor, ball.PathTo(at),
                                     backward ? numeric::Interval(-1) * velocity : velocity, 0,
                                     From(ball.reach(), at, direction)};
      difference.bends = ball.bends, difference.bend = ball.bend;
      step =
          std::max(step, FirstApproach(difference, backward ? at : numeric::AddUp(duration, -at)));
    }
    if (step == numeric::kInfinity) return backward ? -numeric::kInfinity : numeric::kInfinity;
    at = backward ? numeric::AddUp(at, -step) : numeric::AddDown(at, step);
    if (step <= kResolution * duration) break;
  }
  // A part that certifies the far end says so by infinity.
  return backward ? std::max(at, 0.0) : std::min(at, numeric::NextDown(duration));
}

/// The greatest that |Δc| can be, and u, at both ends of a segment; in plain doubles.
struct Ends {
  double distance[2];
  double u_least[2], u_greatest[2];
  double magnitude = 0;  ///< All terms added up, without their signs.
};

Ends EndsOf(const numeric::MovingBall& a, const numeric::MovingBall& b, double duration) {
  Ends ends;
  double square[2] = {};
  const auto axis = [&](numeric::Interval a_c, numeric::Interval b_c, numeric::Interval a_v,
                        numeric::Interval b_v) {
    const double low = b_c.lower - a_c.upper, high = b_c.upper - a_c.lower;
    const double w_low = b_v.lower - a_v.upper, w_high = b_v.upper - a_v.lower;
    const double first = std::max(std::abs(low), std::abs(high));
    const double last =
        std::max(std::abs(low + duration * w_low), std::abs(high + duration * w_high));
    square[0] += first * first, square[1] += last * last;
    ends.magnitude += first + duration * std::max(std::abs(w_low), std::abs(w_high));
  };
  const numeric::IntervalVector centre_A = a.centre(), centre_B = b.centre();
  axis(centre_A.x, centre_B.x, a.velocity.x, b.velocity.x);
  axis(centre_A.y, centre_B.y, a.velocity.y, b.velocity.y);
  axis(centre_A.z, centre_B.z, a.velocity.z, b.velocity.z);
  const auto u = [&](double u0, double u1, double u2, double* at) {
    at[0] = u0, at[1] = u0 + duration * (u1 + duration * u2);
    ends.magnitude += std::abs(u0) + duration * (std::abs(u1) + duration * std::abs(u2));
  };
  u(a.u.c0.lower + b.u.c0.lower, a.u.c1.lower + b.u.c1.lower, a.u.c2.lower + b.u.c2.lower,
    ends.u_least);
  u(a.u.c0.upper + b.u.c0.upper, a.u.c1.upper + b.u.c1.upper, a.u.c2.upper + b.u.c2.upper,
    ends.u_greatest);
  for (int end = 0; end < 2; ++end) ends.distance[end] = std::sqrt(square[end]);
  return ends;
}

}  // namespace

// The margin covers what is lost here and what the intervals of EvaluateBallSegment() are wider
// than the truth: fewer than 32 operations each, none of them off by more than 2^-51 of the sum of
// all terms.
//
// With it, (1) Depth().lower >= 0 at both ends for one choice, so that ContactOf() gives it all of
// the segment, and so does the union; (2) |Δc| <= r + u at both ends for every choice, so that the
// gap of FirstApproach(), an interval around (n·Δc)/|n| − (r + u) <= 0, is not positive, and its
// step is 0.
std::optional<SegmentResult> QuickBallContact(const BallSegment& a, const BallSegment& b,
                                              double duration) {
  constexpr double kMargin = 0x1p-40;
  // Products of such neither overflow nor lose their error.
  constexpr double kLargest = 0x1p+400, kSmallest = 0x1p-400;
  if (!(duration > 0)) return std::nullopt;
  for (const BallSegment* of : {&a, &b}) {
    for (const numeric::MovingBall& ball : of->bounds) {
      if (ball.bends || ball.u.c3.upper > 0 || ball.u.c3.lower < 0) return std::nullopt;
    }
  }
  const double radii = a.radius + b.radius;
  bool touches = false;
  for (const numeric::MovingBall& ball_a : a.bounds) {
    for (const numeric::MovingBall& ball_b : b.bounds) {
      const Ends ends = EndsOf(ball_a, ball_b, duration);
      const double sum = radii + ends.magnitude;
      if (!(sum > kSmallest && sum < kLargest)) return std::nullopt;
      const double margin = kMargin * sum;
      bool reach = true, touch = true;
      for (int end = 0; end < 2; ++end) {
        reach = reach && ends.distance[end] + margin <= radii + ends.u_least[end];
        touch = touch && ends.distance[end] + margin <= radii - ends.u_greatest[end];
      }
      if (!reach) return std::nullopt;
      touches = touches || touch;
    }
  }
  if (!touches) return std::nullopt;
  SegmentResult result;
  result.free_until = 0;
  result.contact_from = 0;
  result.contact_to = result.free_from = duration;
  return result;
}

SegmentResult EvaluateBallSegment(const BallSegment& a, const BallSegment& b, double duration) {
  const std::vector<Choice> choices = ChoicesOf(a, b);
  SegmentResult result;
  FindContact(choices, duration, result);
  result.free_until = FreeFrom(choices, duration, TimeDirection::kForward);
  result.free_from = FreeFrom(choices, duration, TimeDirection::kBackward);
  return result;
}

SeparationAt EvaluateBallsAt(const BallSegment& a, const BallSegment& b, double delta) {
  SeparationAt at{
      {-numeric::kInfinity, numeric::kInfinity}, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  at.error_A = at.error_B = numeric::kInfinity;
  for (const Choice& choice : ChoicesOf(a, b)) {
    const numeric::Interval distance = choice.Distance(delta) - choice.ball.radius,
                            u = choice.ball.u.At(delta);
    at.separation.lower = std::max(at.separation.lower, (distance - u).lower);
    at.separation.upper = std::min(at.separation.upper, (distance + u).upper);
  }
  const auto locate = [delta](const BallSegment& ball, Eigen::Vector3d& p, double& error) {
    for (const numeric::MovingBall& bound : ball.bounds) {
      const numeric::IntervalVector centre = bound.centre() + bound.PathTo(delta);
      const Eigen::Vector3d middle = centre.middle();
      const double off =
          (bound.u.At(delta) + numeric::Norm(centre - numeric::IntervalVector(middle))).upper;
      if (off < error) p = middle, error = off;
    }
  };
  locate(a, at.p_WA, at.error_A);
  locate(b, at.p_WB, at.error_B);
  return at;
}

}  // namespace collision::narrow_phase
