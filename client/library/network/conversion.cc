#include "client/library/network/conversion.h"

#include "collision/shape.h"

namespace collision::client {
namespace {

/// On the wire every angular acceleration below 0 stands for one that is not declared.
constexpr double kTurnNotDeclared = -1;

void Set(const Vector3& from, v1::Vector3* to) {
  to->set_x(from[0]);
  to->set_y(from[1]);
  to->set_z(from[2]);
}

Vector3 VectorOf(const v1::Vector3& vector) { return {vector.x(), vector.y(), vector.z()}; }

TimeBracket BracketOf(const v1::TimeBracket& bracket) {
  return {bracket.earliest_ns(), bracket.latest_ns()};
}

template <class Tags>
std::vector<Tag> TagsOf(const Tags& message) {
  std::vector<Tag> tags;
  for (const v1::Tag& tag : message) tags.push_back({tag.key(), tag.value()});
  return tags;
}

AgentLabel LabelOf(const v1::AgentLabel& message) {
  return {message.simulator_name(), message.agent_name(), message.assembly(),
          TagsOf(message.tags())};
}

bool IsLasting(v1::RejectionReason reason) {
  switch (reason) {
    case v1::REJECTED_NOT_FINITE:
    case v1::REJECTED_OUT_OF_RANGE:
    case v1::REJECTED_ID_MISMATCH:
    case v1::REJECTED_FUTURE_STAMP:
    case v1::REJECTED_TOO_MANY_AGENTS:
    case v1::REJECTED_TOO_MANY_SIMULATORS:
    case v1::REJECTED_OLD_RUN:
    case v1::REJECTED_CLOCK_BEYOND_GRANT:
    case v1::REJECTED_CHUNK_TOO_LARGE:
    case v1::REJECTED_BAD_SHAPE:
    case v1::REJECTED_MISMATCH:
      return true;
    default:
      return false;
  }
}

SimulatorStatus SimulatorStatusOf(const v1::SimulatorStatus& message) {
  SimulatorStatus status;
  status.simulator = message.simulator_id();
  status.name = message.name();
  status.run = message.run();
  status.alive = message.alive();
  status.clock_ns = message.clock_ns();
  status.granted_until_ns = message.granted_until_ns();
  status.agents = message.agents();
  status.states = message.states();
  status.rejected = message.rejected();
  if (message.has_clock_offset()) status.clock_offset = BracketOf(message.clock_offset());
  for (const v1::QuotaUse& use : message.quotas())
    status.quotas[use.resource()] = {use.used(), use.most()};
  status.refused_now = message.refused_now();
  status.refused_why = message.refused_why();
  return status;
}

Proximity ProximityOf(const v1::PairProximity& message) {
  Proximity proximity;
  proximity.at_ns = message.at_ns();
  proximity.separation_lower_m = message.separation_m().lower();
  proximity.separation_upper_m = message.separation_m().upper();
  proximity.depth_lower_m = message.depth_lower_m();
  proximity.point_m = VectorOf(message.point_m());
  proximity.point_error_m = message.point_error_m();
  if (message.has_normal()) {
    proximity.normal = {VectorOf(message.normal().direction()), message.normal().error_rad()};
  }
  if (message.has_lower_part()) proximity.lower_part = message.lower_part();
  if (message.has_higher_part()) proximity.higher_part = message.higher_part();
  if (message.has_relative_velocity()) {
    const v1::RelativeVelocity& relative = message.relative_velocity();
    proximity.relative_velocity = {VectorOf(relative.velocity_m_s()), relative.error_m_s()};
  }
  return proximity;
}

StateUsed StateOf(const v1::StateUsed& message) {
  return {message.stamp_ns(), VectorOf(message.position_m()), VectorOf(message.velocity_m_s()),
          VectorOf(message.acceleration_m_s2())};
}

ClosestApproach ClosestOf(const v1::ClosestApproach& message) {
  return {message.from_ns(), message.until_ns(), BracketOf(message.at()),
          message.distance_m().lower(), message.distance_m().upper()};
}

Expectation ExpectationOf(const v1::Expectation& message) {
  Expectation expected;
  expected.outcome = static_cast<ExpectedOutcome>(message.outcome());
  expected.begin = BracketOf(message.begin());
  if (message.has_closest()) expected.closest = ClosestOf(message.closest());
  expected.until_ns = message.until_ns();
  return expected;
}

}  // namespace

v1::AgentDescription ToMessage(const AgentDescription& description) {
  v1::AgentDescription message;
  message.set_agent_name(description.name);
  const double shape_radius = description.shape ? description.shape->radius_m() : 0;
  message.set_radius_m(description.radius_m.value_or(shape_radius));
  message.set_acceleration_max_m_s2(description.acceleration_max_m_s2.value_or(0));
  message.set_margin_m(description.margin_m);
  message.set_jerk_max_m_s3(description.jerk_max_m_s3);
  message.set_angular_acceleration_max_rad_s2(
      description.angular_acceleration_max_rad_s2.value_or(kTurnNotDeclared));
  message.set_speed_max_m_s(description.speed_max_m_s.value_or(0));
  message.set_time_step_s(description.time_step_s.value_or(0));
  message.set_class_name(description.class_name);
  message.set_assembly(description.assembly);
  for (const std::string& name : description.meets_in_assembly) message.add_meets_in_assembly(name);
  for (const std::string& name : description.never_meets) message.add_never_meets(name);
  for (const Tag& tag : description.tags) {
    v1::Tag& added = *message.add_tags();
    added.set_key(tag.key);
    added.set_value(tag.value);
  }
  if (description.shape) message.set_shape_hash(description.shape->hash());
  if (description.half_space) {
    Set(description.half_space->normal, message.mutable_half_space()->mutable_normal());
    message.mutable_half_space()->set_offset_m(description.half_space->offset_m);
  }
  message.set_hypothetical(description.hypothetical);
  return message;
}

v1::AgentState ToMessage(const State& state) {
  v1::AgentState message;
  message.set_stamp_ns(state.stamp_ns);
  Set(state.position_m, message.mutable_position_m());
  Set(state.velocity_m_s, message.mutable_velocity_m_s());
  Set(state.acceleration_m_s2, message.mutable_acceleration_m_s2());
  v1::Quaternion* orientation = message.mutable_orientation();
  orientation->set_w(state.orientation[0]);
  orientation->set_x(state.orientation[1]);
  orientation->set_y(state.orientation[2]);
  orientation->set_z(state.orientation[3]);
  Set(state.angular_velocity_rad_s, message.mutable_angular_velocity_rad_s());
  message.set_position_error_m(state.position_error_m);
  message.set_velocity_error_m_s(state.velocity_error_m_s);
  message.set_rotation_error_rad(state.rotation_error_rad);
  Set(state.thrust_direction.value_or(Vector3{}), message.mutable_thrust_direction());
  message.set_direction_until_ns(state.direction_until_ns);
  message.set_expiry_ns(state.expiry_ns.value_or(kNever));
  message.set_discontinuity(state.discontinuity);
  return message;
}

AgentId FromMessage(const v1::AgentId& id) {
  return {id.simulator_id(), id.run(), id.slot(), id.generation()};
}

State FromMessage(const v1::AgentState& message) {
  State state;
  state.stamp_ns = message.stamp_ns();
  state.position_m = VectorOf(message.position_m());
  state.velocity_m_s = VectorOf(message.velocity_m_s());
  state.acceleration_m_s2 = VectorOf(message.acceleration_m_s2());
  const v1::Quaternion& orientation = message.orientation();
  state.orientation = {orientation.w(), orientation.x(), orientation.y(), orientation.z()};
  state.angular_velocity_rad_s = VectorOf(message.angular_velocity_rad_s());
  state.position_error_m = message.position_error_m();
  state.velocity_error_m_s = message.velocity_error_m_s();
  state.rotation_error_rad = message.rotation_error_rad();
  const Vector3 direction = VectorOf(message.thrust_direction());
  if (direction != Vector3{}) state.thrust_direction = direction;
  state.direction_until_ns = message.direction_until_ns();
  if (message.expiry_ns() != kNever) state.expiry_ns = message.expiry_ns();
  state.discontinuity = message.discontinuity();
  return state;
}

DescribedAgent FromMessage(const v1::AgentDescription& message) {
  DescribedAgent agent;
  agent.id = {message.simulator_id(), message.run(), message.slot(), message.generation()};
  agent.simulator = message.simulator_name();
  agent.revision = message.revision();
  agent.description.name = message.agent_name();
  agent.description.radius_m = message.radius_m();
  agent.description.margin_m = message.margin_m();
  agent.description.acceleration_max_m_s2 = message.acceleration_max_m_s2();
  agent.description.jerk_max_m_s3 = message.jerk_max_m_s3();
  if (message.angular_acceleration_max_rad_s2() >= 0) {
    agent.description.angular_acceleration_max_rad_s2 = message.angular_acceleration_max_rad_s2();
  }
  if (message.speed_max_m_s() > 0) agent.description.speed_max_m_s = message.speed_max_m_s();
  if (message.time_step_s() > 0) agent.description.time_step_s = message.time_step_s();
  agent.description.class_name = message.class_name();
  agent.description.assembly = message.assembly();
  agent.description.meets_in_assembly.assign(message.meets_in_assembly().begin(),
                                             message.meets_in_assembly().end());
  agent.description.never_meets.assign(message.never_meets().begin(), message.never_meets().end());
  agent.description.tags = TagsOf(message.tags());
  agent.description.hypothetical = message.hypothetical();
  agent.shape_hash = message.shape_hash();
  if (message.has_half_space()) {
    agent.description.half_space = {VectorOf(message.half_space().normal()),
                                    message.half_space().offset_m()};
  }
  return agent;
}

SimulatorClock FromMessage(const v1::SimulatorClock& message) {
  return {message.simulator_id(), message.simulator_name(), message.run(),
          message.clock_ns(),     message.agents(),         message.lock_step()};
}

Event FromMessage(const v1::CollisionEvent& message) {
  Event event;
  event.lower = FromMessage(message.lower());
  event.higher = FromMessage(message.higher());
  event.lower_label = LabelOf(message.lower_label());
  event.higher_label = LabelOf(message.higher_label());
  event.contact = message.contact();
  event.revision = message.revision();
  event.now_ns = message.now_ns();
  event.contacts_sequence = message.contacts_sequence();
  event.status = static_cast<EventStatus>(message.status());
  event.begin = BracketOf(message.begin());
  event.end = BracketOf(message.end());
  event.continuous = message.continuous();
  event.began_before = message.began_before();
  event.margin_m = message.margin_m();
  if (message.has_proximity()) event.proximity = ProximityOf(message.proximity());
  if (message.has_lower_state()) event.lower_state = StateOf(message.lower_state());
  if (message.has_higher_state()) event.higher_state = StateOf(message.higher_state());
  if (message.has_expected()) event.expected = ExpectationOf(message.expected());
  if (message.has_closest()) event.closest = ClosestOf(message.closest());
  event.level = message.level();
  event.tree_level = message.tree_level();
  event.work_units = message.work_units();
  event.limited_by = static_cast<EventLimit>(message.limited_by());
  for (const v1::KeyValue& extension : message.extensions()) {
    if (extension.key() == "because") event.because = extension.value();
  }
  return event;
}

Clearance FromMessage(const v1::AgentClearance& message) {
  Clearance clearance;
  clearance.clear_until_ns = message.clear_until_ns();
  clearance.not_clear = message.not_clear();
  clearance.saturated = message.saturated();
  clearance.effective_from_ns = message.effective_from_ns();
  clearance.lowerings = message.lowerings();
  if (message.cause() != v1::CAUSE_NONE) clearance.cause = v1::ClearanceCause_Name(message.cause());
  clearance.cause_agent = FromMessage(message.cause_agent());
  clearance.void_from_ns = message.void_from_ns();
  clearance.state_wanted_ns = message.state_wanted_ns();
  return clearance;
}

Rejection FromMessage(const v1::Rejection& message) {
  Rejection rejection;
  rejection.simulator = message.simulator_id();
  rejection.reason = v1::RejectionReason_Name(message.reason());
  rejection.topic = v1::InputTopic_Name(message.topic());
  rejection.slot = message.slot();
  rejection.field = message.field();
  rejection.detail = message.detail();
  rejection.count = message.count();
  rejection.lasting = IsLasting(message.reason());
  return rejection;
}

Rejection FromMessage(const v1::StandingRefusal& refusal, const v1::SimulatorReport& report) {
  Rejection rejection;
  rejection.simulator = report.simulator_id();
  rejection.reason = v1::RejectionReason_Name(refusal.reason());
  rejection.topic = v1::InputTopic_Name(refusal.topic());
  rejection.slot = refusal.slot();
  rejection.field = refusal.field();
  rejection.detail = refusal.detail();
  rejection.count = report.refused();
  rejection.lasting = IsLasting(refusal.reason());
  return rejection;
}

Breach FromMessage(const v1::AgentBreach& message) {
  return {{message.simulator_id(), message.run(), message.slot(), message.generation()},
          message.field(),
          message.declared(),
          message.seen(),
          message.from_ns(),
          message.at_ns(),
          message.count()};
}

EarliestIntersection FromMessage(const v1::EarliestIntersection& message) {
  return {message.now_ns(), message.found(), message.earliest_ns(), FromMessage(message.lower()),
          FromMessage(message.higher())};
}

ServiceStatus FromMessage(const v1::ServiceStatus& message) {
  ServiceStatus status;
  status.service = message.service_id();
  status.term = message.stamp().term();
  status.version = message.version();
  status.world = message.world();
  status.lock_step = message.simulated_clock();
  status.now_ns = message.now_ns();
  status.agents = message.agents();
  status.pairs_tracked = message.pairs_tracked();
  for (const v1::SimulatorStatus& simulator : message.simulators()) {
    status.simulators.push_back(SimulatorStatusOf(simulator));
  }
  for (const v1::Counter& counter : message.counters()) {
    status.counters[counter.name()] = counter.value();
  }
  status.broad_phase = message.broad_phase();
  status.broad_phase_why = message.broad_phase_why();
  status.left_out.assign(message.left_out().begin(), message.left_out().end());
  status.build = message.build();
  status.started_ns = message.started_ns();
  status.uptime_ns = message.uptime_ns();
  status.cpu_us = message.cpu_us();
  status.memory_bytes = message.memory_bytes();
  for (const v1::Histogram& histogram : message.histograms()) {
    status.histograms[histogram.name()].assign(histogram.counts().begin(),
                                               histogram.counts().end());
  }
  return status;
}

}  // namespace collision::client
