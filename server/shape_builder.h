// From a shape's bytes to its tree, beside the steps of the daemon.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "collision_core/shape/shape.h"
#include "idl/config.pb.h"
#include "server/tree_cache.h"

namespace collision::server {

/// How shapes are built.
struct BuildOptions {
  std::size_t triangles_max = 0;
  ShapeOptions tree = {};
  /// Of trees that `tree` makes; null: none. A builder may outlive who made it, so it shares it.
  std::shared_ptr<TreeCache> cache = nullptr;
};

/// Without a cache: that is a matter of the machine, and a replay has none.
BuildOptions BuildOptionsOf(const v1::Config& complete);

/// What became of a shape's bytes. The same bytes give the same, in every build and every replay.
struct BuiltShape {
  std::shared_ptr<const Shape> shape;  ///< Null: refused.
  std::string refusal;                 ///< Then why: the value and the allowed range.
  std::size_t dropped = 0;             ///< Degenerate triangles.
  std::int64_t microseconds = 0;       ///< What it took: for people, not part of what follows.
  bool from_cache = false;             ///< Likewise.
};

/// Decodes, validates, repairs (degenerate triangles are dropped) and builds, or takes the tree from
/// the cache. `hash` is that of the bytes. It may take minutes.
BuiltShape BuildShape(const std::string& hash, std::string bytes, const BuildOptions& options);

struct ShapeBuilderCounters {
  std::uint64_t building = 0;      ///< Started, not finished.
  std::uint64_t microseconds = 0;  ///< Spent on all that were finished.
  TreeCacheCounters cache = {};
};

/// Builds shapes by their content hash. A shape is a function of its bytes, so only *when* it becomes
/// visible is left to chance: the daemon records that as an input, and a replay waits in Await()
/// where the recorded run had it. All functions are for the daemon's thread.
class ShapeBuilder {
 public:
  virtual ~ShapeBuilder() = default;

  /// `bytes` have this hash. Requires that the hash is not started already, or forgotten since.
  virtual void Start(const std::string& hash, std::string bytes) = 0;

  /// Whether TakeFinished() would return any.
  virtual bool has_finished() const = 0;

  /// What was finished since the last call, in that order.
  virtual std::vector<std::string> TakeFinished() = 0;

  /// Waits until it is finished, hands it out and forgets it. Requires a hash that is started and
  /// not forgotten.
  virtual BuiltShape Await(const std::string& hash) = 0;

  /// Nobody wants it any more, finished or not.
  virtual void Forget(const std::string& hash) = 0;

  virtual ShapeBuilderCounters counters() const = 0;
};

/// Builds in Await(), on the daemon's thread, and reports at once whatever was started: the same
/// steps in every run. For tests, simulations and replays.
class InlineShapeBuilder final : public ShapeBuilder {
 public:
  explicit InlineShapeBuilder(BuildOptions options) : options_(std::move(options)) {}

  void Start(const std::string& hash, std::string bytes) override;
  bool has_finished() const override { return !finished_.empty(); }
  std::vector<std::string> TakeFinished() override;
  BuiltShape Await(const std::string& hash) override;
  void Forget(const std::string& hash) override;
  ShapeBuilderCounters counters() const override;

 private:
  const BuildOptions options_;
  std::map<std::string, std::string> started_;  ///< Bytes by hash.
  std::vector<std::string> finished_;
  std::uint64_t microseconds_ = 0;
};

}  // namespace collision::server
