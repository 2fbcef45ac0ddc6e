#include "collision_core/detection/agents/declaration_change.h"

#include "collision_core/shape/shape.h"

namespace collision::detection {
namespace {

bool SameBody(const std::shared_ptr<const shape::Shape>& a,
              const std::shared_ptr<const shape::Shape>& b) {
  return a == b || (a && b && a->IsSameBodyAs(*b));
}

void Reshape(const History::Sample& before, const AgentDeclaration& declaration,
             AgentRecord* record) {
  History::Sample& in_force = record->history.newest();
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

BoundChange ApplyDeclaration(const AgentDeclaration& declaration, AgentRecord* record) {
  CORE_CHECK(!declaration.shape || !declaration.shape_awaited, "an awaited shape is null");
  record->Declare(declaration, record->declaration.half_space);
  History::Sample& in_force = record->history.newest();
  const History::Sample before = in_force;
  const motion::MotionLimits& old = before.bound.limits;
  const motion::MotionLimits& limits = in_force.bound.limits =
      motion::Wider(old, declaration.limits);
  const bool spins_faster = limits.angular_acceleration_max != old.angular_acceleration_max;
  Reshape(before, declaration, record);
  in_force.filter = declaration.filter;
  const bool widened =
      limits.radius > old.radius || limits.acceleration_max > old.acceleration_max ||
      limits.jerk_max > old.jerk_max || limits.speed_max > old.speed_max ||
      limits.time_step > old.time_step ||
      (before.shape && (!SameBody(in_force.shape, before.shape) || spins_faster)) ||
      MayMeetMore(before.filter, in_force.filter);
  return widened ? BoundChange::kWidened : BoundChange::kWithin;
}

bool IsNarrower(const motion::MotionLimits& before, const motion::MotionLimits& next) {
  return next.radius < before.radius || next.acceleration_max < before.acceleration_max ||
         next.jerk_max < before.jerk_max || next.time_step < before.time_step;
}

}  // namespace collision::detection
