#include "tests/soak/honest.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace collision::soak {
namespace {

using std::chrono::steady_clock;

constexpr std::int64_t kStepNs = 16'666'667;
constexpr int kSteps = 24;  // of a lap
/// The passing agent flies along x, through the resting one at 0; both have this radius.
constexpr double kRadius = 1, kSpeed = 30, kStart = -4.25;
/// In the middle between two steps, the second one is the first that shows it.
constexpr std::int64_t kTouchNs = 75'000'000, kPartNs = 208'333'333;
constexpr int kShows = 5;
/// Until then its places are free.
constexpr int kEnters = 2;
/// The wall clock of a sender, and the steps of its agents between two states.
constexpr std::int64_t kTolerance = 2'500'000;
/// Far from all that others do.
constexpr double kAway = 1e6;
constexpr std::chrono::seconds kPatience{60};

double Seconds() {
  return std::chrono::duration<double>(steady_clock::now().time_since_epoch()).count();
}

std::int64_t WallNs() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

bool Holds(std::int64_t earliest_ns, std::int64_t t_ns, std::int64_t latest_ns) {
  return earliest_ns - kTolerance <= t_ns && t_ns <= latest_ns + kTolerance;
}

}  // namespace

double QuantileOf(std::vector<double> values, double part) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
}

Honest::Honest(const std::string& world, std::uint32_t domain, bool lock_step,
               suite::Outcome* outcome)
    : lock_step_(lock_step),
      outcome_(*outcome),
      world_(client::World::Connect(
          {.world = world, .simulator = "honest", .domain = domain, .lock_step = lock_step})),
      shape_(client::Shape::Make({.solids = {client::Solid::Ball(kRadius)}})) {
  world_.OnEvent([this](const client::Event& event) { Hear(event); });
}

bool Honest::Lap(Served* served) {
  served_ = served;
  const bool first = !resting_.has_value();
  if (!first) before_ = lap_;
  const std::int64_t begin_ns = lock_step_ ? lap_.begin_ns + kSteps * kStepNs : WallNs();
  lap_ = Flown();
  lap_.begin_ns = begin_ns;
  shown_at_s_ = -1;
  if (first) {
    resting_ = world_.AddAgent(
        {.name = "resting", .radius_m = kRadius, .acceleration_max_m_s2 = 0.1}, Resting(0));
  }
  passing_.reset();
  for (int step = 0; step < kSteps; ++step) {
    if (!Step(step, served)) return outcome_.Expect(false, "the honest one was not answered");
  }
  if (before_) Judge(*before_);
  ++served->laps;
  return true;
}

void Honest::Enter() {
  passing_ = world_.AddAgent({.name = "passing",
                              .radius_m = shape_->radius_m(),
                              .acceleration_max_m_s2 = 0.1,
                              .shape = shape_},
                             Passing(kEnters));
  lap_.passing = passing_->id();
}

bool Honest::Step(int step, Served* served) {
  const std::int64_t t_ns = StampOf(step);
  while (!lock_step_ && WallNs() < t_ns) {
    world_.Poll(std::chrono::nanoseconds(t_ns - WallNs()));
  }
  resting_->SetState(Resting(step));
  if (step == kEnters) Enter();
  if (passing_) passing_->SetState(Passing(step));
  const double before_s = Seconds();
  if (world_.AdvanceTo(t_ns, kPatience) == client::Advance::kTimeout) return false;
  const double after_s = Seconds();
  if (lock_step_) served->answers_ms.push_back(1e3 * (after_s - before_s));
  if (step == kShows) shown_at_s_ = after_s;
  return true;
}

void Honest::Hear(const client::Event& event) {
  if (!client::IsDecided(event.status)) return;
  const auto is_of = [&](const Flown& lap) {
    return event.lower == lap.passing || event.higher == lap.passing;
  };
  if (is_of(lap_)) {
    if (!lap_.last && shown_at_s_ > 0)
      served_->events_ms.push_back(1e3 * (Seconds() - shown_at_s_));
    lap_.last = event;
  } else if (before_ && is_of(*before_)) {
    before_->last = event;
  }
}

void Honest::Judge(const Flown& lap) {
  if (!lap.last || lap.last->status != client::EventStatus::kEnded) {
    ++unended_;
    return;
  }
  const client::Event& last = *lap.last;
  const std::vector<std::int64_t> brackets = {
      last.begin.earliest_ns - lap.begin_ns, last.begin.latest_ns - lap.begin_ns,
      last.end.earliest_ns - lap.begin_ns, last.end.latest_ns - lap.begin_ns};
  // By the wall clock it may be known only after the begin.
  const bool begin_holds = last.began_before || Holds(brackets[0], kTouchNs, brackets[1]);
  std::string text = "a bracket does not hold, of begin and end:";
  for (const std::int64_t at_ns : brackets) text += " " + std::to_string(at_ns);
  outcome_.Expect(begin_holds && Holds(brackets[2], kPartNs, brackets[3]), text);
  if (!lock_step_) return;
  if (brackets_.empty()) brackets_ = brackets;
  outcome_.Expect(brackets == brackets_, "not every lap has the same brackets");
}

client::State Honest::Resting(int step) const {
  return {.stamp_ns = StampOf(step), .position_m = {0, kAway, 0}};
}

client::State Honest::Passing(int step) const {
  const double x = kStart + kSpeed * 1e-9 * static_cast<double>(step * kStepNs);
  return {.stamp_ns = StampOf(step), .position_m = {x, kAway, 0}, .velocity_m_s = {kSpeed, 0, 0}};
}

std::int64_t Honest::StampOf(int step) const { return lap_.begin_ns + step * kStepNs; }

}  // namespace collision::soak
