// What is plotted of a recorded world.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "client/library/network/message_monitor.h"
#include "client/programs/chart/chart.h"
#include "client/programs/shared/world_view.h"

namespace collision::client {

/// Collects numbers while a world is heard. One thread.
class Curves {
 public:
  virtual ~Curves() = default;

  /// To be called for each message of its kind, behind the view.
  virtual void Take(const v1::CollisionEvent&) {}
  virtual void Take(const v1::AgentStates&) {}
  virtual void Take(const v1::ServiceStatus&) {}

  /// The world's time has come to `now_ns`.
  virtual void Sample(std::int64_t now_ns, const WorldView& view) = 0;

  /// All of it; empty: there was nothing to plot.
  virtual chart::Chart Draw() const = 0;
};

/// `what`: a word of kPlotWords. `wall_ns`: the wall time of what is heard now.
std::unique_ptr<Curves> MakeCurves(const std::string& what, std::function<std::int64_t()> wall_ns);

}  // namespace collision::client
