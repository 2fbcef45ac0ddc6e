// A read-only view of a world: what simulators and the service publish.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace collision::v1 {
class CollisionEvent;
class EarliestIntersection;
class ServiceStatus;
class AgentDescription;
class AgentRemoval;
class ShapePart;
class ShapeRemoval;
class AgentStates;
class SimulatorClock;
class Clearance;
class Rejection;
}  // namespace collision::v1

namespace collision::client {

class Receiver;

struct MonitorOptions {
  std::string world = "default";  ///< 1-64 of [A-Za-z0-9_-].
  std::uint32_t domain = 0;       ///< DDS domain, 0-230.
  bool service = true;  ///< Status, events, earliest intersection, clearances, rejections.
  bool simulators =
      false;  ///< Descriptions, removals, shapes, states and clocks of all simulators as well.
};

/// Receives everything in one world and writes nothing: only readers are created. The callbacks
/// come inside Poll(), on its thread; the messages are those of idl/messages.proto, as they came:
/// of a topic that keeps the last value, whoever starts later gets the values of now. One thread at
/// a time; a callback must not call Poll() or end the monitor.
class Monitor {
 public:
  struct Callbacks {
    std::function<void(const v1::CollisionEvent&)> event = {};
    std::function<void(const v1::EarliestIntersection&)> earliest = {};
    std::function<void(const v1::ServiceStatus&)> status = {};
    std::function<void(const v1::AgentDescription&)> description = {};
    std::function<void(const v1::AgentRemoval&)> removal = {};
    std::function<void(const v1::ShapePart&)> shape_part = {};
    std::function<void(const v1::ShapeRemoval&)> shape_removal = {};
    std::function<void(const v1::AgentStates&)> states = {};
    std::function<void(const v1::SimulatorClock&)> clock = {};
    std::function<void(const v1::Clearance&)> clearance = {};
    std::function<void(const v1::Rejection&)> rejection = {};
  };

  /// Throws std::runtime_error if the options are out of range or DDS is not to be had.
  Monitor(const MonitorOptions& options, Callbacks callbacks);

  /// The same over another network than DDS.
  Monitor(std::unique_ptr<Receiver> receiver, Callbacks callbacks);

  Monitor(Monitor&&) noexcept;
  Monitor& operator=(Monitor&&) noexcept;
  ~Monitor();

  /// Waits at most `timeout` for something to arrive and hands it on. Returns how many messages
  /// came.
  std::size_t Poll(std::chrono::nanoseconds timeout);

  /// Is a service of this world alive? Needs MonitorOptions::service.
  bool service_alive() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace collision::client
