// What the checker notices in events about bodies with triangles.
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "client/checker/check.h"
#include "client/programs/scene_runner/metrics.h"
#include "tests/client/checker/solids.h"

namespace collision::checker {
namespace {

constexpr std::int64_t kOpen = std::numeric_limits<std::int64_t>::max();
constexpr double kSecond = 1e9;

// Two cubes of a metre: a rests at (10, offset, 0.2), b comes along x at 1 m/s for 20 s, in pieces
// of a second. They touch from 9 s to 11 s, if they do.
class ShapeCheckTest : public testing::Test {
 protected:
  ShapeCheckTest() {
    SetOffset(0.1);
    for (std::uint32_t slot = 0; slot < 2; ++slot) {
      v1::AgentName name;
      *name.mutable_id() = Id(slot);
      name.set_simulator("s");
      name.set_agent(std::string(1, static_cast<char>('a' + slot)));
      observations_.names.push_back(name);
    }
    Add(v1::EVENT_POSSIBLE, 7, {7.5, -1}, {-1, -1});
    Add(v1::EVENT_CONFIRMED, 10, {8.999, 9.001}, {-1, -1});
    Add(v1::EVENT_ENDED, 12, {8.999, 9.001}, {10.999, 11.001});
    // At 8 s they are 1 m apart: half-way is x = 9. At 9.25 s a quarter of a metre deep.
    Evaluate(0, 8, {0.9, 1.1}, {9, 0.1, 0.2});
    Evaluate(1, 9.25, {-1, -0.2}, {9.6, 0.3, 0});
    Evaluate(2, 9.25, {-1, -0.2}, {9.6, 0.3, 0});
  }

  void SetOffset(double y) {
    motions_.clear();
    for (const Vector& p : {Vector{10, y, 0.2}, Vector{0, 0, 0}}) {
      const std::string name(1, static_cast<char>('a' + motions_.size()));
      AgentMotion motion = Moving(name, BoxMesh(0.5, 0.5, 0.5), p, {}, 1);
      const Piece first = motion.pieces[0];
      motion.pieces.clear();
      for (int i = 0; i < 20; ++i) {
        Piece piece = first;
        piece.t0_ns = i * 1'000'000'000LL;
        piece.t1_ns = piece.t0_ns + 1'000'000'000;
        if (name == "b") piece.p_WA[0] = {double(i), 1, 0, 0};
        motion.pieces.push_back(piece);
      }
      motions_.push_back(motion);
    }
  }

  static v1::AgentId Id(std::uint32_t slot) {
    v1::AgentId id;
    id.set_simulator_id(5);
    id.set_slot(slot);
    return id;
  }

  struct Seconds {
    double earliest, latest;
  };

  static v1::TimeBracket BracketOf(const Seconds& s) {
    v1::TimeBracket bracket;
    bracket.set_earliest_ns(s.earliest < 0 ? kOpen : std::llround(s.earliest * kSecond));
    bracket.set_latest_ns(s.latest < 0 ? kOpen : std::llround(s.latest * kSecond));
    return bracket;
  }

  void Add(v1::EventStatus status, double now, Seconds begin, Seconds end) {
    v1::CollisionEvent event;
    *event.mutable_lower() = Id(0);
    *event.mutable_higher() = Id(1);
    event.set_contact(1);
    event.set_revision(static_cast<std::uint32_t>(observations_.events.size()) + 1);
    event.set_now_ns(std::llround(now * kSecond));
    event.set_status(status);
    event.set_continuous(true);
    event.clear_proximity();
    *event.mutable_begin() = BracketOf(begin);
    *event.mutable_end() = BracketOf(end);
    observations_.events.push_back(event);
  }

  void Evaluate(std::size_t i, double at, std::array<double, 2> separation, const Vector& point) {
    v1::CollisionEvent& event = observations_.events[i];
    event.mutable_proximity()->set_at_ns(std::llround(at * kSecond));
    event.mutable_proximity()->mutable_separation_m()->set_lower(separation[0]);
    event.mutable_proximity()->mutable_separation_m()->set_upper(separation[1]);
    event.mutable_proximity()->set_depth_lower_m(std::max(0.0, -separation[1]));
    event.mutable_proximity()->mutable_point_m()->set_x(point.x);
    event.mutable_proximity()->mutable_point_m()->set_y(point.y);
    event.mutable_proximity()->mutable_point_m()->set_z(point.z);
    event.mutable_proximity()->mutable_normal()->mutable_direction()->set_x(-1);
    event.mutable_proximity()->mutable_normal()->set_error_rad(0.1);
    event.set_work_units(100 * i);
  }

  std::string Verdict() const {
    std::string text;
    for (const auto& violation : Check(Evidence(motions_, observations_, facts_), {}))
      text += violation + "\n";
    return text;
  }

  bool Complains(const std::string& what) const {
    const std::string verdict = Verdict();
    if (verdict.find(what) != std::string::npos) return true;
    ADD_FAILURE() << "\"" << what << "\" is not in:\n" << verdict;
    return false;
  }

  std::vector<AgentMotion> motions_;
  Observations observations_;
  RunFacts facts_;
};

TEST_F(ShapeCheckTest, HonestRunIsSatisfied) { EXPECT_EQ(Verdict(), ""); }

TEST_F(ShapeCheckTest, MissingLateAndShiftedEventsAreNoticed) {
  const Observations honest = observations_;
  observations_.events.clear();
  EXPECT_TRUE(Complains("no event of the pair"));
  observations_ = honest;
  observations_.events[0].set_now_ns(9'000'000'500);
  EXPECT_TRUE(Complains("announced late, at 9.000000500 s"));
  for (const double shift : {-0.0010005, 0.0010005}) {
    observations_ = honest;
    for (int i = 1; i < 3; ++i) {
      *observations_.events[i].mutable_begin() = BracketOf({8.999 + shift, 9.001 + shift});
    }
    EXPECT_TRUE(Complains("no event brackets its begin"));
    EXPECT_TRUE(Complains("no true contact begins there"));
  }
  observations_ = honest;
  *observations_.events[2].mutable_end() = BracketOf({10.9, 10.9999995});
  EXPECT_TRUE(Complains("its end is not in the published bracket"));
  observations_.events.resize(2);
  EXPECT_TRUE(Complains("never ended"));
}

// Goal:   overlapping balls are not a contact: confirming one is wrong, dismissing it is right.
TEST_F(ShapeCheckTest, NearMissMayNotBeConfirmed) {
  SetOffset(1.2);
  EXPECT_TRUE(Complains("no true contact begins there"));
  observations_.events.resize(1);
  Evaluate(0, 10, {0.1, 0.3}, {10, 0.6, 0});
  Add(v1::EVENT_DISMISSED, 12, {8, -1}, {-1, -1});
  EXPECT_EQ(Verdict(), "");
}

// Goal:   a graze of 0.1 µm may be confirmed, dismissed or overlooked.
TEST_F(ShapeCheckTest, GrazeIsNeitherDemandedNorForbidden) {
  SetOffset(1 - 1e-7);
  for (auto& event : observations_.events) event.clear_proximity();
  EXPECT_EQ(Verdict(), "");
  observations_.events.clear();
  EXPECT_EQ(Verdict(), "");
  EXPECT_EQ(Evidence(motions_, observations_, facts_).contacts_certain(), 0u);
}

// Goal:   an event that is still only possible counts as long as the balls overlap, no longer.
TEST_F(ShapeCheckTest, PossibleCoversWhileTheBallsOverlap) {
  observations_.events.resize(1);
  EXPECT_TRUE(Complains("no event brackets its begin"));
  for (AgentMotion& motion : motions_) motion.pieces.resize(12);
  EXPECT_EQ(Verdict(), "");  // balls part at 11.73 s, the last piece that is judged ends at 11 s
}

// Goal:   the published distance holds from both sides.
TEST_F(ShapeCheckTest, FalseSeparationIsNoticed) {
  Evaluate(0, 8, {1.00001, 1.1}, {9, 0, 0});
  EXPECT_TRUE(Complains("its separation is [1.00001, 1.1] m, but the true one 1 m"));
  Evaluate(0, 8, {0.5, 0.99999}, {9, 0, 0});
  EXPECT_TRUE(Complains("its separation is [0.5, 0.99999] m, but the true one 1 m"));
  Evaluate(0, 8, {-0.5, -0.1}, {9, 0, 0});
  EXPECT_TRUE(Complains("but the true one 1 m"));
  Evaluate(0, 8, {-5, -1.5}, {9, 0, 0});
  EXPECT_TRUE(Complains("its separation is [-5, -1.5] m, but the true one 1 m"));
  Evaluate(0, 8, {-5, 5}, {9, 0, 0});
  EXPECT_EQ(Verdict(), "");
  Evaluate(1, 9.25, {0.001, 0.1}, {9.6, 0.3, 0});
  EXPECT_TRUE(Complains("its separation is [0.001, 0.1] m, but the true one 0 m"));
}

TEST_F(ShapeCheckTest, DepthBeyondWhatPartsThemIsNoticed) {
  Evaluate(1, 9.25, {-1, -0.2501}, {9.6, 0.3, 0});
  EXPECT_TRUE(Complains("it is at least 0.2501 m deep, but 0.25 m part the two"));
  Evaluate(1, 9.25, {-1, -0.2499}, {9.6, 0.3, 0});
  EXPECT_EQ(Verdict(), "");
  observations_.events[1].mutable_proximity()->set_depth_lower_m(0.26);
  EXPECT_TRUE(Complains("it is at least 0.26 m deep"));
}

TEST_F(ShapeCheckTest, PointThatIsOffIsNoticed) {
  Evaluate(1, 9.25, {-1, -0.2}, {9.6, 0.501, 0});
  EXPECT_TRUE(Complains("its point is 0.001 m away from one of them, with an error of 0 m"));
  observations_.events[1].mutable_proximity()->set_point_error_m(0.001);
  EXPECT_EQ(Verdict(), "");
  Evaluate(0, 8, {0.9, 1.1}, {9.01, 0, 0});
  EXPECT_TRUE(Complains("its point is 0.51 m away"));
  observations_.events[0].mutable_proximity()->set_point_error_m(
      std::numeric_limits<double>::infinity());
  EXPECT_EQ(Verdict(), "");
}

TEST_F(ShapeCheckTest, NormalThatIsNoDirectionIsNoticed) {
  observations_.events[1].mutable_proximity()->mutable_normal()->mutable_direction()->set_x(0.5);
  EXPECT_TRUE(Complains("its normal has the length 0.5"));
  observations_.events[1].mutable_proximity()->clear_normal();
  EXPECT_EQ(Verdict(), "");
}

// Goal:   at a teleport an event may refer to both places; a claim about a later instant that a
//         jump has changed is excused.
TEST_F(ShapeCheckTest, JumpsAreTakenIntoAccount) {
  for (std::size_t i = 8; i < 20; ++i) motions_[1].pieces[i].p_WA[1][0] = 50;
  motions_[1].jumps_ns = {8'000'000'000};
  observations_.events.resize(1);
  EXPECT_EQ(Verdict(), "");
  Evaluate(0, 8.1, {0.8, 1}, {9, 0, 0});
  EXPECT_EQ(Verdict(), "");  // said at 7 s
  observations_.events[0].set_now_ns(8'200'000'000);
  EXPECT_TRUE(Complains("but the true one"));
}

// Goal:   between the end of a contact and the end of its bracket, the two may touch again: one
//         event covers both.
// Method: b stands 2 cm beyond a from 11 s on, but for a tenth of a second, in which it is back.
TEST_F(ShapeCheckTest, TouchingAgainWithinTheEndBracketIsCovered) {
  for (std::size_t i = 11; i < 20; ++i) motions_[1].pieces[i].p_WA[0] = {11.02, 0, 0, 0};
  Piece back = motions_[1].pieces[11];
  motions_[1].pieces[11].t1_ns = 11'200'000'000;
  back.t0_ns = 11'200'000'000;
  back.t1_ns = 11'300'000'000;
  back.p_WA[0] = {10.98, 0, 0, 0};
  Piece after = motions_[1].pieces[12];
  after.t0_ns = 11'300'000'000;
  after.t1_ns = 12'000'000'000;
  motions_[1].pieces.insert(motions_[1].pieces.begin() + 12, {back, after});
  EXPECT_EQ(Evidence(motions_, observations_, facts_).contacts_certain(), 2u);
  EXPECT_TRUE(Complains("true contact 11.200000000 s to 11.300000000 s: no event brackets"));
  *observations_.events[2].mutable_end() = BracketOf({10.999, 11.31});
  EXPECT_EQ(Verdict(), "");
  *observations_.events[2].mutable_end() = BracketOf({10.999, 11.29});
  EXPECT_NE(Verdict(), "");
  *observations_.events[2].mutable_end() = BracketOf({11.29, 11.31});
  EXPECT_TRUE(Complains("true contact 9.000000000 s to 11.000000000 s: its end is not"));

  // Two events: the second may be announced after it begins only while the first is open.
  *observations_.events[2].mutable_end() = BracketOf({10.999, 11.01});
  observations_.events[2].set_now_ns(11'250'000'000);
  Add(v1::EVENT_ENDED, 11.35, {11.19, 11.21}, {11.29, 11.31});
  observations_.events[3].set_contact(2);
  EXPECT_EQ(Verdict(), "");
  observations_.events[2].set_now_ns(11'199'000'000);
  EXPECT_TRUE(Complains("announced late, at 11.350000000 s"));
}

// Goal:   the report's figures are those of the events, of agents with meshes only.
TEST_F(ShapeCheckTest, FiguresOfTheReport) {
  observations_.events[1].mutable_proximity()->set_point_error_m(0.002);
  v1::Counter* counter = observations_.status.add_counters();
  counter->set_name("tree_nodes");
  counter->set_value(77);
  const Evidence evidence(motions_, observations_, facts_);
  const auto report = client::MakeReport("scene", evidence, {}, {});
  EXPECT_EQ(report.contacts_true(), 1u);
  EXPECT_EQ(report.separation_width_m().count(), 1u);
  EXPECT_NEAR(report.separation_width_m().p50(), 0.8, 1e-15);
  EXPECT_EQ(report.point_error_m().max(), 0.002);
  EXPECT_EQ(report.normal_error_rad().p99(), 0.1);
  EXPECT_EQ(report.work_units().p50(), 200);
  ASSERT_EQ(report.counters_size(), 1);
  const std::string table = client::SummaryTable(report, evidence);
  EXPECT_NE(table.find("100.0 % confirmed, 0.0 % undecided, 0.0 % dismissed (1)"),
            std::string::npos)
      << table;
  EXPECT_NE(table.find("0 shapes, 77 spheres"), std::string::npos) << table;

  for (AgentMotion& motion : motions_) motion.mesh = nullptr;
  const Evidence balls(motions_, observations_, facts_);
  const auto without = client::MakeReport("scene", balls, {}, {});
  EXPECT_EQ(without.separation_width_m().count(), 0u);
  EXPECT_EQ(client::SummaryTable(without, balls).find("events about shapes"), std::string::npos);
}

}  // namespace
}  // namespace collision::checker
