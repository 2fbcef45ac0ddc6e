// Goal:   of 200 robots of seven links each, which turn and move, the detector tells nothing within
//         a robot, though its links overlap all the time, and every contact between two robots; and
//         the links keep the bounds that they declare.
// Method: the robots of the simulator, link by link, in the core's detector; all contacts from the
//         checker, which finds them from the exact motion and shares no code with the core.
#include "client/programs/simulators/robots/robots.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <set>

#include "client/checker/motion/true_contacts.h"
#include "collision/shape.h"
#include "collision_core/detection/detector.h"
#include "collision_core/shape/shape.h"
#include "tests/support/sanitized.h"

namespace collision::client {
namespace {

using detection::CollisionEvent;
using detection::EventStatus;

constexpr std::size_t kRobots = kSanitized ? 120 : 200;
constexpr int kSteps = 80;

std::int64_t StepTime(int step) { return step * std::int64_t{50'000'000}; }

RobotOptions Crowd(std::size_t robots) {
  RobotOptions options;
  options.robots = robots;
  options.seed = 1995;
  options.limits.base.box_m = {70, 70, 35};
  options.limits.base.speed_max_m_s = 8;
  options.limits.base.acceleration_max_m_s2 = 4;
  return options;
}

Eigen::Vector3d ToEigen(const Vector3& v) { return {v[0], v[1], v[2]}; }

Eigen::Quaterniond ToEigen(const Quaternion& q) { return {q[0], q[1], q[2], q[3]}; }

std::shared_ptr<const shape::Shape> ToCore(const Shape& shape) {
  std::vector<shape::ConvexSolid> solids;
  for (const Solid& solid : shape.solids()) {
    const bool box = solid.kind == Solid::Kind::kBox;
    solids.push_back(shape::ConvexSolid::Build(
        {.core = box ? geometry::ConvexCore::kBox : geometry::ConvexCore::kSegment,
         .half = ToEigen(solid.half_extents_m),
         .points = {},
         .rounding = solid.rounding_m,
         .q_BS = ToEigen(solid.orientation),
         .p_BS = ToEigen(solid.position_m)}));
  }
  return shape::Shape::Compound(nullptr, std::move(solids));
}

/// The crowd in a detector, and its motion in a log.
class CrowdRun {
 public:
  explicit CrowdRun(const RobotOptions& options) : options_(options), log_(Path()) {
    detection::DetectorOptions limits;
    limits.agents_max = static_cast<std::uint32_t>(options.robots * options.limits.links);
    limits.announce_within = 0.5;
    detector_.emplace(limits);
    for (const Vector3& start : RobotPositions(options)) {
      robots_.push_back(RobotOf(options, robots_.size(), start));
    }
    for (std::size_t link = 0; link < options.limits.links; ++link) {
      shapes_.push_back(LinkShape(options.limits, link));
      core_shapes_.push_back(ToCore(*shapes_.back()));
    }
    for (std::size_t agent = 0; agent < limits.agents_max; ++agent) Admit(agent);
  }

  void Run() {
    for (int step = 0; step < kSteps; ++step) {
      for (std::size_t robot = 0; robot < robots_.size(); ++robot) {
        const auto motions = robots_[robot].Step(StepTime(step), StepTime(step + 1));
        for (std::size_t link = 0; link < motions.size(); ++link) {
          log_.Piece(NameOf(robot, link), motions[link].piece);
          log_.Turn(NameOf(robot, link), motions[link].turn);
        }
      }
      const Instant now = Instant::FromNanoseconds(StepTime(step + 1));
      for (std::size_t agent = 0; agent < Agents(); ++agent) {
        EXPECT_EQ(detector_->Update(IdOf(agent), StateOf(agent, now), now),
                  detection::UpdateOutcome::kKept);
      }
      for (std::uint64_t owner = 1; owner <= 2; ++owner) detector_->SetHeardUntil({owner, 1}, now);
      detector_->Advance(now);
      for (const CollisionEvent& event : detector_->events()) {
        const auto [a, b] = std::minmax(event.lower.slot, event.higher.slot);
        events_[{a, b, event.contact}] = event;
      }
    }
    log_.Close();
  }

  using EventKey = std::tuple<std::size_t, std::size_t, std::uint32_t>;
  /// The last revisions, by agents and contact.
  const std::map<EventKey, CollisionEvent>& events() const { return events_; }
  std::size_t RobotOfAgent(std::size_t agent) const { return agent / options_.limits.links; }

  std::vector<checker::AgentMotion> Motions() const {
    std::ifstream text(Path());
    return checker::ReadMotionLog(text, "robots");
  }

 private:
  /// Of each test its own: they run beside each other.
  static std::string Path() {
    return testing::TempDir() + "robots_test_" +
           testing::UnitTest::GetInstance()->current_test_info()->name() + ".motion";
  }
  std::size_t Agents() const { return robots_.size() * options_.limits.links; }
  static std::string NameOf(std::size_t robot, std::size_t link) {
    return RobotName(robot) + "/" + std::to_string(link);
  }
  /// Robots of two owners in turn.
  detection::AgentId IdOf(std::size_t agent) const {
    return {.simulator = 1 + RobotOfAgent(agent) % 2,
            .slot = static_cast<std::uint32_t>(agent),
            .run = 1,
            .generation = 1};
  }

  motion::MotionState StateOf(std::size_t agent, Instant now) const {
    const std::size_t links = options_.limits.links;
    const RigidState& body = robots_[agent / links].states()[agent % links];
    motion::MotionState state;
    state.stamp = now;
    state.p_WA = ToEigen(body.position_m);
    state.v_WA = ToEigen(body.velocity_m_s);
    state.q_WB = ToEigen(body.orientation);
    state.w_WB = ToEigen(body.angular_velocity_rad_s);
    state.position_error = state.velocity_error = kShipPositionError;
    state.rotation_error = kShipRotationError;
    return state;
  }

  void Admit(std::size_t agent) {
    const std::size_t robot = RobotOfAgent(agent), link = agent % options_.limits.links;
    const AgentDescription told = LinkDescription(options_, robot, link, shapes_[link]);
    detection::AgentDeclaration declaration;
    declaration.limits.radius = told.radius_m.value();
    declaration.limits.acceleration_max = told.acceleration_max_m_s2.value();
    declaration.limits.angular_acceleration_max = told.angular_acceleration_max_rad_s2.value();
    declaration.shape = core_shapes_[link];
    declaration.filter.assembly = static_cast<std::uint32_t>(robot + 1);
    declaration.filter.name = static_cast<std::uint32_t>(agent + 1);
    ASSERT_TRUE(detector_->Admit(IdOf(agent), declaration, StateOf(agent, Instant()), Instant()));
    log_.Agent(told.name, told.radius_m.value(), told.shape);
    log_.Assembly(told.name, told.assembly);
  }

  RobotOptions options_;
  MotionLog log_;
  std::optional<detection::Detector> detector_;
  std::vector<Robot> robots_;
  std::vector<std::shared_ptr<const Shape>> shapes_;
  std::vector<std::shared_ptr<const shape::Shape>> core_shapes_;
  std::map<EventKey, CollisionEvent> events_;
};

/// Whether the bracket contains a time that is known to a tolerance [ns].
bool Brackets(const detection::TimeBracket& bracket, long double ns, long double tolerance) {
  return static_cast<long double>(bracket.earliest.nanoseconds()) <= ns + tolerance &&
         (bracket.latest.is_never() ||
          ns - tolerance <= static_cast<long double>(bracket.latest.nanoseconds()));
}

bool IsContact(const CollisionEvent& event) {
  return event.status == EventStatus::kConfirmed || event.status == EventStatus::kEnded;
}

/// Whether an event tells of the contact, or of a doubt that includes it.
bool IsTold(const CrowdRun& run, const checker::TrueContact& contact) {
  for (auto at = run.events().lower_bound({contact.a, contact.b, 0});
       at != run.events().end() && std::get<0>(at->first) == contact.a &&
       std::get<1>(at->first) == contact.b;
       ++at) {
    const CollisionEvent& event = at->second;
    const detection::TimeBracket whole{event.begin.earliest, event.end.latest};
    const bool doubt = event.status != EventStatus::kDismissed || !event.continuous;
    if (IsContact(event) && Brackets(event.begin, contact.begin_ns, contact.begin_tolerance_ns)) {
      return true;
    }
    if (doubt && Brackets(whole, contact.begin_ns, contact.begin_tolerance_ns)) return true;
  }
  return false;
}

TEST(Robots, NothingIsToldWithinARobotAndEveryContactBetweenTwo) {
  CrowdRun run(Crowd(kRobots));
  run.Run();
  ASSERT_FALSE(HasFailure());
  const std::vector<checker::TrueContact> contacts = checker::TrueContacts(run.Motions());
  for (const auto& [key, event] : run.events()) {
    ASSERT_NE(run.RobotOfAgent(std::get<0>(key)), run.RobotOfAgent(std::get<1>(key)));
  }
  std::size_t certain = 0, confirmed = 0;
  // What begins in the last step may be only possible yet.
  const long double last = StepTime(kSteps - 1);
  for (const checker::TrueContact& contact : contacts) {
    if (!contact.certain || contact.begin_ns > last) continue;
    ++certain;
    EXPECT_TRUE(IsTold(run, contact))
        << contact.a << " x " << contact.b << " at " << static_cast<double>(contact.begin_ns);
  }
  std::set<std::pair<std::size_t, std::size_t>> touching;
  for (const checker::TrueContact& contact : contacts) touching.insert({contact.a, contact.b});
  for (const auto& [key, event] : run.events()) {
    if (!IsContact(event)) continue;
    ++confirmed;
    EXPECT_TRUE(touching.contains({std::get<0>(key), std::get<1>(key)}))
        << std::get<0>(key) << " x " << std::get<1>(key);
  }
  EXPECT_GT(certain, kSanitized ? 5u : 20u);
  EXPECT_GE(confirmed, certain * 9 / 10);
}

// Goal: the test above is about something: without the assemblies, neighbours touch all the time.
TEST(Robots, TheLinksOfARobotOverlap) {
  CrowdRun run(Crowd(3));
  run.Run();
  std::vector<checker::AgentMotion> motions = run.Motions();
  EXPECT_TRUE(checker::TrueContacts(motions).empty());
  for (checker::AgentMotion& motion : motions) motion.assembly.clear();
  std::size_t throughout = 0;
  for (const checker::TrueContact& contact : checker::TrueContacts(motions)) {
    throughout += contact.b == contact.a + 1 && contact.from_start && contact.to_end;
  }
  EXPECT_EQ(throughout, 3u * 6);
}

// Goal: position and velocity of a step agree with the chain, and its acceleration with what is
//       declared.
TEST(Robots, LinksMoveAsDeclaredAndAsTheChain) {
  const RobotOptions options = Crowd(1);
  Robot robot = RobotOf(options, 0, {40, 40, 20});
  double fastest = 0;
  for (int step = 0; step < 2000; ++step) {
    const std::vector<RigidState> before = robot.states();
    const std::vector<RigidStep> motions = robot.Step(StepTime(step), StepTime(step + 1));
    for (std::size_t link = 0; link < motions.size(); ++link) {
      const MotionPiece& piece = motions[link].piece;
      const PositionAndVelocity end = Evaluate(piece, piece.t1_ns);
      const RigidState& state = robot.states()[link];
      EXPECT_LT(Norm(Difference(end.position_m, state.position_m)), 1e-12);
      EXPECT_LT(Norm(Difference(end.velocity_m_s, state.velocity_m_s)), 1e-12);
      const Quaternion q = OrientationAt(motions[link].turn, piece.t1_ns);
      EXPECT_LT(Norm(Difference(Rotated(q, {1, 0, 0}), Rotated(state.orientation, {1, 0, 0}))),
                1e-12);
      for (const double t : {0.0, 0.05}) {
        Vector3 a{};
        for (int axis = 0; axis < 3; ++axis) {
          a[axis] = 2 * piece.coefficients[axis][2] + 6 * t * piece.coefficients[axis][3];
        }
        ASSERT_LE(Norm(a), LinkAccelerationMax(options.limits, link)) << step << " " << link;
      }
      fastest = std::max(fastest, Norm(before[link].angular_velocity_rad_s));
    }
  }
  EXPECT_GT(fastest, 0.9);
}

}  // namespace
}  // namespace collision::client
