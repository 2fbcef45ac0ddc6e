#include "server/codec/encode.h"

#include <numbers>

namespace collision::server {
namespace {

// The enumerations of core and wire agree value by value.
static_assert(static_cast<int>(detection::EventStatus::kEnded) == v1::EVENT_ENDED);
static_assert(static_cast<int>(detection::EventStatus::kUndecided) == v1::EVENT_UNDECIDED);
static_assert(static_cast<int>(detection::ExpectedOutcome::kUndecided) == v1::EXPECTED_UNDECIDED);
static_assert(static_cast<int>(narrow_phase::BracketLimit::kGeometry) == v1::LIMIT_GEOMETRY);
static_assert(static_cast<int>(detection::ClearanceCause::kSkew) == v1::CAUSE_SKEW);
static_assert(static_cast<int>(detection::ClearanceCause::kBreach) == v1::CAUSE_BREACH);

v1::Vector3 Encode(const Eigen::Vector3d& v) {
  v1::Vector3 wire;
  wire.set_x(v.x());
  wire.set_y(v.y());
  wire.set_z(v.z());
  return wire;
}

v1::TimeBracket Encode(const detection::TimeBracket& bracket) {
  v1::TimeBracket wire;
  wire.set_earliest_ns(bracket.earliest.nanoseconds());
  wire.set_latest_ns(bracket.latest.nanoseconds());
  return wire;
}

v1::Bracket Encode(double lower, double upper) {
  v1::Bracket wire;
  wire.set_lower(lower);
  wire.set_upper(upper);
  return wire;
}

v1::PairProximity ProximityOf(const detection::CollisionEvent& event) {
  v1::PairProximity wire;
  wire.set_at_ns(event.evaluated_at.nanoseconds());
  *wire.mutable_separation_m() = Encode(event.separation_lower, event.separation_upper);
  wire.set_depth_lower_m(event.depth_lower);
  *wire.mutable_point_m() = Encode(event.p_WC);
  wire.set_point_error_m(event.point_error);
  // An error of half a turn says nothing.
  if (!event.normal.isZero(0) && event.normal_error < std::numbers::pi) {
    *wire.mutable_normal()->mutable_direction() = Encode(event.normal);
    wire.mutable_normal()->set_error_rad(event.normal_error);
  }
  if (event.lower_part) wire.set_lower_part(*event.lower_part);
  if (event.higher_part) wire.set_higher_part(*event.higher_part);
  if (event.relative_velocity) {
    v1::RelativeVelocity* relative = wire.mutable_relative_velocity();
    *relative->mutable_velocity_m_s() = Encode(event.relative_velocity->v_AB);
    relative->set_error_m_s(event.relative_velocity->error);
  }
  return wire;
}

v1::StateUsed Encode(const detection::StateUsed& state) {
  v1::StateUsed wire;
  wire.set_stamp_ns(state.stamp.nanoseconds());
  *wire.mutable_position_m() = Encode(state.p_WA);
  *wire.mutable_velocity_m_s() = Encode(state.v_WA);
  *wire.mutable_acceleration_m_s2() = Encode(state.a_WA);
  return wire;
}

v1::ClosestApproach Encode(const detection::ClosestApproach& closest) {
  v1::ClosestApproach wire;
  wire.set_from_ns(closest.from.nanoseconds());
  wire.set_until_ns(closest.until.nanoseconds());
  *wire.mutable_at() = Encode(closest.at);
  *wire.mutable_distance_m() = Encode(closest.distance.lower, closest.distance.upper);
  return wire;
}

v1::Expectation Encode(const detection::Expectation& expected) {
  v1::Expectation wire;
  wire.set_outcome(static_cast<v1::ExpectedOutcome>(expected.outcome));
  *wire.mutable_begin() = Encode(expected.begin);
  if (expected.closest) *wire.mutable_closest() = Encode(*expected.closest);
  wire.set_until_ns(expected.until.nanoseconds());
  return wire;
}

}  // namespace

v1::AgentId Encode(const detection::AgentId& id) {
  v1::AgentId wire;
  wire.set_simulator_id(id.simulator);
  wire.set_run(id.run);
  wire.set_slot(id.slot);
  wire.set_generation(id.generation);
  return wire;
}

v1::CollisionEvent Encode(const detection::CollisionEvent& event) {
  v1::CollisionEvent wire;
  wire.set_pair_slot(event.pair_slot);
  wire.set_now_ns(event.now.nanoseconds());
  *wire.mutable_lower() = Encode(event.lower);
  *wire.mutable_higher() = Encode(event.higher);
  wire.set_contact(event.contact);
  wire.set_revision(event.revision);
  wire.set_status(static_cast<v1::EventStatus>(event.status));
  *wire.mutable_begin() = Encode(event.begin);
  *wire.mutable_end() = Encode(event.end);
  wire.set_continuous(event.continuous);
  wire.set_began_before(event.began_before);
  wire.set_margin_m(event.margin);
  if (!event.evaluated_at.is_never()) *wire.mutable_proximity() = ProximityOf(event);
  if (event.lower_state) *wire.mutable_lower_state() = Encode(*event.lower_state);
  if (event.higher_state) *wire.mutable_higher_state() = Encode(*event.higher_state);
  if (event.expected) *wire.mutable_expected() = Encode(*event.expected);
  if (event.closest) *wire.mutable_closest() = Encode(*event.closest);
  wire.set_tree_level(event.level);
  wire.set_work_units(event.work);
  wire.set_limited_by(static_cast<v1::EventLimit>(event.limited_by));
  return wire;
}

v1::EarliestIntersection Encode(const detection::EarliestAnswer& answer) {
  v1::EarliestIntersection wire;
  wire.set_found(answer.found);
  wire.set_earliest_ns(answer.earliest.nanoseconds());
  *wire.mutable_lower() = Encode(answer.lower);
  *wire.mutable_higher() = Encode(answer.higher);
  return wire;
}

v1::AgentClearance Encode(const detection::AgentClearance& clearance,
                          std::uint64_t acknowledged_sequence, std::uint32_t acknowledged_revision,
                          Instant state_wanted) {
  v1::AgentClearance wire;
  wire.set_slot(clearance.agent.slot);
  wire.set_generation(clearance.agent.generation);
  wire.set_clear_until_ns(clearance.clear_until.nanoseconds());
  wire.set_not_clear(clearance.not_clear);
  wire.set_saturated(clearance.saturated);
  wire.set_acknowledged_sequence(acknowledged_sequence);
  wire.set_acknowledged_revision(acknowledged_revision);
  wire.set_effective_from_ns(clearance.effective_from.nanoseconds());
  wire.set_cause(static_cast<v1::ClearanceCause>(clearance.cause));
  *wire.mutable_cause_agent() = Encode(clearance.cause_agent);
  wire.set_void_from_ns(clearance.void_from.nanoseconds());
  wire.set_state_wanted_ns(state_wanted.nanoseconds());
  return wire;
}

}  // namespace collision::server
