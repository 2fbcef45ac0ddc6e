#include "client/programs/scene/shape_store.h"

#include <utility>

#include "idl/limits.h"
#include "idl/sha256.h"

namespace collision::client {

bool ShapeStore::Take(const v1::ShapePart& part) {
  const std::lock_guard lock(mutex_);
  const std::string& hash = part.content_hash();
  if (whole_.count(hash) > 0 || part.parts() == 0 || part.part() >= part.parts()) return false;
  const std::size_t size = part.bytes().size();
  const std::size_t places = part.parts() * sizeof(std::string);
  const bool is_new = gathering_.count(hash) == 0;
  const std::size_t wanted = size + (is_new ? places : 0);
  if (size == 0 || size > wire::kShapePartBytes || wanted > kBytesMax - bytes_) return false;
  if (is_new && gathering_.size() == kGatheringMax) return false;
  Gathering& gathering = gathering_[hash];
  if (is_new) {
    gathering.parts.resize(part.parts());
    gathering.missing = part.parts();
    bytes_ += places;
  }
  if (part.part() >= gathering.parts.size() || !gathering.parts[part.part()].empty()) return false;
  gathering.parts[part.part()] = part.bytes();
  bytes_ += size;
  if (--gathering.missing > 0) return false;
  std::string bytes;
  for (const std::string& one : gathering.parts) bytes += one;
  bytes_ -= gathering.parts.size() * sizeof(std::string);
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

}  // namespace collision::client
