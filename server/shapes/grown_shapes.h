// Shapes with the margins of the agents that have them.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <variant>

#include "collision_core/shape/grown_shape.h"
#include "server/quotas/simulator_quotas.h"

namespace collision::server {

/// Grows shapes by margins, each once for all agents of a simulator that have both.
///
/// What is grown counts against `tree_bytes_max` of its simulator, and of the world beside the
/// trees themselves. A shape that does not fit, or has too many elements, is refused: its agent
/// stays its ball. Growing takes some 20 µs a triangle, at once. One thread.
class GrownShapes {
 public:
  /// `quotas` outlives this.
  GrownShapes(std::uint64_t bytes_max, SimulatorQuotas* quotas)
      : bytes_max_(bytes_max), quotas_(*quotas) {}

  /// Simulator, hash and margin [m].
  using Key = std::tuple<std::uint64_t, std::string, double>;
  using Grown = std::variant<std::shared_ptr<const shape::Shape>, std::string>;

  /// `shape`, which has this hash, grown by the margin, or a sentence why it cannot be. One agent
  /// more uses it then. Where a twin of the shape was grown before, the result is that one's twin.
  Grown Use(const Key& key, const std::shared_ptr<const shape::Shape>& shape);

  /// One agent less uses it. Requires that one does.
  void Drop(const Key& key);

  std::uint64_t bytes() const { return bytes_; }

 private:
  struct Entry {
    std::shared_ptr<const shape::Shape> from, grown;
    std::uint64_t bytes = 0;
    std::uint32_t users = 0;
  };

  const std::uint64_t bytes_max_;
  SimulatorQuotas& quotas_;
  std::map<Key, Entry> entries_;
  std::uint64_t bytes_ = 0;
};

}  // namespace collision::server
