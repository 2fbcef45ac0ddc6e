// What a C program fills in, as values of the C++ library.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>

#include "client/c/guard.h"
#include "collision/collision.h"
#include "collision/monitor.h"
#include "collision/shape.h"
#include "collision/types.h"
#include "collision/world.h"

struct collision_shape {
  std::shared_ptr<const collision::client::Shape> shape;
};

namespace collision::client::c {

collision_world_options DefaultWorldOptions();
collision_monitor_options DefaultMonitorOptions();
collision_agent_description DefaultDescription();
collision_state DefaultState();
collision_geometry DefaultGeometry();

/// Puts the first `size` bytes of `value`, whose struct_size becomes that, into `to`.
template <class Struct>
void Initialize(Struct value, Struct* to, std::size_t size) noexcept {
  if (to == nullptr || size < sizeof value.struct_size) return;
  std::memset(static_cast<void*>(to), 0, size);
  value.struct_size = static_cast<std::uint32_t>(size);
  std::memcpy(static_cast<void*>(to), &value, std::min(size, sizeof value));
}

/// What a program of any version has given, over `defaults`. Throws std::invalid_argument if it was
/// not initialized.
template <class Struct>
Struct Given(const char* name, Struct defaults, const Struct* given) {
  Require(name, given);
  // No member is longer, and each begins at a multiple of its length: none is read in part.
  constexpr std::size_t kMember = 8;
  const std::size_t whole = given->struct_size / kMember * kMember;
  if (whole == 0) {
    throw std::invalid_argument(std::string(name) + ": struct_size " +
                                std::to_string(given->struct_size) +
                                ", allowed: what its ..._init() sets");
  }
  std::memcpy(static_cast<void*>(&defaults), given, std::min(whole, sizeof defaults));
  return defaults;
}

/// Throws std::invalid_argument unless a program's structure holds something.
void RequireSize(std::size_t size);

/// Each throws std::invalid_argument with the member, its value and what is allowed.
WorldOptions FromC(const collision_world_options& options);
MonitorOptions FromC(const collision_monitor_options& options);
AgentDescription FromC(const collision_agent_description& description);
State FromC(const collision_state& state);
AgentId FromC(const collision_agent_id& id);
Geometry FromC(const collision_geometry& geometry);

}  // namespace collision::client::c
