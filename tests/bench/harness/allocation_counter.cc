#include "tests/bench/harness/allocation_counter.h"

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace collision::bench {
namespace {

std::atomic<std::uint64_t> allocations{0};
std::atomic<std::int64_t> live_bytes{0};

void* Counted(void* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  allocations.fetch_add(1, std::memory_order_relaxed);
  live_bytes.fetch_add(static_cast<std::int64_t>(malloc_usable_size(memory)),
                       std::memory_order_relaxed);
  return memory;
}

void Free(void* memory) {
  live_bytes.fetch_sub(static_cast<std::int64_t>(malloc_usable_size(memory)),
                       std::memory_order_relaxed);
  std::free(memory);
}

}  // namespace

std::uint64_t Allocations() { return allocations; }
std::int64_t LiveBytes() { return live_bytes; }

}  // namespace collision::bench

void* operator new(std::size_t size) { return collision::bench::Counted(std::malloc(size)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto unit = static_cast<std::size_t>(alignment);
  return collision::bench::Counted(std::aligned_alloc(unit, (size + unit - 1) / unit * unit));
}
void operator delete(void* memory) noexcept { collision::bench::Free(memory); }
void operator delete(void* memory, std::size_t) noexcept { collision::bench::Free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { collision::bench::Free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  collision::bench::Free(memory);
}
// The standard library's sorts ask for memory so, and give it back by the plain delete.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  void* memory = std::malloc(size);
  return memory == nullptr ? nullptr : collision::bench::Counted(memory);
}
void operator delete(void* memory, const std::nothrow_t&) noexcept {
  collision::bench::Free(memory);
}
