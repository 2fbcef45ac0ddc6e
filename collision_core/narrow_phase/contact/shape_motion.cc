#include "collision_core/narrow_phase/contact/shape_motion.h"

#include <algorithm>

#include "collision_core/base/check.h"
#include "collision_core/narrow_phase/advancement/swept_ring.h"
#include "collision_core/narrow_phase/penetration/separating_translation.h"
#include "collision_core/narrow_phase/separation/containment.h"
#include "collision_core/narrow_phase/separation/separation.h"
#include "collision_core/numeric/allowances.h"

namespace collision::narrow_phase {

/// With h the seconds from the instant on: the prediction moves any two points relative to each
/// other by at most speed h, where translation alone does by along h and turning by spin h (the
/// faster of the two bodies); the uncertainty of translation is u(h), that of turning moves a point
/// by at most turned c1 h + c2 h² more than at the instant.
struct ShapeMotion::Drift {
  numeric::Interval along;
  numeric::Interval bend;  ///< Of the centres' path: it leaves its tangent by bend h².
  numeric::Interval spin_sum, spin_most;
  numeric::Cubic translation;
  numeric::Interval turned1_sum, turned2_sum, turned1_most, turned2_most;
};

/// Where a sweep begins, and by what a point's path is replaced: by its tangent, which turning
/// bends it away from, or by everything that it sweeps in full turns.
struct ShapeMotion::Departure {
  enum class Path { kTangent, kFullTurns };
  double at;
  double span;  ///< How far it goes [s].
  TimeDirection direction;
  Path path;
};

namespace {

/// |ω| R, and the growth of θ R; the chord 2 sin(θ/2) grows no faster than θ, but shrinks slower.
struct Turning {
  numeric::Interval spin, turned1, turned2;
};

Turning TurningOf(const BodySegment& body, std::size_t bound, double at, TimeDirection direction) {
  if (!body.shape) return {0, 0, 0};
  const motion::MovingRotation& turn = body.turns[bound];
  const numeric::Cubic angle = From(turn.angle_error, at, direction);
  const numeric::Interval reach = TurningReachOf(body);
  return {reach * numeric::Norm(numeric::IntervalVector(turn.w_WB)),
          reach * numeric::Max(0, angle.c1), reach * angle.c2};
}

// The tangent's deviation ½ |ω|² h² belongs to what turning may move a point by.
SweptPose::Growth GrowthOf(const motion::MovingRotation& turn, const ShapeMotion::Departure& from,
                           double chord) {
  const numeric::Cubic angle = From(turn.angle_error, from.at, from.direction);
  const bool bends = from.path == ShapeMotion::Departure::Path::kTangent;
  const numeric::Interval bend =
      bends ? numeric::Interval(0.5) *
                  numeric::Square(numeric::Norm(numeric::IntervalVector(turn.w_WB)))
            : numeric::Interval(0);
  return {chord, std::max(0.0, angle.c1.upper),
          std::max(0.0, (numeric::Max(0, angle.c2) + bend).upper)};
}

// What the path of B's centre, seen from A's, leaves its tangent by: this times h² [m/s²].
numeric::Interval BendOf(const numeric::MovingBall& a, const numeric::MovingBall& b) {
  return a.bends || b.bends ? numeric::Norm(b.bend - a.bend) : numeric::Interval(0);
}

// Half of the acceleration of the point that turning moves the most [m/s²].
double BendOf(const BodySegment& body, std::size_t bound) {
  return body.shape ? 0.5 * body.turns[bound].w_WB.squaredNorm() * TurningReachOf(body) : 0;
}

// What tangents leave their circles by matters beyond this share of the bodies' size.
constexpr double kFineBend = 1e-6;

// Within so small a turn [rad] a tangent leaves its circle by 3 % of the radius.
constexpr double kTurnOfSweep = 0.25;

// Relative to a velocity that a matrix turns: three products and two sums of 2^-53 each in three
// coordinates, for each of three vectors; below 27 · 2^-53, and as much again.
constexpr double kTurnRounding = 0x1p-47;

// Over more than this turn [rad] it is worth asking what a body sweeps in all its turns.
constexpr double kTurnToRevolve = 6;

// A body that turns so many times more slowly than the other.
constexpr double kMuchSlower = 8;

// Nearer to the middle of a segment than this share of it is the middle.
constexpr double kNearMiddle = 1e-6;

// Parts of two bodies that nearly touch may touch first where they are nearer to each other than
// this share of the bodies' size plus so many times the uncertainty of the motion.
constexpr double kPatchReach = 1e-9;
constexpr double kPatchBeyond = 2;

}  // namespace

ShapeMotion::ShapeMotion(const BodySegment& a, const BodySegment& b, WorkBudget* work)
    : a_(a), b_(b), surface_a_(a), surface_b_(b), work_(*work) {
  CORE_CHECK(!a.awaited && !b.awaited, "the shapes of both bodies are known");
}

ShapeMotion::PoseQuery ShapeMotion::PoseQueryAt(double at) const {
  PoseQuery query;
  query.at = at;
  query.choice = BestBounds(a_, b_, at);
  if (!query.choice.certain) return query;
  work_.Spend(kPoseUnits);
  query.pose = PoseAt(a_, b_, query.choice, at);
  query.uncertainty = numeric::AddUp(
      query.pose.translation,
      numeric::AddUp(numeric::MultiplyUp(query.pose.chord_A, surface_a_.turning_reach()),
                     numeric::MultiplyUp(query.pose.chord_B, surface_b_.turning_reach())));
  return query;
}

ShapeMotion::PoseQuery ShapeMotion::QuerySeparation(double at, Goal goal,
                                                    const ContactWitness& hint) const {
  PoseQuery query = PoseQueryAt(at);
  if (!query.choice.certain) return query;
  query.bracket = collision::narrow_phase::QuerySeparation({surface_a_, surface_b_, query.pose},
                                                           goal, &work_, hint);
  return query;
}

ShapeMotion::PoseQuery ShapeMotion::RecheckWitness(double at, const ContactWitness& witness) const {
  PoseQuery query = PoseQueryAt(at);
  if (!query.choice.certain) return query;
  query.bracket = collision::narrow_phase::RecheckWitness({surface_a_, surface_b_, query.pose},
                                                          witness, &work_);
  return query;
}

ShapeMotion::PoseQuery ShapeMotion::QuerySeparation(double at,
                                                    const ContactCandidate& candidate) const {
  if (candidate.is_pair()) return RecheckWitness(at, candidate.pair);
  PoseQuery query = PoseQueryAt(at);
  if (!query.choice.certain) return query;
  query.bracket.upper = UpperBy(candidate.point, {surface_a_, surface_b_, query.pose}, &work_);
  return query;
}

std::vector<ContactCandidate> ShapeMotion::CandidatesAt(double at, const ImpactBound& touch) const {
  const PoseQuery query = PoseQueryAt(at);
  if (!query.choice.certain) return {};
  const double size = surface_a_.reach() + surface_b_.reach();
  const double within = kPatchReach * size + kPatchBeyond * query.uncertainty;
  return FindContactCandidates({surface_a_, surface_b_, query.pose}, within, touch.leaves, &work_);
}

double ShapeMotion::DepthAtMost(const PoseQuery& query) const {
  const double shift =
      SeparatingTranslation({surface_a_, surface_b_, query.pose}, query.bracket.witness, &work_);
  return numeric::AddUp(shift, query.pose.translation);
}

// The bounds that are the least uncertain half-way are taken for all of the span.
BoundChoice ShapeMotion::ChoiceFor(double at, double span, TimeDirection direction) const {
  const bool backward = direction == TimeDirection::kBackward;
  const double middle = backward ? at - 0.5 * span : at + 0.5 * span;
  return BestBounds(a_, b_, std::max(0.0, middle));
}

SweptPose ShapeMotion::SweptFrom(const Departure& from, BoundChoice choice) const {
  work_.Spend(kPoseUnits);
  SweptPose swept;
  swept.pose = PoseAt(a_, b_, choice, from.at);
  const numeric::MovingBall& ball_a = a_.ball.bounds[choice.of_a];
  const numeric::MovingBall& ball_b = b_.ball.bounds[choice.of_b];
  const numeric::IntervalVector velocity = ball_b.VelocityAt(from.at) - ball_a.VelocityAt(from.at);
  const double sign = from.direction == TimeDirection::kBackward ? -1 : 1;
  const auto seen = [&](const Eigen::Vector3d& v) {
    return Eigen::Vector3d(sign * swept.pose.R_WA.transpose() * v);
  };
  swept.velocity = seen(velocity.middle());
  if (a_.shape) swept.spin_A = seen(a_.turns[choice.of_a].w_WB);
  if (b_.shape) swept.spin_B = seen(b_.turns[choice.of_b].w_WB);
  // Each of the three is turned by a matrix that is off by matrix_error at most, and rounded.
  const numeric::Interval fastest = numeric::Norm(velocity) +
                                    TurningOf(a_, choice.of_a, from.at, from.direction).spin +
                                    TurningOf(b_, choice.of_b, from.at, from.direction).spin;
  swept.velocity_error =
      numeric::MultiplyUp(2 * swept.pose.matrix_error + kTurnRounding, fastest.upper);
  const numeric::Cubic u = From(ball_a.u + ball_b.u, from.at, from.direction);
  swept.translation = {u.c0.upper, u.c1.upper, std::max(0.0, u.c2.upper)};
  if (ball_a.bends || ball_b.bends || u.c3.upper > 0) {
    // Within the span a cube is at most the span times a square.
    const numeric::Interval cube = numeric::Interval(std::max(0.0, u.c3.upper)) * from.span;
    swept.translation.c2 = (swept.translation.c2 + cube + BendOf(ball_a, ball_b)).upper;
  }
  if (a_.shape) swept.turning_A = GrowthOf(a_.turns[choice.of_a], from, swept.pose.chord_A);
  if (b_.shape) swept.turning_B = GrowthOf(b_.turns[choice.of_b], from, swept.pose.chord_B);
  return swept;
}

ShapeMotion::Sweep ShapeMotion::SweepFrom(double at, double span, TimeDirection direction,
                                          const SweepDetail& detail) const {
  Sweep sweep;
  const BoundChoice choice = ChoiceFor(at, span, direction);
  if (!choice.certain) return sweep;
  sweep.known = true;
  const SweptPose swept = SweptFrom({at, span, direction, Departure::Path::kTangent}, choice);
  sweep.pose = swept.pose;
  sweep.touch = LowerBoundOfImpact({surface_a_, surface_b_, swept}, span, &work_, detail);
  if (sweep.touch.resolved) {
    const double h = sweep.touch.seconds;
    const double path = BendOf(a_.ball.bounds[choice.of_a], b_.ball.bounds[choice.of_b]).upper;
    const double bend = BendOf(a_, choice.of_a) + BendOf(b_, choice.of_b) + path;
    const double unknown =
        swept.translation.c0 + h * (swept.translation.c1 + h * (swept.translation.c2 - path));
    sweep.final =
        bend * h * h <= std::max(unknown, kFineBend * (surface_a_.reach() + surface_b_.reach()));
  }
  return sweep;
}

double ShapeMotion::SpanFrom(double at, double left, TimeDirection direction,
                             double duration) const {
  const double span = ToMiddle(at, left, direction, duration), rate = FastestTurn();
  return rate * span > kTurnOfSweep ? kTurnOfSweep / rate : span;
}

double ShapeMotion::ToMiddle(double at, double left, TimeDirection direction,
                             double duration) const {
  const double half = 0.5 * duration;
  const double to_middle = direction == TimeDirection::kBackward ? at - half : half - at;
  const bool two = a_.ball.bounds.size() > 1 || b_.ball.bounds.size() > 1;
  return two && to_middle > kNearMiddle * duration ? std::min(left, to_middle) : left;
}

double ShapeMotion::FastestTurn() const {
  double rate = 0;
  for (const BodySegment* body : {&a_, &b_}) {
    for (const motion::MovingRotation& turn : body->turns) rate = std::max(rate, turn.w_WB.norm());
  }
  return rate;
}

double ShapeMotion::RingFreedom(double at, double left, TimeDirection direction, double duration,
                                std::uint64_t units) const {
  const double span = ToMiddle(at, left, direction, duration);
  if (!(FastestTurn() * span > kTurnToRevolve)) return 0;
  const BoundChoice choice = ChoiceFor(at, span, direction);
  if (!choice.certain) return 0;
  const auto wanted = static_cast<double>(units), most = static_cast<double>(work_.left());
  const WorkShare share(wanted < most ? wanted / most : 1, &work_);
  SweptPose swept = SweptFrom({at, span, direction, Departure::Path::kFullTurns}, choice);
  double free = SweptRingBound({surface_a_, surface_b_, swept}, span, &work_);
  // A body that turns much more slowly than the other may be better taken for one that does not,
  // for a while: what its turning moves a point by counts as unknown.
  const double of_a = swept.spin_A.norm(), of_b = swept.spin_B.norm();
  const double slow = std::min(of_a, of_b), fast = std::max(of_a, of_b);
  if (free < span && slow > 0 && kMuchSlower * slow < fast) {
    (of_a < of_b ? swept.spin_A : swept.spin_B).setZero();
    (of_a < of_b ? swept.turning_A : swept.turning_B).c1 += slow * numeric::kManyRoundingsUp;
    const double some = std::min(span, kTurnOfSweep / slow);
    free = std::max(free,
                    std::min(some, SweptRingBound({surface_a_, surface_b_, swept}, some, &work_)));
  }
  if (free > span && span >= left) return numeric::kInfinity;
  return std::min(free, span);
}

void ShapeMotion::CheckContainment(PoseQuery* query) const {
  SeparationBracket& bracket = query->bracket;
  if (!query->apart()) return;
  const Containment nesting = TestContainment({surface_a_, surface_b_, query->pose}, &work_);
  query->neither_inside = nesting.neither;
  if (!nesting.certain() || bracket.upper <= -bracket.lower) return;
  bracket.upper = -bracket.lower;
  bracket.point = nesting.point;
  bracket.point_error = nesting.point_error;
}

bool ShapeMotion::NeitherInside(const RelativePose& pose) const {
  return TestContainment({surface_a_, surface_b_, pose}, &work_).neither;
}

ShapeMotion::Drift ShapeMotion::DriftFrom(const PoseQuery& query, TimeDirection direction) const {
  const numeric::MovingBall& ball_a = a_.ball.bounds[query.choice.of_a];
  const numeric::MovingBall& ball_b = b_.ball.bounds[query.choice.of_b];
  const Turning of_a = TurningOf(a_, query.choice.of_a, query.at, direction);
  const Turning of_b = TurningOf(b_, query.choice.of_b, query.at, direction);
  Drift drift;
  drift.along = numeric::Norm(ball_b.VelocityAt(query.at) - ball_a.VelocityAt(query.at));
  drift.bend = BendOf(ball_a, ball_b);
  drift.spin_sum = of_a.spin + of_b.spin;
  drift.spin_most = numeric::Max(of_a.spin, of_b.spin);
  drift.translation = From(ball_a.u + ball_b.u, query.at, direction);
  drift.turned1_sum = of_a.turned1 + of_b.turned1;
  drift.turned2_sum = of_a.turned2 + of_b.turned2;
  drift.turned1_most = numeric::Max(of_a.turned1, of_b.turned1);
  drift.turned2_most = numeric::Max(of_a.turned2, of_b.turned2);
  return drift;
}

// Balls within the solids that overlap by −upper do so until that is used up. Crossing triangles
// cross while no corner moves further than the margin: seen from half-way between the two bodies
// each corner moves by half of what translation does, and by the turning of its own body.
double ShapeMotion::ContactStep(const PoseQuery& query, TimeDirection direction) const {
  CORE_CHECK(query.touching(), "contact is certain at the instant", query.at);
  const Drift d = DriftFrom(query, direction);
  double step = 0;
  if (query.bracket.CertainlyOverlapping(query.pose.translation)) {
    const numeric::Interval gap = numeric::Interval(-query.bracket.upper) - d.translation.c0;
    const numeric::Interval closing = d.along + d.spin_sum + d.translation.c1 + d.turned1_sum;
    const numeric::Interval growth = d.translation.c2 + d.turned2_sum + d.bend;
    step = numeric::FirstZero(gap.lower, closing.upper, std::max(0.0, growth.upper),
                              std::max(0.0, d.translation.c3.upper));
  }
  if (query.bracket.CertainlyCrossing(query.pose.translation)) {
    const numeric::Interval half = 0.5;
    const numeric::Interval gap =
        numeric::Interval(query.bracket.crossing_margin) - half * d.translation.c0;
    const numeric::Interval closing =
        half * (d.along + d.translation.c1) + d.spin_most + d.turned1_most;
    const numeric::Interval growth = half * (d.translation.c2 + d.bend) + d.turned2_most;
    step = std::max(step, numeric::FirstZero(gap.lower, closing.upper, std::max(0.0, growth.upper),
                                             std::max(0.0, (half * d.translation.c3).upper)));
  }
  return step;
}

// As predicted from the chosen bounds, any two points move relative to each other by at most V h
// within h seconds, V being the greatest predicted speed: the velocity of the centres is linear, so
// that its norm is greatest at an end. What is not known of the translation is greatest at an end
// too. The turning that is not known at the instant is part of the bracket; what is added to it
// moves a point by at most so much angle times its reach, since a chord grows no faster than its
// angle. A distance above 0 all the time keeps either from getting inside the other.
double ShapeMotion::DistanceOver(const PoseQuery& query, double from, double to) const {
  if (!query.apart() || !query.neither_inside) return -numeric::kInfinity;
  const numeric::MovingBall& ball_a = a_.ball.bounds[query.choice.of_a];
  const numeric::MovingBall& ball_b = b_.ball.bounds[query.choice.of_b];
  const auto speed = [&](double at) {
    return numeric::Norm(ball_b.VelocityAt(at) - ball_a.VelocityAt(at));
  };
  numeric::Interval fastest = numeric::Max(speed(from), speed(to));
  const numeric::Cubic u = ball_a.u + ball_b.u;
  numeric::Interval unknown = numeric::Max(u.At(from), u.At(to));
  const auto turn = [&](const BodySegment& body, std::size_t bound) {
    if (!body.shape) return;
    const motion::MovingRotation& turning = body.turns[bound];
    const numeric::Interval reach = TurningReachOf(body);
    fastest = fastest + reach * numeric::Norm(numeric::IntervalVector(turning.w_WB));
    const numeric::Cubic& angle = turning.angle_error;
    const numeric::Interval most = numeric::Max(angle.At(from), angle.At(to));
    unknown = unknown + reach * numeric::Max(0, most - angle.At(query.at));
  };
  turn(a_, query.choice.of_a);
  turn(b_, query.choice.of_b);
  const double h = std::max(numeric::AddUp(to, -query.at), numeric::AddUp(query.at, -from));
  const double least = (numeric::Interval(query.bracket.lower) - h * fastest - unknown).lower;
  return least > 0 ? least : -numeric::kInfinity;
}

double ShapeMotion::SpeedAt(const PoseQuery& query) const {
  const Drift drift = DriftFrom(query, TimeDirection::kForward);
  return (drift.along + drift.spin_sum).upper;
}

}  // namespace collision::narrow_phase
