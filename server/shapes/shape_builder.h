// From the bytes of a shape to its tree, beside the steps of the daemon.
//
// Decoding, validation, repair and the tree cost about 50 us a triangle on an idle machine, so they
// do not happen within a step. What comes of the bytes, a shape or a refusal, depends on the bytes
// alone; only *when* it is there depends on the machine. So the daemon puts a message `shape_ready`
// at the head of its next batch before it records the batch; applying the message makes the shape
// visible. A replay adds no such message of its own and waits where the recorded run had one.
//
// Coarse first: a surface of more than kCoarseFirstTriangles that is not in the cache gets a coarse
// tree first, in a tenth of the time: answers computed with it are certain too, only wider or more
// expensive.
// The wanted tree takes its place when it is ready (`shape_ready` says which of the two). To the
// detector both are one body (Shape::IsSameBodyAs): no bound widens, no promise is withdrawn. If
// the wanted tree is ready before the coarse one was used, the coarse one is dropped. With the
// builder MEDIAN_SPLIT the coarse tree is the wanted one. Measured on two shared cores with a
// terrain of 99,458 triangles: usable after 0.5 s, fine after 5 s.
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
#include "idl/messages.pb.h"
#include "server/shapes/tree_store.h"

namespace collision::server {

/// A surface of more triangles gets a coarse tree first; for a smaller one the wanted tree is there
/// as soon.
inline constexpr std::size_t kCoarseFirstTriangles = 4096;

/// How coarse trees are built: looser balls in a tenth of the time.
inline constexpr sphere_tree::ShapeOptions kCoarseTree{.builder =
                                                           sphere_tree::TreeBuilder::kMedianSplit};

/// How shapes are built.
struct BuildOptions {
  std::size_t triangles_max = 0;
  sphere_tree::ShapeOptions tree = {};
  /// Keeps the trees that `tree` makes; null: none. Shared, since a thread may outlive its builder.
  std::shared_ptr<TreeStore> cache = nullptr;
};

/// Without a cache, which belongs to the machine; a replay has none.
BuildOptions BuildOptionsOf(const v1::Config& complete);

/// What became of the bytes of a shape: a function of the bytes and the options.
struct BuiltShape {
  std::shared_ptr<const shape::Shape> shape;  ///< Null: refused.
  std::string refusal;            ///< Why it was refused: the value and the allowed range.
  bool coarse = false;            ///< Its tree is the coarse one; Refine() makes the other.
  std::size_t dropped = 0;        ///< Degenerate triangles.
  std::int64_t microseconds = 0;  ///< What it took. For the log; nothing depends on it.
  bool from_cache = false;        ///< Likewise.
};

/// Decodes, validates, repairs and builds, or takes the tree of the surface from the cache. It
/// takes minutes for a landscape; solids cost next to nothing and are not cached. Requires that
/// `hash` is that of the bytes.
BuiltShape BuildShape(const std::string& hash, std::string bytes, const BuildOptions& options);

/// The same, but with the coarse tree if the surface is large and its tree not in the cache.
BuiltShape BuildFirst(const std::string& hash, std::string bytes, const BuildOptions& options);

/// What BuildShape() makes of the same bytes, as a twin of what BuildFirst() made of them.
BuiltShape Refine(const std::string& hash, const shape::Shape& coarse, const BuildOptions& options);

/// One of a shape's two trees, which has been built or is used from now on.
struct ReadyTree {
  std::string hash;
  bool coarse = false;  ///< The coarse one: the wanted one follows.

  friend bool operator==(const ReadyTree&, const ReadyTree&) = default;
};

struct ShapeBuilderCounters {
  std::uint64_t building = 0;      ///< Started, and their wanted trees not finished.
  std::uint64_t microseconds = 0;  ///< Spent on all that were finished.
  TreeCacheCounters cache = {};
};

/// Builds shapes by their content hash, large ones in two steps: with a coarse tree, and again with
/// the wanted one. All functions are for the daemon's thread.
///
/// An implementation that builds on other threads carries an exception of theirs, such as a
/// CheckFailure, to the daemon's thread: has_finished() is true then, and TakeFinished() and
/// Await() throw it.
class ShapeBuilder {
 public:
  virtual ~ShapeBuilder() = default;

  /// Begins to build for a simulator, which has its turn among the others. Requires that the bytes
  /// have this hash, and that it is not started already, or was forgotten since.
  virtual void Start(const std::string& hash, std::string bytes, std::uint64_t simulator) = 0;

  /// Whether TakeFinished() would return any.
  virtual bool has_finished() const = 0;

  /// What was finished since the last call, in that order; of a shape with both trees only the
  /// wanted one.
  virtual std::vector<ReadyTree> TakeFinished() = 0;

  /// The same as inputs: when a tree is finished depends on the machine, so the step from which on
  /// it counts is an input like any other.
  void AddFinished(std::vector<v1::Input>* inputs);

  /// Waits until the tree is built and hands it out; the hash is forgotten then, unless the tree is
  /// a coarse one. If the coarse tree was dropped or never built, the wanted one is handed out.
  /// Requires a hash that is started and not forgotten (checked).
  virtual BuiltShape Await(const ReadyTree& tree) = 0;

  /// The shape is not needed any more, finished or not.
  virtual void Forget(const std::string& hash) = 0;

  virtual ShapeBuilderCounters counters() const = 0;
};

/// Builds in Await(), on the daemon's thread, and reports each shape as finished when it is
/// started, without coarse trees: the same steps in every run. For tests, simulations and replays,
/// which ask for a coarse tree where the recorded run had one.
class InlineShapeBuilder final : public ShapeBuilder {
 public:
  explicit InlineShapeBuilder(BuildOptions options) : options_(std::move(options)) {}

  void Start(const std::string& hash, std::string bytes, std::uint64_t simulator) override;
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
