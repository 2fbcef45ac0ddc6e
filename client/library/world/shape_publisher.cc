#include "client/library/world/shape_publisher.h"

#include "idl/shape_bytes.h"

namespace collision::client {

void ShapePublisher::Add(const std::shared_ptr<const Shape>& shape, const Writer& write) {
  if (!shape) return;
  Entry& entry = entries_[shape->hash()];
  if (entry.agents++ > 0) return;
  entry.shape = shape;
  entry.number = next_number_++;
  WriteParts(entry, write);
}

void ShapePublisher::Remove(const std::string& hash, const Writer& write) {
  const auto entry = entries_.find(hash);
  if (entry == entries_.end() || --entry->second.agents > 0) return;
  v1::Input message;
  message.mutable_shape_removal()->set_simulator_id(simulator_id_);
  message.mutable_shape_removal()->set_shape(entry->second.number);
  entries_.erase(entry);
  write(message);
}

void ShapePublisher::WriteAll(const Writer& write) const {
  for (const auto& [hash, entry] : entries_) WriteParts(entry, write);
}

void ShapePublisher::WriteParts(const Entry& entry, const Writer& write) const {
  const std::string& bytes = entry.shape->bytes();
  v1::Input message;
  v1::ShapePart* part = message.mutable_shape_part();
  part->set_simulator_id(simulator_id_);
  part->set_shape(entry.number);
  part->set_content_hash(entry.shape->hash());
  part->set_parts(static_cast<std::uint32_t>(ShapeParts(bytes.size())));
  part->set_run(run_);
  part->set_total_bytes(bytes.size());
  for (std::uint32_t i = 0; i < part->parts(); ++i) {
    part->set_part(i);
    part->set_bytes(bytes.substr(i * wire::kShapePartBytes, wire::kShapePartBytes));
    write(message);
  }
}

}  // namespace collision::client
