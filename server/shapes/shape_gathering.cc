#include "server/shapes/shape_gathering.h"

#include <utility>

namespace collision::server {

void PartSet::Insert(std::uint32_t part) {
  count_ += present_[part] ? 0 : 1;
  present_[part] = true;
}

void PartSet::Erase(std::uint32_t part) {
  if (part >= present_.size()) return;
  count_ -= present_[part] ? 1 : 0;
  present_[part] = false;
}

ShapeGathering::ShapeGathering(std::uint64_t total_bytes)
    : total_bytes_(total_bytes),
      arrived_(ShapeParts(total_bytes)),
      present_(ShapeParts(total_bytes)) {}

bool ShapeGathering::Add(const v1::ShapePart& part) {
  if (arrived_.Contains(part.part())) {
    if (!Repeats(part)) return false;
    present_.Insert(part.part());
    return true;
  }
  arrived_.Insert(part.part());
  present_.Insert(part.part());
  if (refused_) return true;
  bytes_ += part.bytes().size();
  if (part.part() != prefix_.size() / wire::kShapePartBytes) {
    later_[part.part()] = part.bytes();
    return true;
  }
  Append(part.bytes());
  while (!later_.empty() && later_.begin()->first == prefix_.size() / wire::kShapePartBytes) {
    Append(later_.begin()->second);
    later_.erase(later_.begin());
  }
  return true;
}

bool ShapeGathering::Repeats(const v1::ShapePart& part) const {
  if (refused_) return true;
  const auto later = later_.find(part.part());
  if (later != later_.end()) return later->second == part.bytes();
  return prefix_.compare(part.part() * wire::kShapePartBytes, part.bytes().size(), part.bytes()) ==
         0;
}

void ShapeGathering::Append(const std::string& bytes) {
  prefix_ += bytes;
  hasher_.Add(bytes);
}

std::string ShapeGathering::TakeBytes() {
  bytes_ = 0;
  return std::exchange(prefix_, {});
}

void ShapeGathering::Refuse() {
  refused_ = true;
  bytes_ = 0;
  prefix_ = std::string();
  later_.clear();
}

}  // namespace collision::server
