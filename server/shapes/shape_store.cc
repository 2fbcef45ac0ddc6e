#include "server/shapes/shape_store.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "idl/limits.h"
#include "server/codec/codec.h"
#include "server/shapes/shape_decoding.h"

namespace collision::server {
namespace {

/// A refused shape with more parts is not remembered: each of its parts is refused.
constexpr std::uint64_t kRefusedPartsMax = 65536;

/// Bytes per triangle of a mesh whose triangles share no vertex.
constexpr std::uint64_t kBytesPerTriangleMax = 3 * kShapeVertexBytes + kShapeTriangleBytes;

/// Bytes of a shape beside its mesh, which is counted like the bytes that brought it.
std::size_t TreeBytesOf(const shape::Shape& shape) {
  const geometry::TriangleMesh& mesh = shape.mesh();
  return shape.bytes() - mesh.vertices.capacity() * sizeof mesh.vertices[0] -
         mesh.triangles.capacity() * sizeof mesh.triangles[0];
}

/// A longer shape certainly has too many triangles, solids or points of solids.
std::uint64_t ShapeBytesMax(std::uint64_t triangles_max) {
  return kShapeHeaderBytes + kBytesPerTriangleMax * triangles_max + kSolidHeaderBytes +
         kSolidBytes * shape::kSolidsMax + kShapeVertexBytes * wire::kShapeHullPointsMax;
}

Refusal BadShape(const v1::ShapePart& part, const char* field, std::string what) {
  Refusal refusal = At(part);
  refusal.reason = v1::REJECTED_BAD_SHAPE;
  refusal.field = field;
  refusal.detail = "shape " + ShortHash(part.content_hash()) + ": " + std::move(what);
  return refusal;
}

}  // namespace

std::string ShortHash(const std::string& hash) {
  std::string text;
  for (const unsigned char byte : hash.substr(0, 4)) text += fmt::format("{:02x}", byte);
  return text;
}

ShapeStore::ShapeStore(const v1::Config& config, ShapeBuilder* builder, SimulatorQuotas* quotas)
    : triangles_max_(config.shape_triangles_max()),
      shapes_max_(config.shapes_max()),
      bytes_max_(config.shape_bytes_max()),
      tree_bytes_max_(config.tree_bytes_max()),
      builder_(*builder),
      quotas_(*quotas) {}

bool ShapeStore::HasRoomFor(std::uint64_t simulator, std::uint64_t bytes) const {
  return bytes <= quotas_.RoomFor(simulator, Resource::kShapeBytes, bytes_max_ - bytes_);
}

/// Of several owners one that has room is enough.
bool ShapeStore::HasRoomForTree(const Known& known, std::uint64_t tree_bytes) const {
  const std::uint64_t before = known.shape ? TreeBytesOf(*known.shape) : 0;
  const std::uint64_t free = tree_bytes_max_ - counters_.tree_bytes;
  if (known.owners.empty()) return tree_bytes <= free + before;
  return std::any_of(known.owners.begin(), known.owners.end(), [&](const auto& owner) {
    return tree_bytes <= quotas_.RoomFor(owner.first, Resource::kTreeBytes, free) + before;
  });
}

void ShapeStore::SetOwner(std::uint64_t simulator, const PartSet& parts, Known* known) {
  if (!known->owners.emplace(simulator, parts).second) return;
  quotas_.Take(simulator, Resource::kShapes, 1);
  quotas_.Take(simulator, Resource::kShapeBytes, known->bytes);
  if (known->shape) quotas_.Take(simulator, Resource::kTreeBytes, TreeBytesOf(*known->shape));
}

void ShapeStore::RemoveOwner(std::uint64_t simulator, Known* known) {
  if (known->owners.erase(simulator) == 0) return;
  quotas_.GiveBack(simulator, Resource::kShapes, 1);
  quotas_.GiveBack(simulator, Resource::kShapeBytes, known->bytes);
  if (known->shape) quotas_.GiveBack(simulator, Resource::kTreeBytes, TreeBytesOf(*known->shape));
}

/// What is gathered for the simulator has grown or shrunk.
void ShapeStore::SetGathered(std::uint64_t simulator, std::uint64_t before, std::uint64_t after) {
  bytes_ = bytes_ - before + after;
  quotas_.Take(simulator, Resource::kShapeBytes, after);
  quotas_.GiveBack(simulator, Resource::kShapeBytes, before);
}

bool ShapeStore::Holds(std::uint64_t simulator, const std::string& hash) const {
  if (gatherings_.contains({hash, simulator})) return true;
  const auto known = shapes_.find(hash);
  return known != shapes_.end() && known->second.owners.contains(simulator);
}

std::optional<Refusal> ShapeStore::CheckNumber(const v1::ShapePart& part) const {
  const std::string* hash = numbers_.HashOf(part.simulator_id(), part.shape());
  if (hash == nullptr || *hash == part.content_hash()) return std::nullopt;
  return BadShape(part, "shape",
                  fmt::format("{}, which this simulator gave shape {}; allowed: a number that no "
                              "other shape has",
                              part.shape(), ShortHash(*hash)));
}

std::optional<Refusal> ShapeStore::Take(const v1::ShapePart& part) {
  ++counters_.parts_received;
  if (auto refusal = CheckShapePart(part)) return refusal;
  if (auto refusal = CheckNumber(part)) return refusal;
  const auto known = shapes_.find(part.content_hash());
  const std::optional<Refusal> refusal =
      known != shapes_.end() ? TakeKnown(part, &known->second) : TakeUnknown(part);
  if (Holds(part.simulator_id(), part.content_hash())) {
    numbers_.Set(part.simulator_id(), part.shape(), part.content_hash());
  }
  return refusal;
}

/// Ignores the bytes: the shape of this hash is known.
std::optional<Refusal> ShapeStore::TakeKnown(const v1::ShapePart& part, Known* known) {
  if (part.total_bytes() != known->bytes) {
    return BadShape(
        part, "total_bytes",
        fmt::format("{}; the shape of this hash has {}", part.total_bytes(), known->bytes));
  }
  SetOwner(part.simulator_id(), PartSet(ShapeParts(known->bytes)), known);
  known->owners.at(part.simulator_id()).Insert(part.part());
  holders_.insert(part.simulator_id());
  return std::nullopt;
}

std::optional<Refusal> ShapeStore::TakeUnknown(const v1::ShapePart& part) {
  const Key key(part.content_hash(), part.simulator_id());
  auto found = gatherings_.find(key);
  if (found != gatherings_.end() && found->second.refused() &&
      (found->second.total_bytes() != part.total_bytes() || found->second.Contains(part.part()))) {
    Forget(found);
    found = gatherings_.end();
  }
  if (found == gatherings_.end()) {
    if (auto refusal = Begin(part)) return refusal;
    found = gatherings_.find(key);
  }
  ShapeGathering& gathering = found->second;
  if (auto refusal = Add(part, &gathering)) {
    Refuse(part.simulator_id(), &gathering);
    // Counted, so that the same part begins another attempt when it comes again.
    if (gathering.total_bytes() == part.total_bytes()) gathering.Add(part);
    return refusal;
  }
  return gathering.complete() ? Complete(part, &gathering) : std::nullopt;
}

/// Makes room for a shape of which this is the first part. A shape that is too large is noted as
/// refused, so that its other parts are not refused one by one.
std::optional<Refusal> ShapeStore::Begin(const v1::ShapePart& part) {
  const std::uint64_t bytes_max = std::min(bytes_max_, ShapeBytesMax(triangles_max_));
  const std::uint64_t free =
      shapes_max_ - std::min<std::uint64_t>(shapes_max_, shapes_.size() + gatherings_.size());
  if (quotas_.RoomFor(part.simulator_id(), Resource::kShapes, free) == 0) {
    ++counters_.refused;
    return BadShape(part, "content_hash",
                    fmt::format("all places are taken; allowed: {} shapes (shapes_max), less what "
                                "is guaranteed to other simulators",
                                shapes_max_));
  }
  std::optional<Refusal> refusal;
  if (part.total_bytes() > bytes_max) {
    refusal = BadShape(
        part, "total_bytes",
        fmt::format("{}; allowed: {} to {} ({} triangles, shape_triangles_max, and the most "
                    "that solids take, but no more than shape_bytes_max)",
                    part.total_bytes(), kShapeHeaderBytes, bytes_max, triangles_max_));
  }
  if (refusal && part.parts() > kRefusedPartsMax) {
    ++counters_.refused;
    return refusal;
  }
  holders_.insert(part.simulator_id());
  const Key key(part.content_hash(), part.simulator_id());
  ShapeGathering& gathering = gatherings_.emplace(key, part.total_bytes()).first->second;
  quotas_.Take(part.simulator_id(), Resource::kShapes, 1);
  if (refusal) {
    Refuse(part.simulator_id(), &gathering);
    gathering.Add(part);
  }
  return refusal;
}

/// Adds a part to those that are there, or says why it does not fit.
std::optional<Refusal> ShapeStore::Add(const v1::ShapePart& part, ShapeGathering* gathering) {
  if (gathering->total_bytes() != part.total_bytes()) {
    return BadShape(
        part, "total_bytes",
        fmt::format("{}; other parts of it say {}", part.total_bytes(), gathering->total_bytes()));
  }
  if (!gathering->refused() && !gathering->Contains(part.part()) &&
      !HasRoomFor(part.simulator_id(), part.bytes().size())) {
    return BadShape(part, "bytes",
                    fmt::format("no room for part {}; allowed: {} bytes of all shapes together "
                                "(shape_bytes_max), less what is guaranteed to other simulators",
                                part.part(), bytes_max_));
  }
  const std::uint64_t before = gathering->bytes();
  const bool agrees = gathering->Add(part);
  SetGathered(part.simulator_id(), before, gathering->bytes());
  if (agrees) return std::nullopt;
  return BadShape(part, "bytes", fmt::format("part {} came again with other bytes", part.part()));
}

/// All parts are there: from now on the shape belongs to every simulator that wrote any of it.
std::optional<Refusal> ShapeStore::Complete(const v1::ShapePart& part, ShapeGathering* gathering) {
  const std::string digest = gathering->Digest();
  if (digest != part.content_hash()) {
    Refuse(part.simulator_id(), gathering);
    return BadShape(part, "content_hash",
                    fmt::format("its {} bytes have another SHA-256, {}...",
                                gathering->total_bytes(), ShortHash(digest)));
  }
  const std::string& hash = part.content_hash();
  Known& known = shapes_[hash];
  known.bytes = gathering->total_bytes();
  bytes_ += known.bytes;
  const std::uint64_t gathered = gathering->bytes();
  builder_.Start(hash, gathering->TakeBytes(), part.simulator_id());
  SetGathered(part.simulator_id(), gathered, 0);
  auto next = gatherings_.lower_bound({hash, 0});
  while (next != gatherings_.end() && next->first.first == hash) {
    const auto writer = next++;
    if (!writer->second.refused()) {
      SetOwner(writer->first.second, writer->second.present(), &known);
    } else {
      numbers_.Erase(writer->first.second, hash);
    }
    Forget(writer);
  }
  return std::nullopt;
}

void ShapeStore::Refuse(std::uint64_t simulator, ShapeGathering* gathering) {
  ++counters_.refused;
  SetGathered(simulator, gathering->bytes(), 0);
  gathering->Refuse();
}

void ShapeStore::Forget(Gatherings::iterator gathering) {
  const std::uint64_t simulator = gathering->first.second;
  SetGathered(simulator, gathering->second.bytes(), 0);
  quotas_.GiveBack(simulator, Resource::kShapes, 1);
  gatherings_.erase(gathering);
}

void ShapeStore::Dispose(std::uint64_t simulator, std::uint32_t number, std::uint32_t part) {
  const std::string* hash = numbers_.HashOf(simulator, number);
  if (hash != nullptr) Dispose(simulator, std::string(*hash), part);
}

void ShapeStore::Dispose(std::uint64_t simulator, const std::string& hash, std::uint32_t part) {
  DisposeOf(simulator, hash, part);
  if (!Holds(simulator, hash)) numbers_.Erase(simulator, hash);
}

void ShapeStore::DisposeOf(std::uint64_t simulator, const std::string& hash, std::uint32_t part) {
  const auto gathering = gatherings_.find({hash, simulator});
  if (gathering != gatherings_.end()) {
    gathering->second.present().Erase(part);
    if (gathering->second.present().count() == 0) Forget(gathering);
  }
  const auto known = shapes_.find(hash);
  if (known == shapes_.end()) return;
  const auto owner = known->second.owners.find(simulator);
  if (owner == known->second.owners.end()) return;
  owner->second.Erase(part);
  if (owner->second.count() > 0) return;
  RemoveOwner(simulator, &known->second);
  FreeIfUnwanted(hash);
}

void ShapeStore::Release(std::uint64_t simulator) {
  numbers_.Release(simulator);
  if (holders_.erase(simulator) == 0) return;
  for (auto next = gatherings_.begin(); next != gatherings_.end();) {
    const auto gathering = next++;
    if (gathering->first.second == simulator) Forget(gathering);
  }
  for (auto next = shapes_.begin(); next != shapes_.end();) {
    const auto known = next++;
    if (!known->second.owners.contains(simulator)) continue;
    RemoveOwner(simulator, &known->second);
    FreeIfUnwanted(std::string(known->first));
  }
}

void ShapeStore::RemoveUser(const std::string& hash, ShapeUser user) {
  const auto users = users_.find(hash);
  if (users == users_.end()) return;
  users->second.erase(user);
  if (!users->second.empty()) return;
  users_.erase(users);
  FreeIfUnwanted(hash);
}

void ShapeStore::FreeIfUnwanted(const std::string& hash) {
  const auto known = shapes_.find(hash);
  if (known == shapes_.end() || !known->second.owners.empty() || users_.contains(hash)) return;
  bytes_ -= known->second.bytes;
  if (!known->second.shape || known->second.coarse) builder_.Forget(hash);
  SetShape(nullptr, false, &known->second);
  shapes_.erase(known);
}

/// Replaces the shape, null for none, and keeps the counters.
void ShapeStore::SetShape(std::shared_ptr<const shape::Shape> shape, bool coarse, Known* known) {
  const auto for_each_owner = [this, known](auto change) {
    for (const auto& [owner, parts] : known->owners) {
      (quotas_.*change)(owner, Resource::kTreeBytes, TreeBytesOf(*known->shape));
    }
  };
  if (known->shape) {
    for_each_owner(&SimulatorQuotas::GiveBack);
    --counters_.visible;
    counters_.coarse -= known->coarse;
    counters_.tree_nodes -= known->shape->tree().nodes.size();
    counters_.tree_bytes -= TreeBytesOf(*known->shape);
  }
  known->shape = std::move(shape);
  known->coarse = coarse;
  if (known->shape) {
    for_each_owner(&SimulatorQuotas::Take);
    ++counters_.visible;
    counters_.coarse += known->coarse;
    counters_.tree_nodes += known->shape->tree().nodes.size();
    counters_.tree_bytes += TreeBytesOf(*known->shape);
  }
}

std::optional<ReadyShape> ShapeStore::MakeVisible(const ReadyTree& tree) {
  const auto known = shapes_.find(tree.hash);
  if (known == shapes_.end()) return std::nullopt;
  const bool refined = known->second.shape != nullptr;
  if (refined && (tree.coarse || !known->second.coarse)) return std::nullopt;
  ReadyShape ready{.built = builder_.Await(tree), .refined = refined, .owners = {}, .users = {}};
  for (const auto& [owner, parts] : known->second.owners) ready.owners.push_back(owner);
  if (const auto users = users_.find(tree.hash); users != users_.end()) {
    ready.users.assign(users->second.begin(), users->second.end());
  }
  LimitTree(known->second, &ready);
  if (ready.built.shape) {
    SetShape(ready.built.shape, ready.built.coarse, &known->second);
  } else {
    ++counters_.refused;
    bytes_ -= known->second.bytes;
    builder_.Forget(tree.hash);
    for (const std::uint64_t owner : ready.owners) {
      RemoveOwner(owner, &known->second);
      numbers_.Erase(owner, tree.hash);
    }
    shapes_.erase(known);
  }
  return ready;
}

/// A tree for which there is no room: the coarse one stays, or the shape is refused.
void ShapeStore::LimitTree(const Known& known, ReadyShape* ready) const {
  BuiltShape& built = ready->built;
  if (!built.shape || HasRoomForTree(known, TreeBytesOf(*built.shape))) return;
  const std::uint64_t bytes = TreeBytesOf(*built.shape);
  built.shape = known.shape;
  built.coarse = false;
  ready->stays_coarse = known.shape != nullptr;
  if (!known.shape) {
    built.refusal = fmt::format(
        "no room for its tree of {} bytes; allowed: {} of all shapes "
        "together (tree_bytes_max), less what is guaranteed to others",
        bytes, tree_bytes_max_);
  }
}

std::shared_ptr<const shape::Shape> ShapeStore::Find(const std::string& hash) const {
  const auto known = shapes_.find(hash);
  return known == shapes_.end() ? nullptr : known->second.shape;
}

bool ShapeStore::HasWantedTree(const std::string& hash) const {
  const auto known = shapes_.find(hash);
  return known != shapes_.end() && known->second.shape && !known->second.coarse;
}

ShapeProgress ShapeStore::ProgressOf(std::uint64_t simulator, const std::string& hash) const {
  if (shapes_.contains(hash)) return {.whole = true};
  const auto gathering = gatherings_.find({hash, simulator});
  if (gathering == gatherings_.end() || gathering->second.refused()) return {};
  return {.arrived = gathering->second.arrived(), .parts = gathering->second.parts()};
}

ShapeCounters ShapeStore::counters() const {
  ShapeCounters counters = counters_;
  counters.gathering = gatherings_.size();
  counters.places = shapes_.size() + gatherings_.size();
  counters.bytes = bytes_;
  counters.builder = builder_.counters();
  return counters;
}

}  // namespace collision::server
