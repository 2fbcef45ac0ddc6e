#include "server/shapes/grown_shapes.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <utility>

#include "collision_core/base/check.h"

namespace collision::server {

GrownShapes::Grown GrownShapes::Use(const Key& key,
                                    const std::shared_ptr<const shape::Shape>& shape) {
  const auto& [simulator, hash, margin] = key;
  const auto found = entries_.find(key);
  const bool is_there = found != entries_.end();
  if (is_there && found->second.from == shape) {
    ++found->second.users;
    return found->second.grown;
  }
  if (!CanGrow(*shape)) {
    return fmt::format(
        "{:.9g} with a shape of {} triangles and {} solids; allowed with a margin: "
        "{} of both. The agent stays its ball",
        margin, shape->mesh().triangles.size(), shape->solids().size(), shape::kGrownElementsMax);
  }
  const bool twin = is_there && found->second.from->IsSameBodyAs(*shape);
  Entry entry{.from = shape, .grown = nullptr, .users = is_there ? found->second.users : 0};
  entry.grown = GrownShape(shape, margin, twin ? found->second.grown.get() : nullptr);
  entry.bytes = entry.grown->bytes();
  const std::uint64_t before = is_there ? found->second.bytes : 0;
  const std::uint64_t free = bytes_max_ - std::min(bytes_max_, bytes_) + before;
  if (entry.bytes > quotas_.RoomFor(simulator, Resource::kTreeBytes, free) + before) {
    return fmt::format(
        "{:.9g}; no room for the {} bytes of its shape with the margin; allowed: {} "
        "of all (tree_bytes_max), less what is guaranteed to others. The agent "
        "stays its ball",
        margin, entry.bytes, bytes_max_);
  }
  quotas_.Take(simulator, Resource::kTreeBytes, entry.bytes);
  quotas_.GiveBack(simulator, Resource::kTreeBytes, before);
  bytes_ += entry.bytes - before;
  ++entry.users;
  return (entries_[key] = std::move(entry)).grown;
}

void GrownShapes::Drop(const Key& key) {
  const auto found = entries_.find(key);
  CORE_CHECK(found != entries_.end() && found->second.users > 0, "a shape in use is dropped");
  if (--found->second.users > 0) return;
  quotas_.GiveBack(std::get<0>(key), Resource::kTreeBytes, found->second.bytes);
  bytes_ -= found->second.bytes;
  entries_.erase(found);
}

}  // namespace collision::server
