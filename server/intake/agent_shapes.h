// Which agent has which shape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "server/detectors/detectors.h"
#include "server/intake/overdue_queue.h"
#include "server/intake/shape_wait.h"
#include "server/shapes/grown_shapes.h"
#include "server/shapes/shape_store.h"
#include "server/world/rejections.h"
#include "server/world/world.h"

namespace collision::server {

/// Connects agents with the shapes of the ShapeStore: an agent refers to a shape by its hash, and
/// has it as soon as it is visible and fits into the agent's ball. Until then, and if the shape is
/// refused, the agent is its ball. A rejection informs its owner: at once of a fault, after
/// `undescribed_after_s` of what is missing.
///
/// A shape that becomes visible only narrows what is known, so it lowers no promise. A world in
/// lock-step waits for it all the same (ShapeWait), unless only hypothetical agents refer to it.
/// One thread.
class AgentShapes {
 public:
  /// Everything passed in outlives this.
  AgentShapes(const v1::Config& config, World* world, Detectors* detectors, Rejections* rejections,
              ShapeStore* store);

  /// The agent refers to this shape from now on, and to no other; empty: to none.
  void Refer(Simulator* simulator, std::uint32_t slot, const std::string& hash, Agent* agent);

  /// Makes a shape visible, or gives it its wanted tree in place of the coarse one: agents that
  /// refer to it have it from now on. If it is refused, its writers get a rejection.
  void TakeReady(const v1::ShapeReady& message);

  /// No shape of this hash will come: what was written under it was refused.
  void GiveUp(const std::string& hash) { wait_.End(hash); }

  /// The shapes for which time waits in lock-step.
  ShapeWait& wait() { return wait_; }
  const ShapeWait& wait() const { return wait_; }

  /// Reports shapes that have not arrived in time, to the owners of their agents.
  void ReportMissing();

  /// Frees what simulators that have left had written.
  void ReleaseLeft();

  /// When ReportMissing() may next have something to report.
  std::optional<std::int64_t> NextDue() const { return awaited_.next_ns(); }

 private:
  struct Awaited {
    detection::AgentId agent;
    std::string hash;
  };

  /// Gives the agent its shape if that is visible and fits.
  void Give(Simulator& simulator, std::uint32_t slot, Agent* agent);
  /// The visible shape of the agent, with its margin; null: there is none. Its owner is told why.
  std::shared_ptr<const shape::Shape> ShapeOf(const Simulator& simulator, std::uint32_t slot,
                                              Agent* agent);
  /// The agent uses no grown shape any more.
  void DropGrown(const Simulator& simulator, Agent* agent);
  void Await(const detection::AgentId& id, const std::string& hash);
  void ReportMissing(const Awaited& awaited);
  void ReportRefusal(const std::string& hash, const ReadyShape& ready);

  World& world_;
  Detectors& detectors_;
  Rejections& rejections_;
  ShapeStore& store_;
  GrownShapes grown_;
  OverdueQueue<Awaited> awaited_;
  ShapeWait wait_;
  /// By hash, the real agents that refer to a shape; none has 0. Time waits for these shapes only.
  std::map<std::string, std::size_t> real_users_;
};

}  // namespace collision::server
