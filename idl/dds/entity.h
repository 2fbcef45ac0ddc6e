// Lifetime and errors of DDS entities.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "dds/dds.h"

namespace collision::dds {

/// Passes a handle or a count through. Throws std::runtime_error saying what failed and why, if DDS
/// refused.
dds_entity_t Check(dds_return_t result, const std::string& what);

using Qos = std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)>;

inline Qos MakeQos() { return {dds_create_qos(), &dds_delete_qos}; }

/// An entity; the destructor deletes it and everything that was made inside it.
class Entity {
 public:
  explicit Entity(dds_entity_t handle) : handle_(handle) {}
  Entity(Entity&& other) noexcept : handle_(std::exchange(other.handle_, 0)) {}
  Entity& operator=(Entity&&) = delete;
  ~Entity() {
    if (handle_ > 0) dds_delete(handle_);
  }
  dds_entity_t get() const { return handle_; }

 private:
  dds_entity_t handle_;
};

}  // namespace collision::dds
