#include "client/programs/gateway/scene/shape_store.h"

#include <utility>

#include "idl/limits.h"
#include "idl/sha256.h"

namespace collision::gateway {

bool ShapeStore::Take(const v1::ShapePart& part) {
  const std::lock_guard lock(mutex_);
  const std::string& hash = part.content_hash();
  if (whole_.count(hash) > 0 || part.parts() == 0 || part.part() >= part.parts()) return false;
  if (part.total_bytes() > kBytesMax - bytes_ || part.bytes().size() > wire::kShapePartBytes ||
      part.parts() > kBytesMax / wire::kShapePartBytes) {
    return false;
  }
  Gathering& gathering = gathering_[hash];
  if (gathering.parts.empty()) {
    gathering.parts.resize(part.parts());
    gathering.missing = part.parts();
  }
  if (part.part() >= gathering.parts.size() || !gathering.parts[part.part()].empty()) return false;
  gathering.parts[part.part()] = part.bytes();
  bytes_ += part.bytes().size();
  if (--gathering.missing > 0) return false;
  std::string bytes;
  for (const std::string& one : gathering.parts) bytes += one;
  gathering_.erase(hash);
  if (Sha256(bytes) != hash) {
    bytes_ -= bytes.size();
    return false;
  }
  whole_[hash] = MakePayload(std::move(bytes));
  return true;
}

Payload ShapeStore::Find(const std::string& hash) const {
  const std::lock_guard lock(mutex_);
  const auto found = whole_.find(hash);
  return found == whole_.end() ? nullptr : found->second;
}

}  // namespace collision::gateway
