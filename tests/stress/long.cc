// A million simulated seconds of a small scene.
#include <cmath>
#include <map>

#include "collision_core/detection/detector.h"
#include "tests/bench/harness/allocation_counter.h"
#include "tests/stress/case.h"

namespace collision::stress {
namespace {

using Eigen::Vector3d;

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr int kPairs = 6;
constexpr double kStepSeconds = 0.25;

/// Two of a pair swing along x, towards each other and away, with constant acceleration that
/// changes its sign each half of a period: positions are parabolas, exact in doubles, for ever the
/// same. At its nearest each pair overlaps, and then parts.
struct Swing {
  double half_period;  ///< [s] A power of two.
  double M;            ///< [m/s²] Of each.
  double middle;       ///< Of the distance [m].

  /// How far each is from its place, and how fast, after so many nanoseconds. The period counts
  /// from the middle on outward: |x| = M/2 s (T − s).
  void At(std::int64_t ns, double* x, double* v) const {
    const auto half = static_cast<std::int64_t>(half_period * kSecond);
    const std::int64_t phase = ns % (2 * half);
    const double s = static_cast<double>(phase % half) / kSecond;
    const double sign = phase < half ? 1 : -1;
    *x = sign * M / 2 * s * (half_period - s);
    *v = sign * M / 2 * (half_period - 2 * s);
  }

  /// The k-th contact from the start on: both are nearer by 2 |x|, in the second half of a period.
  void Contact(std::int64_t k, long double* begin, long double* end) const {
    const long double T = half_period, gap = middle - 2;  // radii of 1 m
    const long double root = std::sqrt(T * T / 4 - gap / M);
    const long double from = (2 * k + 1) * T;
    *begin = from + T / 2 - root;
    *end = from + T / 2 + root;
  }

  /// What brackets may be wide, of states h apart: each of the two is known to M h²/8 half-way
  /// between them, and they close at 2 M root; 1/64 for how this changes meanwhile, and the
  /// nanosecond.
  double Width(double h) const {
    const double root = std::sqrt(half_period * half_period / 4 - (middle - 2) / M);
    return (1 + 0x1p-6) * h * h / (4 * root) + 3e-9;
  }
};

Swing SwingOf(int pair) {
  // At its nearest a pair overlaps by M T²/4 − gap: M T²/4 is 2 m.
  const double half_period = std::ldexp(1, 2 + pair % 3);
  return {half_period, 8 / (half_period * half_period), 3 + 0.125 * pair};
}

detection::AgentId Id(int pair, int which) {
  return {1, static_cast<std::uint32_t>(2 * pair + which), 1, 1};
}

motion::MotionState StateOf(int pair, int which, std::int64_t ns) {
  const Swing swing = SwingOf(pair);
  double x, v;
  swing.At(ns, &x, &v);
  const double side = which == 0 ? -1 : 1;
  motion::MotionState state;
  state.stamp = Instant::FromNanoseconds(ns);
  state.p_WA = {side * (swing.middle / 2 + x), 16.0 * pair, 0};
  state.v_WA = {side * v, 0, 0};
  return state;
}

/// What is kept of a stretch of the run, to be compared with another one.
struct Stretch {
  double widest = 0;        ///< Of the brackets [s].
  double widest_share = 0;  ///< Of what they may be wide.
  double clear_sum = 0;     ///< How far ahead agents were clear, in all [s].
  std::uint64_t steps = 0, contacts = 0;
  std::int64_t live_bytes = 0;
  std::size_t queued = 0;
  double clear_mean() const { return clear_sum / static_cast<double>(2 * kPairs * steps); }
};

class LongRun {
 public:
  explicit LongRun(Outcome* outcome) : detector_(detection::DetectorOptions{}), outcome_(outcome) {
    for (int pair = 0; pair < kPairs; ++pair) {
      for (const int which : {0, 1}) {
        detection::AgentDeclaration declaration;
        declaration.limits.radius = 1;
        declaration.limits.acceleration_max = SwingOf(pair).M;
        detector_.Admit(Id(pair, which), declaration, StateOf(pair, which, 0), Instant());
      }
    }
  }

  Stretch RunTo(std::int64_t end_ns, std::int64_t step_ns) {
    Stretch stretch;
    while (now_ < end_ns) {
      now_ += step_ns;
      Step(&stretch);
    }
    stretch.live_bytes = bench::LiveBytes();
    return stretch;
  }

  /// Contacts of the closed form that ended more than 2 s ago and were not reported.
  std::int64_t Missing() const {
    std::int64_t missing = 0;
    for (int pair = 0; pair < kPairs; ++pair) {
      const auto period = static_cast<std::int64_t>(2 * SwingOf(pair).half_period * kSecond);
      const std::int64_t whole = (now_ - 2 * kSecond) / period;
      const auto reported = reported_.find(pair);
      missing += whole - (reported == reported_.end() ? 0 : std::min(whole, reported->second));
    }
    return missing;
  }

 private:
  void Step(Stretch* stretch) {
    for (int pair = 0; pair < kPairs; ++pair) {
      for (const int which : {0, 1}) {
        const motion::MotionState state = StateOf(pair, which, now_);
        const detection::UpdateOutcome reported =
            detector_.Update(Id(pair, which), state, state.stamp);
        outcome_->Expect(reported == detection::UpdateOutcome::kKept,
                         "an honest state is not kept");
        detector_.SetHeardUntil(OwnerOf(Id(pair, which)), state.stamp);
      }
    }
    detector_.Advance(Instant::FromNanoseconds(now_));
    ++stretch->steps;
    stretch->queued = std::max(stretch->queued, detector_.queued());
    for (const detection::CollisionEvent& event : detector_.events()) Take(event, stretch);
    for (int pair = 0; pair < kPairs; ++pair) CheckClear(pair, stretch);
  }

  void CheckClear(int pair, Stretch* stretch) {
    const Swing swing = SwingOf(pair);
    const auto period = static_cast<std::int64_t>(2 * swing.half_period * kSecond);
    long double begin, end;
    swing.Contact(now_ / period, &begin, &end);
    if (now_ > begin * kSecond) swing.Contact(now_ / period + 1, &begin, &end);
    for (const int which : {0, 1}) {
      const auto clearance = detector_.ClearanceOf(Id(pair, which));
      if (!outcome_->Expect(clearance.has_value(), "no clearance")) continue;
      const long double until = clearance->clear_until.nanoseconds() / 1e9L;
      stretch->clear_sum += std::max(0.0, static_cast<double>(until - now_ / 1e9L));
      // Two that are reported to touch begin no new contact until that has ended.
      if (touching_[pair]) continue;
      outcome_->Expect(until <= begin, "clear beyond a contact");
    }
  }

  void Take(const detection::CollisionEvent& event, Stretch* stretch) {
    const int pair = static_cast<int>(event.lower.slot / 2);
    outcome_->Expect(event.higher.slot == event.lower.slot + 1, "a contact of two that never meet");
    touching_[pair] = event.status == detection::EventStatus::kConfirmed;
    if (event.status != detection::EventStatus::kEnded) return;
    // The contacts of a pair come one after the other; the next is the one of its number.
    long double begin, end;
    const std::int64_t number = reported_[pair]++;
    SwingOf(pair).Contact(number, &begin, &end);
    const auto contains = [&](const detection::TimeBracket& bracket, long double truth) {
      const long double slack = 0x1p-58L * truth;
      return bracket.earliest.nanoseconds() / 1e9L <= truth + slack &&
             bracket.latest.nanoseconds() / 1e9L >= truth - slack;
    };
    outcome_->Expect(contains(event.begin, begin), "a begin is not in its bracket");
    outcome_->Expect(contains(event.end, end), "an end is not in its bracket");
    const double most = SwingOf(pair).Width(kStepSeconds);
    for (const detection::TimeBracket& bracket : {event.begin, event.end}) {
      const double width =
          static_cast<double>(bracket.latest.nanoseconds() - bracket.earliest.nanoseconds()) /
          kSecond;
      stretch->widest = std::max(stretch->widest, width);
      stretch->widest_share = std::max(stretch->widest_share, width / most);
      outcome_->Expect(width <= most, "a wide bracket");
    }
    ++stretch->contacts;
  }

  detection::Detector detector_;
  Outcome* outcome_;
  std::int64_t now_ = 0;
  std::map<int, std::int64_t> reported_;
  bool touching_[kPairs] = {};
};

/// Slots of pairs rest until a thousand others have been freed: until then memory takes its place
/// [s].
constexpr std::int64_t kWarmUp = 4000;

void Swings(const Setting& setting, Outcome* outcome) {
  const std::int64_t seconds = setting.quick ? 10'000 : 1'000'000;
  const auto kStep = static_cast<std::int64_t>(kStepSeconds * kSecond);
  LongRun run(outcome);
  const std::int64_t stretch = seconds / 100;
  run.RunTo(kWarmUp * kSecond, kStep);
  const Stretch first = run.RunTo((kWarmUp + stretch) * kSecond, kStep);
  const Stretch middle = run.RunTo((seconds - stretch) * kSecond, kStep);
  const Stretch last = run.RunTo(seconds * kSecond, kStep);
  outcome->Expect(run.Missing() == 0, "contacts are missing");
  const double grown = static_cast<double>(last.live_bytes) - static_cast<double>(first.live_bytes);
  outcome->Expect(grown <= 4096, "memory grows");
  outcome->Expect(last.queued <= first.queued, "the queue grows");
  outcome->Expect(last.widest <= 1.25 * first.widest, "brackets become wider");
  outcome->Expect(last.clear_mean() >= 0.98 * first.clear_mean(), "clearances become shorter");
  outcome->Set("seconds", static_cast<double>(seconds));
  outcome->Set("contacts", static_cast<double>(first.contacts + middle.contacts + last.contacts));
  outcome->Set("grown_bytes", grown);
  outcome->Set("width_first_s", first.widest);
  outcome->Set("width_last_s", last.widest);
  outcome->Set("width_share",
               std::max({first.widest_share, middle.widest_share, last.widest_share}));
  outcome->Set("clear_first_s", first.clear_mean());
  outcome->Set("clear_last_s", last.clear_mean());
  outcome->Say(
      Show(static_cast<double>(seconds)) + " s, " + Show(outcome->Get("contacts")) +
      " contacts; in a hundredth of it near the start and at the end: begins and ends within " +
      Show(first.widest) + " and " + Show(last.widest) + " s (" +
      Show(outcome->Get("width_share")) + " of what is allowed), clear for " +
      Show(first.clear_mean()) + " and " + Show(last.clear_mean()) +
      " s in the mean, memory grown by " + Show(grown) + " bytes");
}

}  // namespace

std::vector<Case> LongCases() {
  return {
      {"long", "swings",
       "contacts for a million seconds (quick: ten thousand), each told in brackets that "
       "contain the closed answer, M T2/2 over the speed wide at most, never late; at the end no "
       "more memory (4 kB) than after 4000 s, no longer queue, brackets and clearances as tight as "
       "at the start",
       Swings}};
}

}  // namespace collision::stress
