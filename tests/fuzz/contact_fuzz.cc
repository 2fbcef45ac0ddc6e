#include <algorithm>

#include "collision_core/narrow_phase/contact/time_of_contact.h"
#include "collision_core/numeric/seconds.h"
#include "server/codec/codec.h"
#include "tests/fuzz/fuzzed_messages.h"
#include "tests/fuzz/fuzzed_shapes.h"
#include "tests/fuzz/targets.h"
#include "tests/support/truth/true_distance.h"

namespace collision::fuzz {
namespace {

constexpr int kSamples = 5;
constexpr std::size_t kTrianglesJudged = 12;  // the truth takes each against each

/// An agent that flies and turns on as its state says: one motion that its bound allows.
struct Flier {
  motion::SpaceTimeBound bound;
  std::shared_ptr<const shape::Shape> body;  ///< Null: a ball.
  TrueMotion motion;
  Real from = 0;  ///< Of the segment, after the state's stamp [s].

  TrueBody At(Real t) const { return {body.get(), bound.limits.radius, motion.At(from + t)}; }

  /// What long double loses of it by `t`.
  Real Lost(Real t) const {
    const motion::MotionState& state = bound.state;
    const Real turned = (from + t) * state.w_WB.cast<Real>().norm();
    return 1e-17L * (state.p_WA.cast<Real>().norm() + (from + t) * state.v_WA.cast<Real>().norm() +
                     bound.limits.radius * (1 + turned));
  }

  /// The oracle knows balls and small surfaces.
  bool judged() const {
    const shape::Shape* shape = body.get();
    if (bound.state.v_WA.norm() > bound.limits.speed_max) return false;
    return shape == nullptr ||
           (shape->solids().empty() && shape->mesh().triangles.size() <= kTrianglesJudged);
  }
};

std::optional<Flier> FuzzedFlier(Instant from, FuzzedData* data) {
  v1::AgentDescription description = FuzzedDeclaration("alpha", data);
  description.clear_shape_hash();
  description.set_slot(0);
  description.set_agent_name("");
  const v1::AgentState wire = FuzzedState(from.nanoseconds(), data);
  const auto declaration = server::DecodeDescription(description);
  const auto state = server::DecodeState({}, wire, {.latest = from});
  if (!std::holds_alternative<detection::AgentDeclaration>(declaration)) return std::nullopt;
  if (!std::holds_alternative<motion::MotionState>(state)) return std::nullopt;
  Flier flier;
  flier.bound = {std::get<motion::MotionState>(state),
                 std::get<detection::AgentDeclaration>(declaration).limits, 0};
  flier.body = FuzzedBody(data);
  if (const shape::Shape* shape = flier.body.get()) {
    double& radius = flier.bound.limits.radius;
    radius = std::max(radius, shape->facts().radius);
  }
  const motion::MotionState& start = flier.bound.state;
  flier.motion.start = {.p = start.p_WA.cast<Real>(),
                        .v = start.v_WA.cast<Real>(),
                        .w = start.w_WB.cast<Real>(),
                        .q = start.q_WB.cast<Real>().normalized()};
  flier.from = static_cast<Real>(from.nanoseconds() - start.stamp.nanoseconds()) / 1e9L;
  return flier;
}

/// Whether the two overlap at `t`, wherever rounding puts them.
bool CertainlyTouch(const Flier& a, const Flier& b, Real t) {
  const Real lost = a.Lost(t) + b.Lost(t);
  const TrueBody of_a = a.At(t), of_b = b.At(t);
  if (SolidDistance(of_a, of_b) > 0) return false;
  for (int axis = 0; axis < 3; ++axis) {
    for (const Real sign : {-1, 1}) {
      Vector by = Vector::Zero();
      by[axis] = 4 * sign * lost;
      if (SolidDistance(of_a, of_b.Moved(by)) > 0) return false;
    }
  }
  return true;
}

bool CertainlyApart(const Flier& a, const Flier& b, Real t) {
  return SolidDistance(a.At(t), b.At(t)) > 4 * (a.Lost(t) + b.Lost(t));
}

void CheckForm(const narrow_phase::TimeOfContactResult& time, double duration) {
  for (const double value : {time.begin.lower, time.begin.upper, time.end.lower, time.end.upper}) {
    Require(value >= 0 && value <= duration, "outside of [0, ", duration, "]: ", value);
  }
  Require(time.begin.lower <= time.begin.upper && time.end.lower <= time.end.upper,
          "not ordered: begin ", time.begin.lower, " ", time.begin.upper, " end ", time.end.lower,
          " ", time.end.upper);
  Require(time.within >= 0, "within ", time.within);
  if (time.status != narrow_phase::ContactStatus::kContact) return;
  Require(time.begin.upper <= time.end.lower, "ends before it begins: ", time.begin.upper, " ",
          time.end.lower);
}

void CheckTruth(const Flier& a, const Flier& b, const narrow_phase::TimeOfContactResult& time,
                double duration) {
  for (int i = 0; i <= kSamples; ++i) {
    const double t = std::min(duration * i / kSamples, duration);
    const bool free = time.status == narrow_phase::ContactStatus::kFree || t < time.begin.lower ||
                      t > time.end.upper;
    if (free) Require(!CertainlyTouch(a, b, t), "they touch at ", t, ", reported free");
  }
  if (time.status != narrow_phase::ContactStatus::kContact) return;
  Require(!CertainlyApart(a, b, time.begin.upper), "apart at ", time.begin.upper, " = begin.upper");
  Require(!CertainlyApart(a, b, time.end.lower), "apart at ", time.end.lower, " = end.lower");
}

}  // namespace

void FuzzContact(Bytes bytes) {
  constexpr double kTolerances[] = {1e-12, 1e-6, 0};
  FuzzedData data(bytes);
  const Instant from = Instant::FromNanoseconds(2'000'000'000);
  const double wanted = data.UpTo(1000);
  const Instant to = numeric::AddRoundedDown(from, wanted);
  const narrow_phase::ContactTolerance tolerance{.absolute = data.OneOf(kTolerances),
                                                 .relative = data.OneOf(kTolerances)};
  const std::uint64_t allowed = data.Bits(2) % 8000;
  const auto a = FuzzedFlier(from, &data), b = FuzzedFlier(from, &data);
  if (!a || !b) return;
  WorkBudget work(allowed);
  const narrow_phase::TimeOfContactResult time =
      TimeOfContact({.last = a->bound, .next = {}, .shape = a->body},
                    {.last = b->bound, .next = {}, .shape = b->body}, {from, to}, tolerance, &work);
  const double duration = static_cast<double>(to.nanoseconds() - from.nanoseconds()) / 1e9;
  CheckForm(time, duration * (1 + 1e-15));
  Require(work.spent() <= allowed + kBatchUnits, "spent ", work.spent(), " of ", allowed);
  if (a->judged() && b->judged()) CheckTruth(*a, *b, time, duration);
}

}  // namespace collision::fuzz
