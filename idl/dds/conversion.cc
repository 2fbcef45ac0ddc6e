#include "idl/dds/conversion.h"

#include <type_traits>

#include "idl/dds/text.h"
#include "idl/dds/wire_values.h"
#include "idl/limits.h"
#include "idl/service_heard.h"

namespace collision::dds {
namespace {

/// Copies a message field by field: into `wire` if kToWire, else out of it. One of the two is
/// const.
template <class Wire>
struct Fields;

template <class List, class Sequence>
void SetList(const char* field, std::size_t bound, const List& list, Sequence& to) {
  Allocate(field, list.size(), bound, to);
  for (int i = 0; i < list.size(); ++i) {
    using Element = std::remove_reference_t<decltype(to._buffer[i])>;
    if constexpr (std::is_array_v<Element>) {
      SetText(field, list[i], to._buffer[i]);
    } else if constexpr (std::is_arithmetic_v<Element>) {
      to._buffer[i] = list[i];
    } else {
      Fields<Element>::template Copy<true>(to._buffer[i], list[i]);
    }
  }
}

template <class Sequence, class List>
void GetList(const Sequence& from, List* list) {
  list->Reserve(static_cast<int>(from._length));
  for (std::uint32_t i = 0; i < from._length; ++i) {
    using Element = std::remove_reference_t<decltype(from._buffer[i])>;
    if constexpr (std::is_array_v<Element>) {
      *list->Add() = GetText(from._buffer[i]);
    } else if constexpr (std::is_arithmetic_v<Element>) {
      list->Add(from._buffer[i]);
    } else {
      Fields<Element>::template Copy<false>(from._buffer[i], *list->Add());
    }
  }
}

// Below, every field is named once: these turn a name into both directions.
#define FIELDS(Type, ...)                              \
  template <>                                          \
  struct Fields<collision_v1_##Type> {                 \
    template <bool kToWire, class Wire, class Message> \
    static void Copy(Wire& wire, Message& message) {   \
      __VA_ARGS__                                      \
    }                                                  \
  };
#define BOTH(put, get)     \
  if constexpr (kToWire) { \
    put;                   \
  } else {                 \
    get;                   \
  }
#define VALUE(x)                                            \
  BOTH(wire.x = static_cast<decltype(wire.x)>(message.x()), \
       message.set_##x(static_cast<decltype(message.x())>(wire.x)))
#define MESSAGE(x)                                                         \
  BOTH(Fields<decltype(wire.x)>::template Copy<true>(wire.x, message.x()), \
       Fields<decltype(wire.x)>::template Copy<false>(wire.x, *message.mutable_##x()))
#define TEXT(x) BOTH(SetText(#x, message.x(), wire.x), message.set_##x(GetText(wire.x)))
#define HASH(x) BOTH(SetHash(#x, message.x(), wire.x), message.set_##x(GetHash(wire.x)))
#define OCTETS(x, bound)                                                  \
  BOTH(Allocate(#x, message.x().size(), bound, wire.x);                   \
       std::copy(message.x().begin(), message.x().end(), wire.x._buffer), \
       message.set_##x(wire.x._buffer, wire.x._length))
#define LIST(x, bound) \
  BOTH(SetList(#x, bound, message.x(), wire.x), GetList(wire.x, message.mutable_##x()))

// Absent, or a sequence of one.
#define OPTIONAL(x)                                                                         \
  BOTH(                                                                                     \
      if (message.has_##x()) {                                                              \
        Allocate(#x, 1, 1, wire.x);                                                         \
        Fields<std::remove_reference_t<decltype(wire.x._buffer[0])>>::template Copy<true>(  \
            wire.x._buffer[0], message.x());                                                \
      },                                                                                    \
      if (wire.x._length > 0) {                                                             \
        Fields<std::remove_reference_t<decltype(wire.x._buffer[0])>>::template Copy<false>( \
            wire.x._buffer[0], *message.mutable_##x());                                     \
      })
#define OPTIONAL_VALUE(x)                \
  BOTH(                                  \
      if (message.has_##x()) {           \
        Allocate(#x, 1, 1, wire.x);      \
        wire.x._buffer[0] = message.x(); \
      },                                 \
      if (wire.x._length > 0) message.set_##x(wire.x._buffer[0]))

// clang-format off
FIELDS(Vector3, VALUE(x) VALUE(y) VALUE(z))
FIELDS(Quaternion, VALUE(w) VALUE(x) VALUE(y) VALUE(z))
FIELDS(KeyValue, TEXT(key) TEXT(value))
FIELDS(Tag, TEXT(key) TEXT(value))
FIELDS(TimeBracket, VALUE(earliest_ns) VALUE(latest_ns))
FIELDS(Bracket, VALUE(lower) VALUE(upper))
FIELDS(AgentId, VALUE(simulator_id) VALUE(run) VALUE(slot) VALUE(generation))
FIELDS(ServiceStamp, VALUE(service_id) VALUE(term) VALUE(epoch) VALUE(sequence))

FIELDS(ServiceHello,
       VALUE(service_id) VALUE(region) VALUE(wire_revision) VALUE(term) VALUE(epoch)
       VALUE(clock_kind) VALUE(skew_max_ns) TEXT(world) TEXT(frame) TEXT(epoch_utc) TEXT(version)
       LIST(regions, wire::kRegionsMax) LIST(extensions, wire::kHelloExtensionsMax))

FIELDS(SimulatorHello,
       VALUE(simulator_id) VALUE(incarnation) VALUE(wire_revision) VALUE(clock_kind)
       TEXT(simulator_name) TEXT(frame) TEXT(version)
       LIST(extensions, wire::kHelloExtensionsMax))

FIELDS(HalfSpace, MESSAGE(normal) VALUE(offset_m))

FIELDS(AgentDescription,
       VALUE(simulator_id) VALUE(slot) VALUE(incarnation) VALUE(run) VALUE(generation)
       VALUE(revision) VALUE(sequence) VALUE(states_sequence) TEXT(simulator_name)
       TEXT(agent_name) VALUE(radius_m)
       VALUE(acceleration_max_m_s2) VALUE(jerk_max_m_s3)
       VALUE(angular_acceleration_max_rad_s2) VALUE(speed_max_m_s)
       VALUE(time_step_s) TEXT(class_name) VALUE(margin_m) HASH(shape_hash) TEXT(assembly)
       LIST(meets_in_assembly, wire::kPartnersListedMax)
       LIST(never_meets, wire::kPartnersListedMax) LIST(tags, wire::kTagsMax)
       OPTIONAL(half_space) VALUE(hypothetical))

FIELDS(ShapePart,
       VALUE(simulator_id) VALUE(shape) VALUE(part) HASH(content_hash) VALUE(parts) VALUE(run)
       VALUE(total_bytes) OCTETS(bytes, collision_v1_SHAPE_PART_BYTES_MAX))

FIELDS(AgentState,
       VALUE(slot) VALUE(generation) VALUE(stamp_ns) VALUE(sequence) MESSAGE(position_m)
       MESSAGE(velocity_m_s) MESSAGE(acceleration_m_s2) MESSAGE(orientation)
       MESSAGE(angular_velocity_rad_s)
       VALUE(position_error_m) VALUE(velocity_error_m_s) VALUE(rotation_error_rad)
       MESSAGE(thrust_direction) VALUE(direction_until_ns) VALUE(expiry_ns) VALUE(discontinuity))

FIELDS(AgentStates,
       VALUE(simulator_id) VALUE(chunk) VALUE(incarnation) VALUE(run)
       LIST(states, collision_v1_STATES_PER_SAMPLE_MAX))

FIELDS(SimulatorClock,
       VALUE(simulator_id) VALUE(incarnation) VALUE(run) TEXT(simulator_name) VALUE(clock_ns)
       VALUE(next_ns) VALUE(states_sequence) VALUE(descriptions_sequence) VALUE(agents)
       VALUE(lock_step) VALUE(service_id) VALUE(service_term) VALUE(clearances_sequence)
       VALUE(epoch) VALUE(echo_ns) VALUE(heard_ns) VALUE(sent_ns))

FIELDS(AgentClearance,
       VALUE(slot) VALUE(generation) VALUE(clear_until_ns) VALUE(not_clear) VALUE(saturated)
       VALUE(acknowledged_sequence) VALUE(acknowledged_revision) VALUE(effective_from_ns)
       VALUE(lowerings) VALUE(cause) MESSAGE(cause_agent) VALUE(void_from_ns)
       VALUE(state_wanted_ns))

FIELDS(Clearance,
       VALUE(simulator_id) VALUE(chunk) VALUE(region) VALUE(run) MESSAGE(stamp) VALUE(now_ns)
       VALUE(granted_until_ns) VALUE(contacts_sequence) VALUE(forecasts_sequence)
       LIST(agents, collision_v1_STATES_PER_CHUNK_MAX) VALUE(incarnation)
       VALUE(screening_sequence))

FIELDS(EarliestIntersection,
       VALUE(service_id) VALUE(region) MESSAGE(stamp) VALUE(now_ns) VALUE(found) VALUE(earliest_ns)
       MESSAGE(lower) MESSAGE(higher))

FIELDS(AgentLabel, TEXT(simulator_name) TEXT(agent_name) TEXT(assembly) LIST(tags, wire::kTagsMax))

FIELDS(SurfaceNormal, MESSAGE(direction) VALUE(error_rad))
FIELDS(RelativeVelocity, MESSAGE(velocity_m_s) VALUE(error_m_s))
FIELDS(PairProximity,
       VALUE(at_ns) MESSAGE(separation_m) VALUE(depth_lower_m) MESSAGE(point_m)
       VALUE(point_error_m) OPTIONAL(normal) OPTIONAL_VALUE(lower_part)
       OPTIONAL_VALUE(higher_part) OPTIONAL(relative_velocity))
FIELDS(StateUsed,
       VALUE(stamp_ns) MESSAGE(position_m) MESSAGE(velocity_m_s) MESSAGE(acceleration_m_s2))
FIELDS(ClosestApproach, VALUE(from_ns) VALUE(until_ns) MESSAGE(at) MESSAGE(distance_m))
FIELDS(Expectation, VALUE(outcome) MESSAGE(begin) OPTIONAL(closest) VALUE(until_ns))

FIELDS(CollisionEvent,
       VALUE(pair_slot) VALUE(region) MESSAGE(stamp) VALUE(now_ns) VALUE(contacts_sequence)
       MESSAGE(lower) MESSAGE(higher) MESSAGE(lower_label) MESSAGE(higher_label) VALUE(contact)
       VALUE(revision) VALUE(status) MESSAGE(begin) MESSAGE(end)
       VALUE(continuous) VALUE(began_before) OPTIONAL(proximity) OPTIONAL(lower_state)
       OPTIONAL(higher_state) OPTIONAL(expected) OPTIONAL(closest) VALUE(tree_level)
       VALUE(work_units) VALUE(limited_by) LIST(extensions, wire::kEventExtensionsMax)
       VALUE(margin_m) TEXT(level))

FIELDS(ScreeningEvent,
       VALUE(simulator_id) VALUE(region) VALUE(pair_slot) VALUE(run) VALUE(incarnation)
       MESSAGE(event))

FIELDS(Rejection,
       VALUE(simulator_id) VALUE(region) MESSAGE(stamp) VALUE(now_ns) VALUE(run) VALUE(run_in_force)
       VALUE(reason) VALUE(topic) VALUE(slot) VALUE(generation) TEXT(field) TEXT(detail)
       VALUE(count) VALUE(incarnation))

FIELDS(StandingRefusal,
       VALUE(reason) VALUE(topic) VALUE(slot) VALUE(generation) TEXT(field) TEXT(detail))

FIELDS(SimulatorReport,
       VALUE(simulator_id) VALUE(region) MESSAGE(stamp) VALUE(now_ns) VALUE(run)
       VALUE(incarnation) TEXT(name)
       VALUE(alive) VALUE(ended) VALUE(descriptions_sequence) VALUE(states_sequence) VALUE(agents)
       VALUE(agents_stated) VALUE(refused) LIST(refusals, wire::kReportRefusalsMax))

FIELDS(AgentBreach,
       VALUE(simulator_id) VALUE(region) VALUE(slot) MESSAGE(stamp) VALUE(now_ns) VALUE(run)
       VALUE(incarnation) VALUE(generation) TEXT(field) VALUE(declared) VALUE(seen) VALUE(from_ns)
       VALUE(at_ns) VALUE(count))

FIELDS(QuotaUse, TEXT(resource) VALUE(used) VALUE(most))

FIELDS(SimulatorStatus,
       VALUE(simulator_id) VALUE(run) TEXT(name) VALUE(alive) VALUE(clock_ns)
       VALUE(granted_until_ns) VALUE(agents) VALUE(states) VALUE(rejected) MESSAGE(clock_offset)
       LIST(quotas, wire::kSimulatorQuotasMax) VALUE(refused_now) TEXT(refused_why))

FIELDS(Counter, TEXT(name) VALUE(value))

FIELDS(Histogram, TEXT(name) LIST(counts, wire::kHistogramCountsMax))

FIELDS(OperatorCommand, VALUE(command_id) VALUE(kind) TEXT(simulator))

FIELDS(Watch, VALUE(watcher_id) VALUE(period_ns) VALUE(lease_ns) VALUE(all)
              LIST(agents, wire::kWatchAgentsMax))

FIELDS(ServiceStatus,
       VALUE(service_id) VALUE(region) MESSAGE(stamp) VALUE(phase) TEXT(version) TEXT(world)
       VALUE(simulated_clock) VALUE(now_ns) VALUE(granted_until_ns) VALUE(lease_ns) VALUE(agents)
       VALUE(pairs_tracked) LIST(simulators, wire::kStatusSimulatorsMax)
       LIST(counters, wire::kStatusCountersMax) TEXT(broad_phase) TEXT(broad_phase_why)
       LIST(left_out, wire::kStatusLeftOutMax) LIST(extensions, wire::kStatusExtensionsMax)
       VALUE(followers)
       VALUE(configuration) TEXT(frame) TEXT(epoch_utc) TEXT(build) VALUE(started_ns)
       VALUE(uptime_ns) VALUE(cpu_us) VALUE(memory_bytes)
       LIST(histograms, wire::kStatusHistogramsMax))
// clang-format on

}  // namespace

template <class Message>
WireSample<typename Carrier<Message>::Wire> ToWire(const Message& message) {
  using Wire = typename Carrier<Message>::Wire;
  const auto release = [](Wire* wire) {
    dds_sample_free(wire, Row(Carrier<Message>::kTopic).type, DDS_FREE_CONTENTS);
    delete wire;
  };
  WireSample<Wire> sample(new Wire{}, release);
  Fields<Wire>::template Copy<true>(*sample, message);
  return sample;
}

template <class Message>
void FromWire(const typename Carrier<Message>::Wire& wire, Message* message) {
  Fields<typename Carrier<Message>::Wire>::template Copy<false>(wire, *message);
}

namespace {

template <class Message>
void Get(const void* wire, Message* message) {
  FromWire(*static_cast<const typename Carrier<Message>::Wire*>(wire), message);
}

}  // namespace

void FromWire(TopicId topic, const void* wire, v1::Input* input) {
  switch (topic) {
    case TopicId::kSimulatorHello:
      return Get(wire, input->mutable_simulator_hello());
    case TopicId::kWatch:
      return Get(wire, input->mutable_watch());
    case TopicId::kSimulatorClock:
      return Get(wire, input->mutable_simulator_clock());
    case TopicId::kAgentDescription:
      return Get(wire, input->mutable_agent_description());
    case TopicId::kShapePart:
      return Get(wire, input->mutable_shape_part());
    case TopicId::kAgentStates:
      return Get(wire, input->mutable_agent_states());
    case TopicId::kOperatorCommand:
      return Get(wire, input->mutable_operator_command());
    case TopicId::kServiceStatus: {
      v1::ServiceStatus status;
      Get(wire, &status);
      status.set_version(Printable(status.version()));
      for (v1::KeyValue& extension : *status.mutable_extensions()) {
        extension.set_value(Printable(extension.value()));
      }
      *input->mutable_service_heard() = HeardOf(status);
      return;
    }
    case TopicId::kContact:
    case TopicId::kForecast:
      return Get(wire, input->mutable_event_heard());
    default:
      throw std::logic_error("not a topic that a service reads");
  }
}

void FromWire(TopicId topic, const void* wire, v1::Output* output) {
  switch (topic) {
    case TopicId::kServiceHello:
      return Get(wire, output->mutable_service_hello());
    case TopicId::kClearance:
      return Get(wire, output->mutable_clearance());
    case TopicId::kEarliestIntersection:
      return Get(wire, output->mutable_earliest_intersection());
    case TopicId::kContact:
    case TopicId::kForecast:
      return Get(wire, output->mutable_collision_event());
    case TopicId::kRejection:
      return Get(wire, output->mutable_rejection());
    case TopicId::kServiceStatus:
      return Get(wire, output->mutable_service_status());
    case TopicId::kSimulatorReport:
      return Get(wire, output->mutable_simulator_report());
    case TopicId::kAgentBreach:
      return Get(wire, output->mutable_agent_breach());
    case TopicId::kScreening:
      return Get(wire, output->mutable_screening_event());
    default:
      throw std::logic_error("not a topic of the service");
  }
}

#define BOTH_WAYS(Message)                                                             \
  template WireSample<collision_v1_##Message> ToWire<v1::Message>(const v1::Message&); \
  template void FromWire<v1::Message>(const collision_v1_##Message&, v1::Message*);
BOTH_WAYS(SimulatorHello)
BOTH_WAYS(ServiceHello)
BOTH_WAYS(Watch)
BOTH_WAYS(SimulatorClock)
BOTH_WAYS(AgentDescription)
BOTH_WAYS(ShapePart)
BOTH_WAYS(AgentStates)
BOTH_WAYS(Clearance)
BOTH_WAYS(EarliestIntersection)
BOTH_WAYS(CollisionEvent)
BOTH_WAYS(Rejection)
BOTH_WAYS(ServiceStatus)
BOTH_WAYS(SimulatorReport)
BOTH_WAYS(AgentBreach)
BOTH_WAYS(ScreeningEvent)
BOTH_WAYS(OperatorCommand)

}  // namespace collision::dds
