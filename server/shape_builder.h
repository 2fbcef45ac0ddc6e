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

/// A surface of more triangles gets a coarse tree first, so that it is of use early, and the wanted one
/// later. Below, the wanted one is there as soon.
inline constexpr std::size_t kCoarseFirstTriangles = 4096;

/// The coarse one: looser balls, built in a tenth of the time.
inline constexpr sphere_tree::ShapeOptions kCoarseTree{.builder =
                                                           sphere_tree::TreeBuilder::kHalved};

/// How shapes are built.
struct BuildOptions {
  std::size_t triangles_max = 0;
  sphere_tree::ShapeOptions tree = {};
  /// Of trees that `tree` makes; null: none. A builder may outlive who made it, so it shares it.
  std::shared_ptr<TreeCache> cache = nullptr;
};

/// Without a cache: that is a matter of the machine, and a replay has none.
BuildOptions BuildOptionsOf(const v1::Config& complete);

/// What became of a shape's bytes. The same bytes give the same, in every build and every replay.
struct BuiltShape {
  std::shared_ptr<const shape::Shape> shape;  ///< Null: refused.
  std::string refusal;                        ///< Then why: the value and the allowed range.
  bool coarse = false;            ///< Its tree is the coarse one; Refine() makes the other.
  std::size_t dropped = 0;        ///< Degenerate triangles.
  std::int64_t microseconds = 0;  ///< What it took: for people, not part of what follows.
  bool from_cache = false;        ///< Likewise.
};

/// Decodes, validates, repairs and builds, or takes the surface's tree from the cache: that is where
/// the time goes, minutes for a landscape; solids are cheap. `hash` is that of the bytes.
BuiltShape BuildShape(const std::string& hash, std::string bytes, const BuildOptions& options);

/// The same, but with the coarse tree if the surface is large and its tree not in the cache.
BuiltShape BuildFirst(const std::string& hash, std::string bytes, const BuildOptions& options);

/// What BuildShape() makes of the same bytes, as a twin of what BuildFirst() made of them.
BuiltShape Refine(const std::string& hash, const shape::Shape& coarse, const BuildOptions& options);

/// A tree that is there, or is to be used from now on: of which shape, and which of its two.
struct ReadyTree {
  std::string hash;
  bool coarse = false;  ///< Another one follows.

  friend bool operator==(const ReadyTree&, const ReadyTree&) = default;
};

struct ShapeBuilderCounters {
  std::uint64_t building = 0;      ///< Started, and their wanted trees not finished.
  std::uint64_t microseconds = 0;  ///< Spent on all that were finished.
  TreeCacheCounters cache = {};
};

/// Builds shapes by their content hash, large ones in two steps: with a coarse tree, and again with the
/// wanted one. Both are functions of the bytes, so only *when* they become visible, and whether the
/// first one does at all, is left to chance: the daemon records that as an input, and a replay waits
/// in Await() where the recorded run had it. All functions are for the daemon's thread.
class ShapeBuilder {
 public:
  virtual ~ShapeBuilder() = default;

  /// `bytes` have this hash. Requires that the hash is not started already, or forgotten since.
  virtual void Start(const std::string& hash, std::string bytes) = 0;

  /// Whether TakeFinished() would return any.
  virtual bool has_finished() const = 0;

  /// What was finished since the last call, in that order; of a shape with both trees only the
  /// wanted one.
  virtual std::vector<ReadyTree> TakeFinished() = 0;

  /// Waits until it is finished and hands it out; all but a coarse one is forgotten then. A coarse
  /// one that is not to be had any more, or never was, is the wanted one. Requires a hash that is
  /// started and not forgotten.
  virtual BuiltShape Await(const ReadyTree& tree) = 0;

  /// Nobody wants it any more, finished or not.
  virtual void Forget(const std::string& hash) = 0;

  virtual ShapeBuilderCounters counters() const = 0;
};

/// Builds in Await(), on the daemon's thread, and reports at once whatever was started, without coarse
/// trees: the same steps in every run. For tests, simulations and replays, which ask for a coarse tree
/// where the recorded run had one.
class InlineShapeBuilder final : public ShapeBuilder {
 public:
  explicit InlineShapeBuilder(BuildOptions options) : options_(std::move(options)) {}

  void Start(const std::string& hash, std::string bytes) override;
  bool has_finished() const override { return !finished_.empty(); }
  std::vector<ReadyTree> TakeFinished() override;
  BuiltShape Await(const ReadyTree& tree) override;
  void Forget(const std::string& hash) override;
  ShapeBuilderCounters counters() const override;

 private:
  struct Job {
    std::string bytes;                           ///< Until the first tree is built.
    std::shared_ptr<const shape::Shape> coarse;  ///< From then on.
  };

  const BuildOptions options_;
  std::map<std::string, Job> started_;  ///< By hash.
  std::vector<ReadyTree> finished_;
  std::uint64_t microseconds_ = 0;
};

}  // namespace collision::server
