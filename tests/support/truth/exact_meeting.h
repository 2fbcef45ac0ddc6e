// When two agents can first meet, by exact arithmetic: the oracle of the canonical pair routine.
// Written from the definitions in collision_core/motion and not from the code. Of the code it takes
// one thing: to which nanosecond a speed cap's take-over is rounded (speed_cap.h allows any
// instant; speed_cap_test.cc checks that it is the right one).
//
// Time is x, nanoseconds after the base instant, lengths are multiplied by 6e27, so that every
// coefficient is an integer times a power of two, a sixth of a jerk too. Three numbers may be
// irrational, |v| κ, |a| (κ + ½ h) and a direction's √(d_y² + d_z²) / |d|: they are rounded at
// 2^-300, outward where freedom is proved and inward where a meeting is.
#pragma once

#include <array>

#include "collision_core/motion/speed_cap.h"
#include "tests/support/truth/exact_polynomial.h"

namespace collision {

class ExactMeeting {
 public:
  /// How the irrational numbers are rounded, and what is added to the reaches for rounding: `share`
  /// of all that they are compared with.
  struct Options {
    bool up = true;
    double share = 0;
  };

  ExactMeeting(const motion::SpaceTimeBound& a, const motion::SpaceTimeBound& b, Instant base,
               Options options)
      : a_(a, base, options.up), b_(b, base, options.up), share_(options.share) {
    for (int i = 0; i < 3; ++i) {
      between_[i] = Metres(Dyadic(b.state.p_WA[i]) - Dyadic(a.state.p_WA[i]));
      magnitude_ =
          magnitude_ + DyadicPolynomial{between_[i].Magnitude()} + a_.MagnitudesAt0(i) +
          b_.MagnitudesAt0(i) +
          DyadicPolynomial{
              {}, (b_.Slope(i) - a_.Slope(i)).Magnitude(), (b_.Bend(i) - a_.Bend(i)).Magnitude()};
    }
    radii_ = Metres(Dyadic(a.limits.radius) + Dyadic(b.limits.radius));
    AddBallTests();
    if (BoxesSayMore(a) || BoxesSayMore(b)) MakeBoxes(a, b, base);
  }

  /// Is it proved that they cannot meet in [0, x), or ever? (That is so if one test keeps them
  /// apart all the time: the latest of their answers counts.)
  bool FreeBefore(const std::optional<Dyadic>& x, ProofCounts* counts) const {
    for (const Timeline& balls : ball_tests_) {
      if (Positive(balls, x, counts)) return true;
    }
    return has_boxes_ && !BoxesMeet(x, false);
  }

  /// Have all tests met in [0, x]?
  bool MetBy(const Dyadic& x) const {
    ProofCounts counts;
    for (const Timeline& balls : ball_tests_) {
      if (At(balls, x).Sign() > 0 && Positive(balls, x, &counts)) return false;
    }
    return !has_boxes_ || BoxesMeet(x, true);
  }

  /// Seconds as x.
  static Dyadic Nanoseconds(double seconds) { return kNano() * Dyadic(seconds); }
  static Dyadic Between(Instant from, Instant to) {
    return Dyadic::Integer(to.nanoseconds()) - Dyadic::Integer(from.nanoseconds());
  }

 private:
  struct Piece {
    Dyadic start;
    DyadicPolynomial value;
  };
  using Timeline = std::vector<Piece>;  ///< From 0 on, in order.

  static Dyadic kNano() { return Dyadic::Integer(1'000'000'000); }

  /// Lengths, speeds, accelerations and jerks in the units of this file.
  static Dyadic Jerk(const Dyadic& x) { return Dyadic::Integer(6) * x; }
  static Dyadic Acceleration(const Dyadic& x) { return kNano() * Jerk(x); }
  static Dyadic Speed(const Dyadic& x) { return kNano() * Acceleration(x); }
  static Dyadic Metres(const Dyadic& x) { return kNano() * Speed(x); }

  /// A ball about p_WA + line(x) of radius r + u(x), or a face; from `start` on.
  struct Reach {
    Dyadic start;
    std::array<DyadicPolynomial, 3> line;
    DyadicPolynomial u;
  };

  struct Agent {
    const motion::SpaceTimeBound& bound;
    Instant base;
    bool up;
    Dyadic since;  ///< From the stamp to the base [ns].
    DyadicPolynomial errors, deviation;

    Agent(const motion::SpaceTimeBound& of, Instant from, bool round_up)
        : bound(of), base(from), up(round_up), since(Between(of.state.stamp, from)) {
      const Dyadic skew = kNano() * Dyadic(bound.skew);
      const Dyadic step = kNano() * Dyadic(bound.limits.time_step);
      const DyadicPolynomial sigma = {since + skew, 1.0};
      DyadicPolynomial longer = sigma;
      longer[0] = longer[0] + step;
      deviation = Acceleration(bound.limits.acceleration_max).Scaled(-1) * (sigma * longer);
      if (bound.limits.jerk_max > 0) {
        DyadicPolynomial cube = longer * (longer * longer);
        cube[0] = cube[0] - step * step * step;
        deviation = deviation + Dyadic(bound.limits.jerk_max) * cube;
      }
      errors = Speed(bound.state.velocity_error) * sigma;
      errors[0] = errors[0] + Metres(bound.state.position_error);
      if (bound.skew > 0) errors[0] = errors[0] + Speed(skew * Length(bound.state.v_WA));
      if (!bound.state.a_WA.isZero(0)) {
        const Dyadic rate = Acceleration(Length(bound.state.a_WA)) * (skew + step.Scaled(-1));
        errors = errors + rate * sigma;
      }
    }

    Dyadic Length(const Eigen::Vector3d& v) const {
      Dyadic square;
      for (int i = 0; i < 3; ++i) square = square + Dyadic(v[i]) * Dyadic(v[i]);
      return Dyadic::Root(square, up);
    }

    /// The centre's coefficients in x, from p_WA.
    Dyadic Bend(int i) const { return Acceleration(bound.state.a_WA[i]).Scaled(-1); }
    Dyadic Slope(int i) const {
      return Speed(bound.state.v_WA[i]) + Acceleration(bound.state.a_WA[i]) * since;
    }
    Dyadic LineAt0(int i) const { return (Speed(bound.state.v_WA[i]) + Bend(i) * since) * since; }
    /// Of the terms whose sums those are: what rounding is relative to.
    DyadicPolynomial MagnitudesAt0(int i) const {
      const Dyadic faster = (Acceleration(bound.state.a_WA[i]) * since).Magnitude();
      const Dyadic bent = (Bend(i) * since * since).Magnitude();
      return {(Speed(bound.state.v_WA[i]) * since).Magnitude() + bent, faster};
    }

    /// V' = V + ½ (M + |a|) h, a nanosecond's worth of it; with a jerk V, or with steps 2 V.
    Dyadic CapSlope() const {
      const motion::MotionLimits& d = bound.limits;
      if (d.jerk_max > 0) return Speed(d.speed_max).Scaled(d.time_step > 0 ? 1 : 0);
      Dyadic fastest = d.acceleration_max;
      if (!bound.state.a_WA.isZero(0)) fastest = fastest + Length(bound.state.a_WA);
      return Speed(Dyadic(d.speed_max) + (fastest * Dyadic(d.time_step)).Scaled(-1));
    }

    /// u, frozen at x = from, growing with the cap.
    DyadicPolynomial Capped(const DyadicPolynomial& u, const Dyadic& from) const {
      return {ValueAt(u, from) - CapSlope() * from, CapSlope()};
    }

    std::vector<Reach> Balls() const {
      Reach horn{{}, {}, errors + deviation};
      for (int i = 0; i < 3; ++i) horn.line[i] = {LineAt0(i), Slope(i), Bend(i)};
      if (!HasSpeedCap(bound.limits)) return {horn};
      const Instant takes_over = CapStartOf(bound);
      if (takes_over.is_never()) return {horn};
      const Dyadic from = Between(base, takes_over);
      Reach cap{from.Sign() < 0 ? Dyadic() : from, {}, Capped(horn.u, from)};
      for (int i = 0; i < 3; ++i) cap.line[i] = {ValueAt(horn.line[i], from)};
      return {horn, cap};
    }

    /// √(other components) / |d| of a direction that points away from the face, else 1.
    Dyadic Fraction(int axis, int sign, bool holds) const {
      const Eigen::Vector3d& d = bound.state.direction;
      if (!holds || sign * d[axis] >= 0) return 1.0;
      const auto square = [&d](int i) { return Dyadic(d[i]) * Dyadic(d[i]); };
      const Dyadic across = square((axis + 1) % 3) + square((axis + 2) % 3);
      return Dyadic::Root(Dyadic::Quotient(across, across + square(axis), up), up);
    }

    /// A face with its line along the normal in `line[0]`.
    std::vector<Reach> Face(int axis, int sign, bool holds) const {
      const Dyadic along = Dyadic::Integer(sign);
      Reach horn{{}, {}, errors + Fraction(axis, sign, holds) * deviation};
      horn.line[0] = {along * LineAt0(axis), along * Slope(axis), along * Bend(axis)};
      if (!HasSpeedCap(bound.limits)) return {horn};
      const motion::DirectionalReach reach =
          holds ? ReachOfDirection(bound.state) : motion::DirectionalReach();
      const Instant takes_over = FaceCapStartOf(
          bound, {axis, sign}, (sign > 0 ? reach.upward : reach.downward)[axis].upper);
      if (takes_over.is_never()) return {horn};
      const Dyadic from = Between(base, takes_over);
      Reach cap{from.Sign() < 0 ? Dyadic() : from, {}, Capped(horn.u, from)};
      cap.line[0] = {ValueAt(horn.line[0], from)};
      return {horn, cap};
    }

    /// When the direction ends [ns]: no value, never; below zero, before the base, or not declared.
    std::optional<Dyadic> DirectionEnd() const {
      if (bound.state.direction.isZero(0)) return Dyadic(-1.0);
      if (bound.state.direction_until.is_never()) return std::nullopt;
      return Between(base, bound.state.direction_until) - kNano() * Dyadic(bound.skew);
    }
  };

  static bool BoxesSayMore(const motion::SpaceTimeBound& bound) {
    return !bound.state.direction.isZero(0) || HasSpeedCap(bound.limits);
  }

  DyadicPolynomial Inflated(const DyadicPolynomial& reach) const {
    return reach + Dyadic(share_) * (reach + magnitude_);
  }

  /// Combines the pieces of two reaches.
  template <typename Value>
  static Timeline Combine(const std::vector<Reach>& a, const std::vector<Reach>& b, Value value) {
    Timeline timeline;
    for (const Reach& of_a : a) {
      for (const Reach& of_b : b) {
        // Two pieces share the time from the later start to the earlier of their ends.
        const Dyadic start = std::max(of_a.start, of_b.start);
        const bool a_ended = a.size() > 1 && &of_a == &a[0] && a[1].start <= start;
        const bool b_ended = b.size() > 1 && &of_b == &b[0] && b[1].start <= start;
        if (!a_ended && !b_ended) timeline.push_back({start, value(of_a, of_b)});
      }
    }
    std::sort(timeline.begin(), timeline.end(),
              [](const Piece& x, const Piece& y) { return x.start < y.start; });
    return timeline;
  }

  /// |d|² − S² of every choice of horn or capped ball.
  void AddBallTests() {
    const auto gap = [this](const Reach& a, const Reach& b) {
      DyadicPolynomial distance;
      for (int i = 0; i < 3; ++i) {
        const DyadicPolynomial d =
            DyadicPolynomial{between_[i]} + (b.line[i] + Dyadic(-1.0) * a.line[i]);
        distance = distance + d * d;
      }
      const DyadicPolynomial reach = Inflated(DyadicPolynomial{radii_} + (a.u + b.u));
      return distance + Dyadic(-1.0) * (reach * reach);
    };
    std::vector<std::vector<Reach>> of_A = {a_.Balls()}, of_B = {b_.Balls()};
    for (auto* of : {&of_A, &of_B}) {
      if (of->front().size() > 1) of->push_back({of->front().front()});
    }
    for (const auto& a : of_A) {
      for (const auto& b : of_B) ball_tests_.push_back(Combine(a, b, gap));
    }
  }

  static constexpr int kDepthOfProof = 80, kDepthOfMeeting = 40;

  struct BoxTests {
    Dyadic start;
    std::vector<Timeline> conditions;  ///< All must be >= 0.
  };

  void MakeBoxes(const motion::SpaceTimeBound&, const motion::SpaceTimeBound&, Instant) {
    has_boxes_ = true;
    std::vector<Dyadic> starts = {Dyadic()};
    for (const Agent* agent : {&a_, &b_}) {
      const std::optional<Dyadic> end = agent->DirectionEnd();
      if (end && end->Sign() > 0) starts.push_back(*end);
    }
    std::sort(starts.begin(), starts.end());
    for (const Dyadic& start : starts) {
      const auto holds = [&start](const Agent& agent) {
        const std::optional<Dyadic> end = agent.DirectionEnd();
        return !end || start < *end;
      };
      BoxTests tests{start, {}};
      for (int axis = 0; axis < 3; ++axis) {
        for (const int sign : {1, -1}) {
          const auto value = [&](const Reach& a, const Reach& b) {
            return Inflated(DyadicPolynomial{radii_} + (a.u + b.u)) + a.line[0] + b.line[0] +
                   DyadicPolynomial{sign > 0 ? -between_[axis] : between_[axis], {}, {}};
          };
          tests.conditions.push_back(
              Combine(a_.Face(axis, sign, holds(a_)), b_.Face(axis, -sign, holds(b_)), value));
        }
      }
      boxes_.push_back(std::move(tests));
    }
  }

  static const DyadicPolynomial& PieceAt(const Timeline& timeline, const Dyadic& x) {
    std::size_t i = 0;
    while (i + 1 < timeline.size() && timeline[i + 1].start <= x) ++i;
    return timeline[i].value;
  }

  static Dyadic At(const Timeline& timeline, const Dyadic& x) {
    return ValueAt(PieceAt(timeline, x), x);
  }

  static bool Positive(const Timeline& timeline, const std::optional<Dyadic>& x,
                       ProofCounts* counts) {
    for (std::size_t i = 0; i < timeline.size(); ++i) {
      std::optional<Dyadic> end = x;
      if (i + 1 < timeline.size() && (!end || timeline[i + 1].start < *end)) {
        end = timeline[i + 1].start;
      }
      if (!IsPositive(timeline[i].value, timeline[i].start, end, counts)) return false;
    }
    return true;
  }

  /// Do the boxes overlap anywhere in [0, x), or [0, x] if so asked?
  bool BoxesMeet(const std::optional<Dyadic>& x, bool closed) const {
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      std::vector<Dyadic> starts = {boxes_[i].start};
      for (const Timeline& condition : boxes_[i].conditions) {
        for (const Piece& piece : condition) {
          if (boxes_[i].start < piece.start) starts.push_back(piece.start);
        }
      }
      std::sort(starts.begin(), starts.end());
      for (std::size_t k = 0; k < starts.size(); ++k) {
        const Dyadic& start = starts[k];
        if (x && (*x < start || (!closed && *x <= start))) continue;
        std::optional<Dyadic> next;
        if (i + 1 < boxes_.size()) next = boxes_[i + 1].start;
        if (k + 1 < starts.size() && (!next || starts[k + 1] < *next)) next = starts[k + 1];
        if (next && *next <= start) continue;
        const bool x_counts = closed && x && (!next || *x < *next);
        const std::optional<Dyadic> end = !next || (x && *x < *next) ? x : next;
        std::vector<DyadicPolynomial> conditions;
        for (const Timeline& condition : boxes_[i].conditions) {
          conditions.push_back(PieceAt(condition, start));
        }
        if (MeetWithin(conditions, start, end, x_counts)) return true;
      }
    }
    return false;
  }

  /// Are all conditions >= 0 somewhere in [lo, hi), or [lo, hi]? If so then first at lo or at a
  /// root of one of them. With cubics: is it not proved that they are not? A closed stretch, where
  /// a meeting is to be shown, is halved less often: what misses by 2^-kDepthOfMeeting counts as
  /// one.
  static bool MeetWithin(const std::vector<DyadicPolynomial>& conditions, const Dyadic& lo,
                         const std::optional<Dyadic>& hi, bool closed) {
    const auto all_at = [&conditions](const Dyadic& x) {
      return std::all_of(conditions.begin(), conditions.end(),
                         [&x](const DyadicPolynomial& q) { return ValueAt(q, x).Sign() >= 0; });
    };
    if (all_at(lo) || (closed && all_at(*hi))) return true;
    const bool cubic = std::any_of(conditions.begin(), conditions.end(),
                                   [](const DyadicPolynomial& q) { return q[3].Sign() != 0; });
    if (cubic && !hi) return !OneIsNegativeFrom(conditions, lo);
    if (cubic) return !OneIsNegative(conditions, lo, *hi, closed ? kDepthOfMeeting : kDepthOfProof);
    for (const DyadicPolynomial& q : conditions) {
      for (const QuadraticRoot& root : RootsOf(q)) {
        if (root.SignOf({-lo, 1.0, {}}) <= 0) continue;
        if (hi && root.SignOf({-*hi, 1.0, {}}) >= 0) continue;
        if (std::all_of(conditions.begin(), conditions.end(), [&](const DyadicPolynomial& other) {
              return &other == &q || root.SignOf(other) >= 0;
            })) {
          return true;
        }
      }
    }
    return false;
  }

  Agent a_, b_;
  double share_;
  std::array<Dyadic, 3> between_;
  DyadicPolynomial magnitude_;
  Dyadic radii_;
  std::vector<Timeline> ball_tests_;
  bool has_boxes_ = false;
  std::vector<BoxTests> boxes_;
};

}  // namespace collision
