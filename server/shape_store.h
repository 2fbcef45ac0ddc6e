// The shapes of the world: what has arrived of them, who wrote them, who refers to them.
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
#include "server/refusal.h"
#include "server/shape_builder.h"
#include "server/shape_gathering.h"

namespace collision::server {

/// An agent that refers to a shape: simulator, slot.
using ShapeUser = std::pair<std::uint64_t, std::uint32_t>;

/// What became visible, or did not, and whom it concerns.
struct ReadyShape {
  BuiltShape built;
  bool refined = false;               ///< It was visible before, with its coarse tree.
  std::vector<std::uint64_t> owners;  ///< Simulators that wrote it.
  std::vector<ShapeUser> users;
};

/// How much of a shape is there.
struct ShapeProgress {
  bool whole = false;  ///< All of it has arrived, and its hash is right.
  std::uint64_t arrived = 0;
  std::uint64_t parts = 0;  ///< 0: none has arrived, so nobody knows how many there are.
};

struct ShapeCounters {
  std::uint64_t parts_received = 0;
  std::uint64_t refused = 0;  ///< Shapes, not parts.
  std::uint64_t visible = 0;
  std::uint64_t coarse = 0;     ///< Of these: whose wanted tree is not ready.
  std::uint64_t gathering = 0;  ///< Not whole yet.
  std::uint64_t bytes = 0;      ///< As shape_bytes_max counts them.
  std::uint64_t tree_nodes = 0;
  std::uint64_t tree_bytes = 0;  ///< Of trees, in both layouts, and of solids.
  ShapeBuilderCounters builder;
};

/// Parts are gathered for each simulator on its own, so that nobody can spoil what another writes.
/// When the last one is there and the hash is right, the shape belongs to all who wrote any of it,
/// and is built beside the daemon's steps. It is freed once nobody who wrote it is left (disposed
/// of, left, a new run) and no agent refers to it. One thread.
class ShapeStore {
 public:
  /// `builder` outlives this.
  ShapeStore(const v1::Config& config, ShapeBuilder* builder);

  /// A part from the simulator that owns its id.
  std::optional<Refusal> Take(const v1::ShapePart& part);

  /// A part was disposed of. With the last one the simulator gives the shape up.
  void Dispose(std::uint64_t simulator, const std::string& hash, std::uint32_t part);

  /// The simulator gives up all it wrote.
  void Release(std::uint64_t simulator);

  /// Simulators that may have something to release.
  const std::set<std::uint64_t>& holders() const { return holders_; }

  void AddUser(const std::string& hash, ShapeUser user) { users_[hash].insert(user); }
  void RemoveUser(const std::string& hash, ShapeUser user);

  /// Makes a shape visible whose tree is ready, or gives it its wanted tree in place of the coarse
  /// one; waits for it if this is a replay. nullopt: nobody wants it any more, or it is there
  /// already.
  std::optional<ReadyShape> MakeVisible(const ReadyTree& tree);

  /// Null: not visible.
  std::shared_ptr<const shape::Shape> Find(const std::string& hash) const;

  /// Of what one simulator wrote.
  ShapeProgress ProgressOf(std::uint64_t simulator, const std::string& hash) const;

  /// Parts that wait elsewhere, for a successor, count too.
  void SetHeldBytes(std::uint64_t bytes) { held_bytes_ = bytes; }
  bool HasRoomFor(std::uint64_t bytes) const;

  ShapeCounters counters() const;

 private:
  struct Known {
    std::uint64_t bytes = 0;                    ///< As it travels; its mesh takes as much.
    std::map<std::uint64_t, PartSet> owners;    ///< And which parts they have not disposed of.
    std::shared_ptr<const shape::Shape> shape;  ///< Null: being built.
    bool coarse = false;                        ///< A better tree of it is being built.
  };
  using Key = std::pair<std::string, std::uint64_t>;  ///< Hash, simulator.
  using Gatherings = std::map<Key, ShapeGathering>;

  std::optional<Refusal> TakeKnown(const v1::ShapePart& part, Known* known);
  std::optional<Refusal> TakeUnknown(const v1::ShapePart& part);
  std::optional<Refusal> Begin(const v1::ShapePart& part);
  std::optional<Refusal> Add(const v1::ShapePart& part, ShapeGathering* gathering);
  std::optional<Refusal> Complete(const v1::ShapePart& part, ShapeGathering* gathering);
  void Refuse(ShapeGathering* gathering);
  void Forget(Gatherings::iterator gathering);
  void FreeIfUnwanted(const std::string& hash);
  void SetShape(std::shared_ptr<const shape::Shape> shape, bool coarse, Known* known);

  const std::uint64_t triangles_max_;
  const std::uint64_t shapes_max_;
  const std::uint64_t bytes_max_;
  ShapeBuilder& builder_;
  std::map<std::string, Known> shapes_;  ///< By hash; verified.
  Gatherings gatherings_;
  std::map<std::string, std::set<ShapeUser>> users_;  ///< By hash, known or not.
  std::set<std::uint64_t> holders_;
  std::uint64_t bytes_ = 0;
  std::uint64_t held_bytes_ = 0;
  ShapeCounters counters_;
};

/// The first digits of a hash, by which people tell shapes apart.
std::string ShortHash(const std::string& hash);

}  // namespace collision::server
