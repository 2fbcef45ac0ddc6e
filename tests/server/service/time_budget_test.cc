// Goal:   time_budget_us buys narrower answers: less of it, wider brackets and less work, and never
//         a wrong answer.
// Method: a closed dented ball flies into another; symmetry says when. Ever larger budgets: the
//         true instant is inside each bracket of the contact's begin, which becomes narrower.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/server/shapes/two_cubes.h"

namespace collision::server {
namespace {

constexpr std::uint32_t kRings = 24;

/// A ball of radius 1, dented by a wave along z: closed, not convex.
ShapeContent DentedBall() {
  ShapeContent content;
  const double pi = 3.141592653589793;
  for (std::uint32_t i = 0; i <= kRings; ++i) {
    const double polar = pi * i / kRings;
    for (std::uint32_t j = 0; j < 2 * kRings; ++j) {
      const double angle = pi * j / kRings;
      const double reach = 1 - 0.1 * (1 - std::cos(6 * polar)) * std::sin(polar);
      content.vertices.push_back({reach * std::sin(polar) * std::cos(angle),
                                  reach * std::sin(polar) * std::sin(angle),
                                  reach * std::cos(polar)});
    }
  }
  for (std::uint32_t i = 0; i < kRings; ++i) {
    for (std::uint32_t j = 0; j < 2 * kRings; ++j) {
      const std::uint32_t a = i * 2 * kRings + j, b = i * 2 * kRings + (j + 1) % (2 * kRings);
      content.triangles.push_back({a, a + 2 * kRings, b});
      content.triangles.push_back({b, a + 2 * kRings, b + 2 * kRings});
    }
  }
  return content;
}

/// How far it reaches along x, and with a body turned like it along −x.
double ReachAlongX() {
  double reach = 0;
  for (const auto& vertex : DentedBall().vertices) reach = std::max(reach, vertex[0]);
  return reach;
}

constexpr double kDistance = 2.1;  ///< Between the two reference points at first [m].
constexpr double kSpeed = 1;       ///< At which the second comes nearer, along x [m/s].

/// States and clock of one tick; the two turn and accelerate next to nothing.
std::vector<v1::Input> Tick(int tick) {
  v1::AgentStates chunk = Chunk("alpha");
  const std::int64_t now = tick * kSecond / 60;
  for (std::uint32_t slot = 0; slot < 2; ++slot) {
    v1::AgentState state = State(slot, now, 2 * tick + slot + 1);
    const double velocity = slot == 0 ? 0 : -kSpeed;
    state.mutable_velocity_m_s()->set_x(velocity);
    state.mutable_position_m()->set_x(slot * kDistance +
                                      velocity * 1e-9 * static_cast<double>(now));
    *chunk.add_states() = state;
  }
  return {From(kAlpha, chunk), From(kAlpha, ClockAfter("alpha", now, 2 * tick + 2, 2))};
}

struct Answer {
  v1::CollisionEvent event;  ///< As it was first confirmed, else the last.
  std::uint64_t work = 0;

  /// Width of the begin bracket [s]; infinite while there is no certain contact.
  double width() const {
    if (event.status() != v1::EVENT_CONFIRMED) return INFINITY;
    return 1e-9 * static_cast<double>(event.begin().latest_ns() - event.begin().earliest_ns());
  }
};

Answer Meet(double time_budget_us) {
  v1::Config config = Simulated();
  config.set_time_budget_us(time_budget_us);
  ScriptedDaemon daemon(config);
  const TwoCubes bodies(kDistance, EncodeShape(DentedBall()));
  daemon.Step(bodies.Descriptions());
  daemon.Step(bodies.Parts());
  daemon.Step({});
  for (int tick = 0; tick < 75; ++tick) daemon.Step(Tick(tick), 1.0 / 60);
  Answer answer{.event = LastEvent(daemon), .work = daemon.counter("work_units")};
  for (const v1::Output& output : daemon.bus().outputs) {
    if (!output.has_collision_event()) continue;
    answer.event = output.collision_event();
    if (answer.event.status() == v1::EVENT_CONFIRMED) break;
  }
  return answer;
}

TEST(TimeBudget, BuysNarrowerAnswers) {
  const double begin_s = (kDistance - 2 * ReachAlongX()) / kSpeed;
  ASSERT_GT(begin_s, 0.2);
  std::vector<Answer> answers;
  for (const double budget_us : {4.0, 64.0, 1000.0, 20000.0}) {
    SCOPED_TRACE(budget_us);
    const Answer answer = Meet(budget_us);
    EXPECT_NE(answer.event.status(), v1::EVENT_DISMISSED) << "they do meet";
    EXPECT_LE(1e-9 * static_cast<double>(answer.event.begin().earliest_ns()), begin_s);
    EXPECT_GE(1e-9 * static_cast<double>(answer.event.begin().latest_ns()), begin_s);
    if (!answers.empty()) {
      EXPECT_GE(answer.work, answers.back().work);
      EXPECT_LE(answer.width(), answers.back().width() + 1e-6);
    }
    answers.push_back(answer);
  }
  EXPECT_LT(answers.back().width(), 1e-3);
  EXPECT_GT(answers.front().width(), 10 * answers.back().width());
  EXPECT_GT(answers.back().work, 4 * answers.front().work);
}

}  // namespace
}  // namespace collision::server
