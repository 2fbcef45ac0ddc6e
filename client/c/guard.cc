#include "client/c/guard.h"

#include <exception>
#include <new>
#include <stdexcept>

namespace collision::client::c {
namespace {

/// As much of a text as fits: telling of a failure must not fail.
constexpr std::size_t kTextMax = 1024;
thread_local char last_error[kTextMax] = "";

collision_result Fail(collision_result result, const char* text) noexcept {
  std::size_t size = 0;
  for (; size + 1 < kTextMax && text[size] != '\0'; ++size) last_error[size] = text[size];
  last_error[size] = '\0';
  return result;
}

}  // namespace

collision_result Guarded(const std::function<collision_result()>& call) noexcept {
  try {
    return call();
  } catch (const std::invalid_argument& error) {
    return Fail(COLLISION_INVALID, error.what());
  } catch (const std::length_error& error) {
    return Fail(COLLISION_FULL, error.what());
  } catch (const std::logic_error& error) {
    return Fail(COLLISION_MISUSED, error.what());
  } catch (const std::bad_alloc&) {
    return Fail(COLLISION_NO_MEMORY, "memory is exhausted");
  } catch (const std::runtime_error& error) {
    return Fail(COLLISION_UNAVAILABLE, error.what());
  } catch (const std::exception& error) {
    return Fail(COLLISION_FAILED, error.what());
  } catch (...) {
    return Fail(COLLISION_FAILED, "not an exception of the library");
  }
}

void Require(const char* name, const void* pointer) {
  if (pointer == nullptr) {
    throw std::invalid_argument(std::string(name) + ": null, allowed: a pointer");
  }
}

const char* LastError() noexcept { return last_error; }

}  // namespace collision::client::c
