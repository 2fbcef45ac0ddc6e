// Shapes: their parts, when they become visible, and which agents have them.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <set>
#include <utility>

#include "server/intake.h"
#include "server/logging.h"

namespace collision::server {
namespace {

/// A mesh's farthest vertex and the radius that its owner computed from the same numbers may differ
/// by rounding.
constexpr double kRadiusAllowance = 1 + 1e-9;

std::string SurfaceText(const shape::Shape& shape, std::size_t dropped) {
  const std::size_t triangles = shape.mesh().triangles.size();
  if (triangles == 0) return "no surface";
  return fmt::format("{} triangles ({} degenerate ones dropped), {}", triangles, dropped,
                     shape.closed() ? "closed" : "open");
}

void TellShape(const std::string& hash, const ReadyShape& ready) {
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
                  built.coarse ? "; coarse, a finer tree follows" : ""));
}

}  // namespace

void Intake::TakeShapePart(const v1::Input& input) {
  const v1::ShapePart& part = input.shape_part();
  const Simulator* simulator = Claimed(input, At(part), nullptr);
  if (simulator == nullptr) return;
  if (const auto refusal = shapes_.Take(part)) Refuse(*refusal);
}

void Intake::TakeShapeRemoval(const v1::Input& input) {
  const v1::ShapeRemoval& removal = input.shape_removal();
  Simulator* simulator = world_.Find(removal.simulator_id());
  if (simulator == nullptr) return;
  // Without a sender it is the part itself that says it.
  if (input.sender() != 0 && simulator->sender != input.sender()) {
    if (!HoldBehindItsLike(simulator, input)) Refuse(NotItsOwn(removal));
    return;
  }
  shapes_.Dispose(removal.simulator_id(), removal.content_hash(), removal.part());
}

void Intake::TakeShapeReady(const v1::ShapeReady& message) {
  const std::string& hash = message.content_hash();
  const std::optional<ReadyShape> ready = shapes_.MakeVisible({hash, message.coarse()});
  if (!ready) return;
  if (!ready->built.shape) {
    for (const std::uint64_t owner : ready->owners) {
      const Simulator* simulator = world_.Find(owner);
      const detection::AgentId nobody{.simulator = owner,
                                      .run = simulator != nullptr ? simulator->run : 0};
      Refuse(ShapeRefusal(nobody, v1::TOPIC_SHAPE, "bytes",
                          "shape " + ShortHash(hash) + ": " + ready->built.refusal));
    }
    return;
  }
  TellShape(hash, *ready);
  for (const auto& [id, slot] : ready->users) {
    Simulator* simulator = world_.Find(id);
    if (simulator == nullptr || !simulator->slots.contains(slot)) continue;
    if (!simulator->slots[slot].agent) continue;
    Agent& agent = *simulator->slots[slot].agent;
    // Whom the shape did not fit has been told so.
    if (ready->refined && !agent.declaration.shape) continue;
    GiveShape(simulator, slot, &agent);
    if (agent.admitted) {
      detector_.Redeclare(simulator->IdOf(slot, agent.generation), agent.declaration,
                          world_.EffectiveFrom(agent.stamp));
    }
  }
}

void Intake::ReferTo(const std::string& hash, Simulator* simulator, std::uint32_t slot,
                     Agent* agent) {
  const ShapeUser user(simulator->id, slot);
  const std::string before = std::exchange(agent->shape_hash, hash);
  if (!hash.empty()) shapes_.AddUser(hash, user);
  if (!before.empty() && before != hash) shapes_.RemoveUser(before, user);
  if (hash.empty()) return;
  GiveShape(simulator, slot, agent);
  if (before != hash && !shapes_.ProgressOf(simulator->id, hash).whole) {
    AwaitShape(simulator->IdOf(slot, agent->generation), hash);
  }
}

void Intake::GiveShape(Simulator* simulator, std::uint32_t slot, Agent* agent) {
  motion::AgentDeclaration& declaration = agent->declaration;
  std::shared_ptr<const shape::Shape> shape = shapes_.Find(agent->shape_hash);
  if (!shape) return;
  const double radius = shape->facts().radius;
  if (radius <= declaration.radius * kRadiusAllowance) {
    declaration.radius = std::max(declaration.radius, radius);
    declaration.shape = std::move(shape);
    declaration.shape_awaited = false;
    return;
  }
  Refuse(ShapeRefusal(
      simulator->IdOf(slot, agent->generation), v1::TOPIC_AGENT_DESCRIPTION, "radius_m",
      fmt::format(
          "{}; its shape {} reaches {:.9g} m from the reference point; allowed: {:.9g} to {}. "
          "The agent stays its ball",
          declaration.radius, ShortHash(agent->shape_hash), radius, radius, kRadiusMax)));
}

void Intake::AwaitShape(const detection::AgentId& id, const std::string& hash) {
  // Beyond, it is told at once.
  if (shapes_awaited_.size() >= kUndescribedMax) return ReportMissingShape(id, hash);
  shapes_awaited_.push_back({world_.monotonic_ns() + undescribed_after_ns_, id, hash});
}

void Intake::ReportMissingShapes() {
  while (!shapes_awaited_.empty() && shapes_awaited_.front().due_ns <= world_.monotonic_ns()) {
    const Undescribed awaited = std::move(shapes_awaited_.front());
    shapes_awaited_.pop_front();
    ReportMissingShape(awaited.agent, awaited.shape);
  }
}

void Intake::ReportMissingShape(const detection::AgentId& id, const std::string& hash) {
  const Simulator* simulator = world_.Find(id.simulator);
  if (simulator == nullptr || simulator->run != id.run) return;
  const auto slot = simulator->slots.find(id.slot);
  if (slot == simulator->slots.end()) return;
  if (!Simulator::Describes(slot->second, id.generation)) return;
  if (slot->second.agent->shape_hash != hash) return;
  const ShapeProgress progress = shapes_.ProgressOf(id.simulator, hash);
  if (progress.whole) return;
  const std::string arrived = progress.parts == 0 ? "no part of it has arrived"
                                                  : fmt::format("{} of {} parts have arrived",
                                                                progress.arrived, progress.parts);
  Refuse(ShapeRefusal(id, v1::TOPIC_SHAPE, "shape_hash",
                      fmt::format("shape {}: {}; until all have, the agent is its ball",
                                  ShortHash(hash), arrived)));
}

void Intake::ReleaseShapes() {
  const std::set<std::uint64_t> holders = shapes_.holders();
  for (const std::uint64_t id : holders) {
    const Simulator* simulator = world_.Find(id);
    if (simulator == nullptr || simulator->has_left()) shapes_.Release(id);
  }
}

bool Intake::Hold(Simulator* simulator, const v1::Input& input) {
  const std::uint64_t bytes = input.shape_part().bytes().size();
  if (simulator->held.size() >= kHeldInputsMax || !shapes_.HasRoomFor(bytes)) return false;
  simulator->held.push_back(input);
  held_shape_bytes_ += bytes;
  shapes_.SetHeldBytes(held_shape_bytes_);
  return true;
}

void Intake::CountHeldBytes() {
  held_shape_bytes_ = 0;
  for (const auto& [id, simulator] : world_.simulators()) {
    for (const v1::Input& held : simulator.held) {
      held_shape_bytes_ += held.shape_part().bytes().size();
    }
  }
  shapes_.SetHeldBytes(held_shape_bytes_);
}

}  // namespace collision::server
