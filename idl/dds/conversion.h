// Between the messages in memory (protobuf) and on the network (the C types that idlc made).
#pragma once

#include <memory>

#include "idl/dds/topics.h"
#include "idl/messages.pb.h"

namespace collision::dds {

/// A sample on its way out. Owns its sequences.
template <class Wire>
using WireSample = std::unique_ptr<Wire, void (*)(Wire*)>;

/// Which topic and which C type carry a message.
template <class Message>
struct Carrier;

#define COLLISION_CARRIER(Message, topic)             \
  template <>                                         \
  struct Carrier<v1::Message> {                       \
    using Wire = collision_v1_##Message;              \
    static constexpr TopicId kTopic = TopicId::topic; \
  };

COLLISION_CARRIER(SimulatorHello, kSimulatorHello)
COLLISION_CARRIER(ServiceHello, kServiceHello)
COLLISION_CARRIER(Watch, kWatch)
COLLISION_CARRIER(SimulatorClock, kSimulatorClock)
COLLISION_CARRIER(AgentDescription, kAgentDescription)
COLLISION_CARRIER(ShapePart, kShapePart)
COLLISION_CARRIER(AgentStates, kAgentStates)
COLLISION_CARRIER(Clearance, kClearance)
COLLISION_CARRIER(EarliestIntersection, kEarliestIntersection)
COLLISION_CARRIER(CollisionEvent, kContact)  // and kForecast
COLLISION_CARRIER(Rejection, kRejection)
COLLISION_CARRIER(ServiceStatus, kServiceStatus)
COLLISION_CARRIER(SimulatorReport, kSimulatorReport)
COLLISION_CARRIER(AgentBreach, kAgentBreach)
COLLISION_CARRIER(ScreeningEvent, kScreening)
COLLISION_CARRIER(OperatorCommand, kOperatorCommand)
#undef COLLISION_CARRIER

/// Throws std::length_error, naming field and bound, if a text, list or byte field is longer than
/// the IDL allows: the network has no form for it.
template <class Message>
WireSample<typename Carrier<Message>::Wire> ToWire(const Message& message);

/// Never fails: whatever the network can carry is a message. Bytes of a text that are not UTF-8
/// become '?', since protobuf could write but not read them.
template <class Message>
void FromWire(const typename Carrier<Message>::Wire& wire, Message* message);

/// Puts a sample of a simulators' (service's) topic into the message of that topic.
void FromWire(TopicId topic, const void* wire, v1::Input* input);
void FromWire(TopicId topic, const void* wire, v1::Output* output);

}  // namespace collision::dds
