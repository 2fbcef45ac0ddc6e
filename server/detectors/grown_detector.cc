#include "server/detectors/grown_detector.h"

#include <algorithm>

#include "collision_core/numeric/rounding.h"
#include "collision_core/shape/fixed_half_space.h"
#include "collision_core/shape/grown_shape.h"

namespace collision::server {

GrownDetector::GrownDetector(const detection::DetectorOptions& options, double margin,
                             const Level* level, std::uint64_t shape_bytes_max)
    : half_margin_(margin / 2),
      level_(*level),
      shape_bytes_max_(shape_bytes_max),
      detector_(options) {}

bool GrownDetector::Admit(const detection::AgentId& id,
                          const detection::AgentDeclaration& declaration,
                          const motion::MotionState& state, Instant effective_from) {
  return detector_.Admit(id, GrownOf(id, declaration), state, effective_from);
}

bool GrownDetector::Redeclare(const detection::AgentId& id,
                              const detection::AgentDeclaration& declaration,
                              Instant effective_from) {
  return detector_.Redeclare(id, GrownOf(id, declaration), effective_from);
}

bool GrownDetector::Remove(const detection::AgentId& id) {
  Drop(id);
  return detector_.Remove(id);
}

void GrownDetector::Advance(Instant now, const std::function<void()>& progress) {
  std::erase_if(shapes_, [this](const auto& entry) {
    if (entry.second.users > 0) return false;
    shape_bytes_ -= entry.second.grown->bytes();
    return true;
  });
  detector_.Advance(now, progress);
}

detection::AgentDeclaration GrownDetector::GrownOf(const detection::AgentId& id,
                                                   const detection::AgentDeclaration& declaration) {
  detection::AgentDeclaration grown = declaration;
  grown.filter = level_.FilterOf(declaration.filter);
  grown.margin = numeric::AddUp(declaration.margin, half_margin_);
  grown.limits.radius = numeric::AddUp(declaration.limits.radius, half_margin_);
  const ShapePtr shape = declaration.shape ? Use(declaration.shape) : nullptr;
  Drop(id);
  if (declaration.half_space) grown.half_space = declaration.half_space->Grown(half_margin_);
  if (!declaration.shape) return grown;
  grown.shape = shape;
  grown.shape_awaited = shape == nullptr;
  if (!shape) return grown;
  used_by_[id] = declaration.shape.get();
  grown.limits.radius = std::max(grown.limits.radius, shape->facts().radius);
  return grown;
}

/// The shape, grown, which one agent more uses; null: it stays a ball.
GrownDetector::ShapePtr GrownDetector::Use(const ShapePtr& shape) {
  const auto found = shapes_.find(shape.get());
  if (found != shapes_.end()) {
    ++found->second.users;
    return found->second.grown;
  }
  if (!CanGrow(*shape)) return nullptr;
  ShapePtr grown = GrownShape(shape, half_margin_, TwinOf(*shape));
  if (grown->bytes() > shape_bytes_max_ - std::min(shape_bytes_max_, shape_bytes_)) return nullptr;
  shape_bytes_ += grown->bytes();
  shapes_[shape.get()] = {shape, grown, 1};
  return grown;
}

/// The grown one of a twin of `shape`: a finer tree of the same body is no other body.
const shape::Shape* GrownDetector::TwinOf(const shape::Shape& shape) const {
  const auto twin = std::ranges::find_if(
      shapes_, [&shape](const auto& entry) { return entry.second.from->IsSameBodyAs(shape); });
  return twin != shapes_.end() ? twin->second.grown.get() : nullptr;
}

void GrownDetector::Drop(const detection::AgentId& id) {
  const auto used = used_by_.find(id);
  if (used == used_by_.end()) return;
  --shapes_.at(used->second).users;
  used_by_.erase(used);
}

}  // namespace collision::server
