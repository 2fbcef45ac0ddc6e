#include "collision_core/detection/agents/declaration_change.h"

#include "collision_core/shape/shape.h"

namespace collision::detection {
namespace {

bool SameBody(const std::shared_ptr<const shape::Shape>& a,
              const std::shared_ptr<const shape::Shape>& b) {
  return a == b || (a && b && a->IsSameBodyAs(*b));
}

void Reshape(const motion::AgentDeclaration& before, const motion::AgentDeclaration& declaration,
             AgentRecord* record) {
  motion::AgentDeclaration& in_force = record->history.newest().limits;
  const bool arrived = before.shape_awaited && declaration.shape != nullptr;
  const bool same = SameBody(declaration.shape, before.shape) &&
                    declaration.shape_awaited == before.shape_awaited;
  if (same && declaration.shape) record->history.ReplaceTree(declaration.shape);
  if (arrived && !record->shape_redeclared) {
    in_force.shape = declaration.shape;
    in_force.shape_awaited = false;
  } else if (!same && !arrived) {
    in_force.shape = nullptr;
    in_force.shape_awaited = true;
  }
  // A shape that is awaited before and after may be another one.
  if (!arrived && (!same || declaration.shape_awaited)) record->shape_redeclared = true;
}

}  // namespace

BoundChange Redeclare(const motion::AgentDeclaration& declaration, AgentRecord* record) {
  record->declaration = declaration;
  motion::AgentDeclaration& in_force = record->history.newest().limits;
  const motion::AgentDeclaration before = in_force;
  in_force.radius = std::max(before.radius, declaration.radius);
  in_force.acceleration_max = std::max(before.acceleration_max, declaration.acceleration_max);
  in_force.speed_max = std::max(before.speed_max, declaration.speed_max);
  in_force.time_step = std::max(before.time_step, declaration.time_step);
  in_force.angular_acceleration_max = motion::WiderAngularBound(
      before.angular_acceleration_max, declaration.angular_acceleration_max);
  const bool spins_faster = in_force.angular_acceleration_max != before.angular_acceleration_max;
  Reshape(before, declaration, record);
  in_force.group = declaration.group;
  in_force.mask = declaration.mask;
  const bool widened =
      in_force.radius > before.radius || in_force.acceleration_max > before.acceleration_max ||
      in_force.speed_max > before.speed_max || in_force.time_step > before.time_step ||
      (before.shape && (!SameBody(in_force.shape, before.shape) || spins_faster)) ||
      (in_force.group & ~before.group) != 0 || (in_force.mask & ~before.mask) != 0;
  return widened ? BoundChange::kWidened : BoundChange::kWithin;
}

bool IsNarrower(const motion::AgentDeclaration& before, const motion::AgentDeclaration& next) {
  return next.radius < before.radius || next.acceleration_max < before.acceleration_max ||
         next.time_step < before.time_step;
}

}  // namespace collision::detection
