// A detector of agents that are wider than they are.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "collision_core/detection/detector.h"
#include "server/detectors/level.h"

namespace collision::server {

/// Tells when two agents come within a margin of each other: of each agent half of it counts as
/// part of its body, so that two touch here exactly where their bodies are that near, balls and
/// shapes alike (shape/grown_shape.h), up to one rounding of the sum of two lengths.
///
/// A shape of more elements than can be grown, or beyond the limit of bytes, counts as anywhere in
/// its agent's ball: a crossing of it is never missed, and stays undecided where the ball does not
/// decide it. Growing takes some 20 µs a triangle, at once, and once for all agents of a shape.
///
/// Its agents and times are those of the detector of contacts: each call is made there first. One
/// thread.
class GrownDetector {
 public:
  /// `margin`: between two agents. `level` says who is watched with whom, and outlives this.
  /// `shape_bytes_max`: of all shapes that are grown.
  GrownDetector(const detection::DetectorOptions& options, double margin, const Level* level,
                std::uint64_t shape_bytes_max);

  bool Admit(const detection::AgentId& id, const detection::AgentDeclaration& declaration,
             const motion::MotionState& state, Instant effective_from);
  bool Redeclare(const detection::AgentId& id, const detection::AgentDeclaration& declaration,
                 Instant effective_from);
  bool Remove(const detection::AgentId& id);

  /// Of a step: gives up shapes that no agent has any more, then as Detector::Advance().
  void Advance(Instant now, const std::function<void()>& progress);

  /// For what changes no declaration.
  detection::Detector& detector() { return detector_; }
  const detection::Detector& detector() const { return detector_; }

  std::uint64_t shape_bytes() const { return shape_bytes_; }

 private:
  using ShapePtr = std::shared_ptr<const shape::Shape>;

  struct Grown {
    ShapePtr from, grown;
    std::uint32_t users = 0;
  };

  detection::AgentDeclaration GrownOf(const detection::AgentId& id,
                                      const detection::AgentDeclaration& declaration);
  ShapePtr Use(const ShapePtr& shape);
  const shape::Shape* TwinOf(const shape::Shape& shape) const;
  void Drop(const detection::AgentId& id);

  const double half_margin_;
  const Level& level_;
  const std::uint64_t shape_bytes_max_;
  detection::Detector detector_;
  std::map<const shape::Shape*, Grown> shapes_;  ///< By what they were grown from.
  std::map<detection::AgentId, const shape::Shape*> used_by_;
  std::uint64_t shape_bytes_ = 0;
};

}  // namespace collision::server
