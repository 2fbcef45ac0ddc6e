// The shapes of the world: what has arrived of each, and which simulators and agents need it.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "idl/config.pb.h"
#include "server/codec/refusal.h"
#include "server/quotas/simulator_quotas.h"
#include "server/shapes/shape_builder.h"
#include "server/shapes/shape_gathering.h"
#include "server/shapes/shape_numbers.h"

namespace collision::server {

/// An agent that refers to a shape: simulator, slot.
using ShapeUser = std::pair<std::uint64_t, std::uint32_t>;

/// A shape that has become visible or was refused, and the simulators and agents concerned.
struct ReadyShape {
  BuiltShape built;
  bool refined = false;               ///< It was visible before, with its coarse tree.
  bool stays_coarse = false;          ///< There is no room for its finer tree.
  std::vector<std::uint64_t> owners;  ///< Simulators that wrote it.
  std::vector<ShapeUser> users;
};

/// How much of a shape has arrived.
struct ShapeProgress {
  bool whole = false;  ///< All of it has arrived, and its hash is right.
  std::uint64_t arrived = 0;
  std::uint64_t parts = 0;  ///< 0: none has arrived, so the number is unknown.
};

struct ShapeCounters {
  std::uint64_t parts_received = 0;
  std::uint64_t refused = 0;  ///< Shapes, not parts.
  std::uint64_t visible = 0;
  std::uint64_t coarse = 0;     ///< Of the visible ones: the wanted tree is not ready.
  std::uint64_t gathering = 0;  ///< Not whole yet.
  std::uint64_t places = 0;     ///< As shapes_max counts them.
  std::uint64_t bytes = 0;      ///< As shape_bytes_max counts them.
  std::uint64_t tree_nodes = 0;
  std::uint64_t tree_bytes = 0;  ///< Of trees, in both layouts, and of solids; beside `bytes`.
  ShapeBuilderCounters builder;
};

/// A shape is known by the SHA-256 of its bytes.
///
/// **Gathering.** Parts are kept for each simulator on its own, so that no simulator can spoil what
/// another one writes. When the last part is there and the hash is right, the shape belongs to all
/// simulators that wrote any part of it, and its tree is built beside the daemon's steps. A shape
/// that is refused is reported once; a part that comes for the second time begins another attempt.
///
/// **Visible.** MakeVisible() hands a built shape out, from the step on in which the daemon records
/// it as an input (shape_builder.h): agents that refer to it have it from then on.
///
/// **Lifetime.** A shape is kept while a simulator that wrote it has not disposed of every part,
/// begun a new run or left, or while an agent refers to it. Then mesh and tree are freed, and a
/// build that runs is forgotten.
///
/// **Memory.** `shape_bytes_max` bounds the bytes of parts and meshes: for a million triangles some
/// 25 MB of parts and 25 MB of mesh. `tree_bytes_max` bounds the trees, some hundred MB for a
/// million triangles: a tree has at most 2^20 balls, beyond that its leaves have more triangles.
/// Each simulator has its part of these limits (SimulatorQuotas); a shape of several simulators
/// counts for each of them. Nothing that is in use is freed to make room. One thread.
class ShapeStore {
 public:
  /// `builder` and `quotas` outlive this.
  ShapeStore(const v1::Config& config, ShapeBuilder* builder, SimulatorQuotas* quotas);

  /// A part from the simulator that owns its id.
  std::optional<Refusal> Take(const v1::ShapePart& part);

  /// A part was disposed of. With its last part a simulator gives a shape up.
  void Dispose(std::uint64_t simulator, const std::string& hash, std::uint32_t part);

  /// The same by the simulator's number of the shape; nothing, if it has none of this number.
  void Dispose(std::uint64_t simulator, std::uint32_t number, std::uint32_t part);

  /// Whether the simulator has a shape of this number.
  bool Knows(std::uint64_t simulator, std::uint32_t number) const {
    return numbers_.HashOf(simulator, number) != nullptr;
  }

  /// The simulator gives up all shapes that it wrote.
  void Release(std::uint64_t simulator);

  /// Simulators that may own shapes or parts.
  const std::set<std::uint64_t>& holders() const { return holders_; }

  void AddUser(const std::string& hash, ShapeUser user) { users_[hash].insert(user); }
  void RemoveUser(const std::string& hash, ShapeUser user);

  /// Makes a shape visible whose tree is ready, or replaces its coarse tree by the wanted one; in a
  /// replay it waits until the tree is built. nullopt: the shape is not needed any more, or is
  /// there already.
  std::optional<ReadyShape> MakeVisible(const ReadyTree& tree);

  /// Null: not visible.
  std::shared_ptr<const shape::Shape> Find(const std::string& hash) const;

  /// Whether the wanted tree of a shape is there.
  bool HasWantedTree(const std::string& hash) const;

  /// How much has arrived of a shape that this simulator writes.
  ShapeProgress ProgressOf(std::uint64_t simulator, const std::string& hash) const;

  ShapeCounters counters() const;

 private:
  struct Known {
    std::uint64_t bytes = 0;                    ///< As it travels; its mesh takes as much.
    std::map<std::uint64_t, PartSet> owners;    ///< With the parts that they have not disposed of.
    std::shared_ptr<const shape::Shape> shape;  ///< Null: being built.
    bool coarse = false;                        ///< A better tree of it is being built.
  };
  using Key = std::pair<std::string, std::uint64_t>;  ///< Hash, simulator.
  using Gatherings = std::map<Key, ShapeGathering>;

  bool HasRoomFor(std::uint64_t simulator, std::uint64_t bytes) const;
  bool HasRoomForTree(const Known& known, std::uint64_t tree_bytes) const;
  void SetOwner(std::uint64_t simulator, const PartSet& parts, Known* known);
  void RemoveOwner(std::uint64_t simulator, Known* known);
  void SetGathered(std::uint64_t simulator, std::uint64_t before, std::uint64_t after);
  /// Whether the simulator has written any of the shape that is still here.
  bool Holds(std::uint64_t simulator, const std::string& hash) const;
  std::optional<Refusal> CheckNumber(const v1::ShapePart& part) const;
  void DisposeOf(std::uint64_t simulator, const std::string& hash, std::uint32_t part);
  std::optional<Refusal> TakeKnown(const v1::ShapePart& part, Known* known);
  std::optional<Refusal> TakeUnknown(const v1::ShapePart& part);
  std::optional<Refusal> Begin(const v1::ShapePart& part);
  std::optional<Refusal> Add(const v1::ShapePart& part, ShapeGathering* gathering);
  std::optional<Refusal> Complete(const v1::ShapePart& part, ShapeGathering* gathering);
  void Refuse(std::uint64_t simulator, ShapeGathering* gathering);
  void Forget(Gatherings::iterator gathering);
  void LimitTree(const Known& known, ReadyShape* ready) const;
  void FreeIfUnwanted(const std::string& hash);
  void SetShape(std::shared_ptr<const shape::Shape> shape, bool coarse, Known* known);

  const std::uint64_t triangles_max_;
  const std::uint64_t shapes_max_;
  const std::uint64_t bytes_max_;
  const std::uint64_t tree_bytes_max_;
  ShapeBuilder& builder_;
  SimulatorQuotas& quotas_;
  std::map<std::string, Known> shapes_;  ///< By hash; verified.
  Gatherings gatherings_;
  std::map<std::string, std::set<ShapeUser>> users_;  ///< By hash, known or not.
  std::set<std::uint64_t> holders_;
  ShapeNumbers numbers_;  ///< Of what the simulators hold.
  std::uint64_t bytes_ = 0;
  ShapeCounters counters_;
};

/// The first eight digits of a hash, which logs and refusals show.
std::string ShortHash(const std::string& hash);

}  // namespace collision::server
