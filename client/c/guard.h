// How failures leave the C interface.
#pragma once

#include <functional>
#include <string>

#include "collision/collision.h"

namespace collision::client::c {

/// Runs `call`. What it throws becomes a negative result, and its text that of collision_error().
collision_result Guarded(const std::function<collision_result()>& call) noexcept;

/// The same for what hands out a pointer: null if it throws.
template <class Result>
const Result* GuardedPointer(const std::function<const Result*()>& call) noexcept {
  const Result* result = nullptr;
  Guarded([&] {
    result = call();
    return COLLISION_OK;
  });
  return result;
}

/// Throws std::invalid_argument, "name: null, allowed: a pointer", if it is null.
void Require(const char* name, const void* pointer);

const char* LastError() noexcept;

}  // namespace collision::client::c
