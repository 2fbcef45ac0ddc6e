#include "tests/fuzz/fuzzed_messages.h"

#include <google/protobuf/stubs/logging.h>

#include <stdexcept>

#include "idl/dds/conversion.h"
#include "idl/limits.h"
#include "server/codec/codec.h"
#include "tests/server/messages.h"
#include "tests/server/shapes/shapes.h"

namespace collision::fuzz {
namespace {

using server::From;

constexpr std::int64_t kStepNs = 50'000'000;
constexpr std::int64_t kFarNs[] = {0,
                                   1,
                                   -1,
                                   server::kNeverNs,
                                   -server::kNeverNs - 1,
                                   std::int64_t{1} << 62,
                                   -(std::int64_t{1} << 62)};
constexpr const char* kSimulators[] = {"alpha", "beta", "gamma", ""};
constexpr std::size_t kSlots = 4;

std::uint64_t SenderOf(const std::string& simulator, FuzzedData* data) {
  const std::uint64_t own = 10 + simulator.size();
  return data->Byte() < 240 ? own : data->Below(20);
}

std::int64_t TimeNear(std::int64_t now_ns, FuzzedData* data) {
  const std::uint8_t kind = data->Byte();
  if (kind == 255) return data->OneOf(kFarNs);
  if (kind == 254) return static_cast<std::int64_t>(data->Bits(8));
  const std::uint64_t steps = static_cast<std::uint64_t>((kind % 32 - 8) * kStepNs);
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(now_ns) + steps);
}

std::uint32_t Small(FuzzedData* data) {
  const std::uint8_t kind = data->Byte();
  return kind == 255 ? static_cast<std::uint32_t>(data->Bits(4)) : 1 + kind % 2;
}

void Spoil(v1::Vector3* v, double greatest, FuzzedData* data) {
  v->set_x(data->Wild(greatest));
  v->set_y(data->Wild(greatest));
  v->set_z(data->Wild(greatest));
}

/// Some that fit, some that do not, and a hash that nothing has.
std::string ShapeBytes(FuzzedData* data) {
  static const std::string kWhole[] = {
      EncodeShape(server::Cube(1)), EncodeShape(server::FineCube(2)),
      EncodeShape({.vertices = {},
                   .triangles = {},
                   .solids = {{.kind = SolidKind::kBox, .half_extents = {1, 0.5, 0.25}}}}),
      EncodeShape({.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}}})};
  if (data->Byte() < 200) return data->OneOf(kWhole);
  std::string bytes = data->OneOf(kWhole);
  bytes[data->Bits(2) % bytes.size()] = static_cast<char>(data->Byte());
  return bytes;
}

v1::Input FuzzedStates(const std::string& simulator, std::int64_t now_ns, FuzzedData* data) {
  v1::AgentStates chunk = server::Chunk(simulator);
  const std::uint8_t kind = data->Byte();
  if (kind >= 240) chunk.set_run(Small(data));
  if (kind >= 250) chunk.set_chunk(static_cast<std::uint32_t>(data->Bits(4)));
  const int states = kind % 4 + (kind == 239 ? wire::kStatesPerSampleMax : 0);
  for (int i = 0; i < states; ++i) *chunk.add_states() = FuzzedState(now_ns, data);
  return From(SenderOf(simulator, data), chunk);
}

v1::Input FuzzedClock(const std::string& simulator, std::int64_t now_ns, FuzzedData* data) {
  v1::SimulatorClock wire = server::ClockOf(simulator, TimeNear(now_ns, data));
  const std::uint8_t spoilt = data->Byte();
  if (spoilt & 1) wire.set_states_sequence(data->Bits(2));
  if (spoilt & 2) wire.set_descriptions_sequence(data->Bits(2));
  if (spoilt & 4) wire.set_lock_step(data->Flag());
  if (spoilt & 8) wire.set_run(Small(data));
  if (spoilt & 16) wire.set_agents(static_cast<std::uint32_t>(data->Bits(4)));
  if ((spoilt & 224) == 224) wire.set_simulator_name(data->Text(80));
  return From(SenderOf(simulator, data), wire);
}

v1::Input FuzzedPart(const std::string& simulator, FuzzedData* data) {
  v1::ShapePart part = server::PartsOf(simulator, ShapeBytes(data)).front();
  const std::uint8_t spoilt = data->Byte();
  if (spoilt > 200) {
    part.set_part(static_cast<std::uint32_t>(data->Bits(1)));
    part.set_parts(static_cast<std::uint32_t>(data->Bits(data->Below(5))));
    part.set_total_bytes(data->Bits(data->Below(9)));
  }
  if (spoilt > 240) part.set_run(Small(data));
  if (spoilt % 16 == 1) part.set_bytes(data->Text(200));
  if (spoilt % 16 == 2) part.set_content_hash(Sha256(part.bytes()));
  if (spoilt % 16 == 3) part.set_content_hash(data->Text(40));
  return From(SenderOf(simulator, data), part);
}

v1::Input FuzzedEnd(const std::string& simulator, FuzzedData* data) {
  const std::uint64_t sender = SenderOf(simulator, data);
  switch (data->Below(4)) {
    case 0:
      return server::Liveliness(sender, simulator, data->Flag());
    case 1:
      return server::RemovalsOf(sender, server::PartsOf(simulator, ShapeBytes(data))).front();
    default:
      return server::Removal(sender, simulator, static_cast<std::uint32_t>(data->Below(kSlots)));
  }
}

/// Any bytes that are a message at all.
v1::Input AnyInput(FuzzedData* data) {
  const google::protobuf::LogSilencer silent;
  v1::Input input;
  if (!input.ParseFromString(data->Text(512))) input.Clear();
  // Only the daemon itself says that a shape is ready, and only of one that it has started.
  if (input.has_shape_ready()) input.Clear();
  return input;
}

template <class Message>
void ThereAndBack(Message* message) {
  const auto wire = dds::ToWire(*message);
  dds::FromWire(*wire, message);
}

}  // namespace

v1::AgentDescription FuzzedDeclaration(const std::string& simulator, FuzzedData* data) {
  v1::AgentDescription wire =
      server::Description(simulator, static_cast<std::uint32_t>(data->Below(kSlots)));
  const std::uint64_t spoilt = data->Bits(2);
  if (spoilt & 1) wire.set_radius_m(data->Wild(wire::kRadiusMax));
  if (spoilt & 2) wire.set_acceleration_max_m_s2(data->Wild(wire::kAccelerationMax));
  if (spoilt & 4) wire.set_angular_acceleration_max_rad_s2(data->Wild(wire::kAccelerationMax));
  if (spoilt & 8) wire.set_speed_max_m_s(data->Wild(wire::kSpeedMax));
  if (spoilt & 16) wire.set_time_step_s(data->Wild(wire::kTimeStepMax));
  if (spoilt & 32) wire.set_assembly(std::string(data->Bits(1) & 1, 'a'));
  if (spoilt & 64) wire.add_never_meets(std::string(data->Bits(1) & 65, 'b'));
  if (spoilt & 128) wire.set_shape_hash(Sha256(ShapeBytes(data)));
  if (spoilt & 256) wire.set_run(Small(data));
  if (spoilt & 512) wire.set_generation(Small(data));
  if (spoilt & 1024) wire.set_revision(Small(data));
  if (spoilt & 2048) wire.set_sequence(data->Bits(data->Below(9)));
  if (spoilt & 4096) wire.set_slot(static_cast<std::uint32_t>(data->Bits(4)));
  if (spoilt & 8192) wire.set_agent_name(data->Text(80));
  if (spoilt & 16384) wire.set_simulator_name(data->Text(80));
  if (spoilt & 32768) wire.set_states_sequence(data->Bits(2));
  return wire;
}

v1::AgentState FuzzedState(std::int64_t now_ns, FuzzedData* data) {
  v1::AgentState wire = server::State(static_cast<std::uint32_t>(data->Below(kSlots)),
                                      TimeNear(now_ns, data), data->Bits(2));
  const std::uint64_t spoilt = data->Bits(2);
  wire.mutable_position_m()->set_x(data->Within(wire::kCoordinateMax));
  if (spoilt & 1) Spoil(wire.mutable_position_m(), wire::kCoordinateMax, data);
  if (spoilt & 2) Spoil(wire.mutable_velocity_m_s(), wire::kSpeedMax, data);
  if (spoilt & 4) {
    wire.mutable_orientation()->set_w(data->Wild(2));
    wire.mutable_orientation()->set_x(data->Wild(2));
    wire.mutable_orientation()->set_y(data->Wild(2));
  }
  if (spoilt & 8) Spoil(wire.mutable_angular_velocity_rad_s(), wire::kAngularSpeedMax, data);
  if (spoilt & 16) wire.set_position_error_m(data->Wild(wire::kRadiusMax));
  if (spoilt & 32) wire.set_velocity_error_m_s(data->Wild(wire::kSpeedMax));
  if (spoilt & 64) wire.set_rotation_error_rad(data->Wild(wire::kRotationErrorMax));
  if (spoilt & 128) Spoil(wire.mutable_thrust_direction(), 2, data);
  if (spoilt & 256) wire.mutable_thrust_direction()->set_z(data->Flag() ? 1 : -1);
  if (spoilt & 512) wire.set_direction_until_ns(TimeNear(now_ns, data));
  if (spoilt & 1024) wire.set_expiry_ns(TimeNear(now_ns, data));
  if (spoilt & 2048) wire.set_discontinuity(true);
  if (spoilt & 4096) wire.set_generation(Small(data));
  if (spoilt & 8192) wire.set_slot(static_cast<std::uint32_t>(data->Bits(4)));
  return wire;
}

v1::Input FuzzedInput(std::int64_t now_ns, FuzzedData* data) {
  const std::string simulator = data->OneOf(kSimulators);
  switch (data->Below(12)) {
    case 0:
    case 1:
    case 2:
      return From(SenderOf(simulator, data), FuzzedDeclaration(simulator, data));
    case 3:
    case 4:
    case 5:
    case 6:
      return FuzzedStates(simulator, now_ns, data);
    case 7:
    case 8:
      return FuzzedClock(simulator, now_ns, data);
    case 9:
      return FuzzedPart(simulator, data);
    case 10:
      return FuzzedEnd(simulator, data);
    default:
      return AnyInput(data);
  }
}

bool ThroughNetwork(v1::Input* input) {
  try {
    if (input->has_agent_description()) ThereAndBack(input->mutable_agent_description());
    if (input->has_agent_states()) ThereAndBack(input->mutable_agent_states());
    if (input->has_simulator_clock()) ThereAndBack(input->mutable_simulator_clock());
    if (input->has_shape_part()) ThereAndBack(input->mutable_shape_part());
  } catch (const std::length_error&) {
    return false;
  }
  return input->message_case() != v1::Input::MESSAGE_NOT_SET;
}

}  // namespace collision::fuzz
