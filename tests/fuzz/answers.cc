#include "tests/fuzz/answers.h"

#include <cmath>
#include <limits>
#include <ostream>
#include <tuple>

#include "idl/dds/conversion.h"
#include "tests/fuzz/targets.h"

namespace collision::fuzz {
namespace {

constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();
constexpr double kPi = 3.1415926535897936;  // rounded up

/// Written out only where something is wrong with it.
struct Shown {
  const google::protobuf::Message& message;
  friend std::ostream& operator<<(std::ostream& stream, const Shown& shown) {
    return stream << shown.message.ShortDebugString();
  }
};

auto Order(const v1::AgentId& id) {
  return std::tuple(id.simulator_id(), id.slot(), id.run(), id.generation());
}

void CheckVector(const v1::Vector3& vector, const Shown& text) {
  for (const double value : {vector.x(), vector.y(), vector.z()}) {
    Require(std::isfinite(value), "not finite: ", text);
  }
}

void CheckProximity(const v1::PairProximity& proximity, const Shown& text) {
  const v1::Bracket& separation = proximity.separation_m();
  Require(separation.lower() <= separation.upper(), "separation is not ordered: ", text);
  Require(proximity.depth_lower_m() >= 0 && std::isfinite(proximity.depth_lower_m()),
          "depth: ", text);
  Require(proximity.point_error_m() >= 0, "point_error_m: ", text);
  CheckVector(proximity.point_m(), text);
  if (proximity.has_relative_velocity()) {
    CheckVector(proximity.relative_velocity().velocity_m_s(), text);
    Require(proximity.relative_velocity().error_m_s() >= 0, "error of the velocity: ", text);
  }
  if (!proximity.has_normal()) return;
  const v1::Vector3& normal = proximity.normal().direction();
  const double error = proximity.normal().error_rad();
  Require(error >= 0 && error < kPi, "normal's error: ", text);
  const double length = std::hypot(normal.x(), normal.y(), normal.z());
  Require(std::abs(length - 1) < 1e-9, "normal of length ", length, ": ", text);
}

void CheckClosest(const v1::ClosestApproach& closest, const Shown& text) {
  Require(closest.distance_m().lower() <= closest.distance_m().upper(),
          "closest distance is not ordered: ", text);
  Require(closest.from_ns() <= closest.at().earliest_ns() &&
              closest.at().earliest_ns() <= closest.at().latest_ns() &&
              closest.at().latest_ns() <= closest.until_ns(),
          "closest approach is not within its span: ", text);
}

void CheckNumbers(const v1::CollisionEvent& event, const Shown& text) {
  if (event.has_proximity()) CheckProximity(event.proximity(), text);
  if (event.has_closest()) CheckClosest(event.closest(), text);
  Require(!event.has_expected() || event.status() == v1::EVENT_POSSIBLE,
          "only a possible event is expected to be anything: ", text);
  if (event.expected().has_closest()) CheckClosest(event.expected().closest(), text);
}

void CheckTimes(const v1::CollisionEvent& event, const Shown& text) {
  const v1::TimeBracket &begin = event.begin(), &end = event.end();
  Require(begin.earliest_ns() <= begin.latest_ns(), "begin is not ordered: ", text);
  Require(end.earliest_ns() <= end.latest_ns(), "end is not ordered: ", text);
  Require(begin.earliest_ns() <= end.latest_ns(), "ends before it begins: ", text);
  const bool begun = begin.latest_ns() != kNever;
  switch (event.status()) {
    // The end of an ended one is unknown where its agent expired.
    case v1::EVENT_CONFIRMED:
    case v1::EVENT_ENDED:
      Require(begun && begin.latest_ns() <= end.earliest_ns(), "begins after it ends: ", text);
      break;
    case v1::EVENT_POSSIBLE:
      Require(!begun, "possible, and begun: ", text);
      break;
    default:
      break;
  }
}

}  // namespace

void CheckEvent(const v1::CollisionEvent& event) {
  const Shown text{event};
  Require(Order(event.lower()) < Order(event.higher()), "lower is not lower: ", text);
  Require(event.contact() >= 1 && event.revision() >= 1, "contact, revision: ", text);
  Require(v1::EventStatus_IsValid(event.status()), "status: ", text);
  CheckTimes(event, text);
  CheckNumbers(event, text);
}

void CheckClearance(const v1::Clearance& clearance) {
  for (const v1::AgentClearance& agent : clearance.agents()) {
    const Shown text{agent};
    Require(agent.not_clear() || agent.clear_until_ns() > clearance.now_ns(),
            "clear until what has passed, at ", clearance.now_ns(), ": ", text);
    Require(agent.void_from_ns() == kNever || agent.cause() == v1::CAUSE_BREACH,
            "void without a breach: ", text);
  }
}

void CheckEarliest(const v1::EarliestIntersection& earliest) {
  const Shown text{earliest};
  if (!earliest.found()) {
    Require(earliest.earliest_ns() == kNever, "not found, and a time: ", text);
    return;
  }
  Require(earliest.earliest_ns() >= earliest.now_ns(), "earlier than now: ", text);
  Require(Order(earliest.lower()) < Order(earliest.higher()), "lower is not lower: ", text);
}

void CheckOutput(const v1::Output& output) {
  switch (output.message_case()) {
    case v1::Output::kCollisionEvent:
      CheckEvent(output.collision_event());
      dds::ToWire(output.collision_event());
      break;
    case v1::Output::kClearance:
      CheckClearance(output.clearance());
      dds::ToWire(output.clearance());
      break;
    case v1::Output::kEarliestIntersection:
      CheckEarliest(output.earliest_intersection());
      dds::ToWire(output.earliest_intersection());
      break;
    case v1::Output::kRejection:
      Require(output.rejection().count() >= 1, "a rejection that was not counted");
      dds::ToWire(output.rejection());
      break;
    case v1::Output::kSimulatorReport:
      Require(output.simulator_report().agents_stated() <= output.simulator_report().agents(),
              "more agents with a state than agents");
      dds::ToWire(output.simulator_report());
      break;
    case v1::Output::kAgentBreach:
      Require(output.agent_breach().count() >= 1, "a breach that was not counted");
      Require(output.agent_breach().seen() >= output.agent_breach().declared(),
              "seen is what was allowed: ", Shown{output.agent_breach()});
      Require(output.agent_breach().from_ns() <= output.agent_breach().at_ns(),
              "a breach backward in time: ", Shown{output.agent_breach()});
      dds::ToWire(output.agent_breach());
      break;
    case v1::Output::kScreeningEvent:
      CheckEvent(output.screening_event().event());
      dds::ToWire(output.screening_event());
      break;
    case v1::Output::kServiceStatus:
      dds::ToWire(output.service_status());
      break;
    case v1::Output::kServiceHello:
      dds::ToWire(output.service_hello());
      break;
    case v1::Output::MESSAGE_NOT_SET:
      throw BrokenPromise("an output without a message");
  }
}

}  // namespace collision::fuzz
