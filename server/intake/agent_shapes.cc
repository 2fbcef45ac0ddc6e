#include "server/intake/agent_shapes.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <memory>
#include <set>
#include <utility>

#include "server/process/logging.h"

namespace collision::server {
namespace {

std::string SurfaceText(const shape::Shape& shape, std::size_t dropped) {
  const std::size_t triangles = shape.mesh().triangles.size();
  if (triangles == 0) return "no surface";
  return fmt::format("{} triangles ({} degenerate ones dropped), {}", triangles, dropped,
                     shape.closed() ? "closed" : "open");
}

void LogShape(const std::string& hash, const ReadyShape& ready) {
  const BuiltShape& built = ready.built;
  const shape::Shape& shape = *built.shape;
  std::string what = "refined";
  if (!ready.refined) {
    what = SurfaceText(shape, built.dropped);
    if (!shape.solids().empty()) {
      what += fmt::format(", {} convex solids", shape.solids().size());
    }
    what += fmt::format(", radius {:.6g} m", shape.facts().radius);
  }
  Log(spdlog::level::info, "shape",
      fmt::format("{}: {}; {} spheres in {} levels, {} in {:.1f} ms{}", ShortHash(hash), what,
                  shape.tree().nodes.size(), shape.tree().levels,
                  built.from_cache ? "from the cache" : "built",
                  static_cast<double>(built.microseconds) / 1000,
                  built.coarse         ? "; coarse, a finer tree follows"
                  : ready.stays_coarse ? "; stays coarse, no room for a finer tree (tree_bytes_max)"
                                       : ""));
}

}  // namespace

AgentShapes::AgentShapes(const v1::Config& config, World* world, Detectors* detectors,
                         Rejections* rejections, ShapeStore* store)
    : world_(*world),
      detectors_(*detectors),
      rejections_(*rejections),
      store_(*store),
      grown_(config.tree_bytes_max(), &world->quotas()),
      awaited_(ToNanoseconds(config.undescribed_after_s())),
      wait_(ToNanoseconds(config.clock().shape_wait_max_s())) {}

void AgentShapes::Refer(Simulator* simulator, std::uint32_t slot, const std::string& hash,
                        Agent* agent) {
  const ShapeUser user(simulator->id(), slot);
  const bool holds_time = !agent->hypothetical();
  const std::string before = std::exchange(agent->shape_hash, hash);
  if (!hash.empty() && before != hash) {
    store_.AddUser(hash, user);
    if (holds_time) ++real_users_[hash];
  }
  if (!before.empty() && before != hash) {
    store_.RemoveUser(before, user);
    if (holds_time && --real_users_[before] == 0) {
      real_users_.erase(before);
      wait_.End(before);
    }
  }
  if (hash.empty()) return DropGrown(*simulator, agent);
  if (holds_time && !store_.HasWantedTree(hash)) wait_.Begin(hash, world_.monotonic_ns());
  Give(*simulator, slot, agent);
  if (before != hash && !store_.ProgressOf(simulator->id(), hash).whole) {
    Await(simulator->IdOf(slot, agent->generation()), hash);
  }
}

void AgentShapes::DropGrown(const Simulator& simulator, Agent* agent) {
  const auto grown = std::exchange(agent->grown, std::nullopt);
  if (grown) grown_.Drop({simulator.id(), grown->first, grown->second});
}

// What it used before is dropped last: if it is the same, it stays.
std::shared_ptr<const shape::Shape> AgentShapes::ShapeOf(const Simulator& simulator,
                                                         std::uint32_t slot, Agent* agent) {
  std::shared_ptr<const shape::Shape> shape = store_.Find(agent->shape_hash);
  const double margin = agent->declaration.margin;
  if (!shape || margin == 0) {
    DropGrown(simulator, agent);
    return shape;
  }
  const GrownShapes::Grown grown = grown_.Use({simulator.id(), agent->shape_hash, margin}, shape);
  DropGrown(simulator, agent);
  if (const auto* refusal = std::get_if<std::string>(&grown)) {
    rejections_.Add(ShapeRefusal(simulator.IdOf(slot, agent->generation()),
                                 v1::TOPIC_AGENT_DESCRIPTION, "margin_m", *refusal));
    return nullptr;
  }
  agent->grown = {agent->shape_hash, margin};
  return std::get<0>(grown);
}

void AgentShapes::Give(Simulator& simulator, std::uint32_t slot, Agent* agent) {
  detection::AgentDeclaration& declaration = agent->declaration;
  std::shared_ptr<const shape::Shape> shape = ShapeOf(simulator, slot, agent);
  if (!shape) return;
  const double radius = shape->facts().radius;
  if (radius <= declaration.limits.radius * (1 + wire::kShapeRadiusTolerance)) {
    declaration.limits.radius = std::max(declaration.limits.radius, radius);
    declaration.shape = std::move(shape);
    declaration.shape_awaited = false;
    simulator.refusals().Accept(v1::TOPIC_SHAPE, slot);
    return;
  }
  rejections_.Add(ShapeRefusal(
      simulator.IdOf(slot, agent->generation()), v1::TOPIC_AGENT_DESCRIPTION, "radius_m",
      fmt::format(
          "{}; its shape {} reaches {:.9g} m from the reference point; allowed: {:.9g} to {}. "
          "The agent stays its ball",
          declaration.limits.radius, ShortHash(agent->shape_hash), radius, radius,
          wire::kRadiusMax)));
}

void AgentShapes::TakeReady(const v1::ShapeReady& message) {
  const std::string& hash = message.content_hash();
  const std::optional<ReadyShape> ready = store_.MakeVisible({hash, message.coarse()});
  if (!ready) return;
  if (!ready->built.coarse) wait_.End(hash);
  if (!ready->built.shape) return ReportRefusal(hash, *ready);
  LogShape(hash, *ready);
  for (const auto& [id, slot] : ready->users) {
    Simulator* simulator = world_.Find(id);
    Agent* agent = simulator != nullptr ? simulator->agents().Find(slot) : nullptr;
    if (agent == nullptr) continue;
    // The coarse tree did not fit either, so the owner has the rejection already.
    if (ready->refined && !agent->declaration.shape) continue;
    Give(*simulator, slot, agent);
    if (agent->admitted()) {
      detectors_.Redeclare(simulator->IdOf(slot, agent->generation()), agent->declaration,
                           world_.EffectiveFrom(agent->stamp()));
    }
  }
}

void AgentShapes::ReportRefusal(const std::string& hash, const ReadyShape& ready) {
  for (const std::uint64_t owner : ready.owners) {
    const Simulator* simulator = world_.Find(owner);
    const detection::AgentId no_agent{.simulator = owner,
                                      .run = simulator != nullptr ? simulator->run() : 0};
    rejections_.Add(ShapeRefusal(no_agent, v1::TOPIC_SHAPE, "bytes",
                                 "shape " + ShortHash(hash) + ": " + ready.built.refusal));
  }
}

void AgentShapes::Await(const detection::AgentId& id, const std::string& hash) {
  if (awaited_.full()) return ReportMissing({id, hash});
  awaited_.Add(world_.monotonic_ns(), {id, hash});
}

void AgentShapes::ReportMissing() {
  while (const auto awaited = awaited_.TakeDue(world_.monotonic_ns())) ReportMissing(*awaited);
}

void AgentShapes::ReportMissing(const Awaited& awaited) {
  const auto& [id, hash] = awaited;
  Simulator* simulator = world_.Find(id.simulator);
  if (simulator == nullptr || simulator->run() != id.run) return;
  const Agent* agent = simulator->agents().Find(id.slot, id.generation);
  if (agent == nullptr || agent->shape_hash != hash) return;
  const ShapeProgress progress = store_.ProgressOf(id.simulator, hash);
  if (progress.whole) return;
  const std::string arrived = progress.parts == 0 ? "no part of it has arrived"
                                                  : fmt::format("{} of {} parts have arrived",
                                                                progress.arrived, progress.parts);
  rejections_.Add(ShapeRefusal(id, v1::TOPIC_SHAPE, "shape_hash",
                               fmt::format("shape {}: {}; until all have, the agent is its ball",
                                           ShortHash(hash), arrived)));
}

void AgentShapes::ReleaseLeft() {
  const std::set<std::uint64_t> holders = store_.holders();
  for (const std::uint64_t id : holders) {
    const Simulator* simulator = world_.Find(id);
    if (simulator == nullptr || simulator->has_left()) store_.Release(id);
  }
}

}  // namespace collision::server
