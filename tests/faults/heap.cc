#include "tests/faults/heap.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace collision::faults {
namespace {

struct Counted {
  std::atomic<std::int64_t> live = 0, peak = 0;
};
constinit std::array<Counted, kOwners> counted;
constinit thread_local Owner owner_now = Owner::kTest;

}  // namespace

HeapUse HeapOf(Owner owner) {
  const Counted& one = counted[static_cast<std::size_t>(owner)];
  return {.live = one.live, .peak = one.peak};
}

void ForgetHeapPeaks() {
  for (Counted& one : counted) one.peak = one.live.load();
}

OnBehalfOf::OnBehalfOf(Owner owner) : before_(owner_now) { owner_now = owner; }
OnBehalfOf::~OnBehalfOf() { owner_now = before_; }

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
namespace {

/// Stands before each block, whose owner is credited when it is freed.
struct alignas(std::max_align_t) Header {
  std::uint64_t size;
  Owner owner;
  std::uint32_t offset;  ///< Of the block in what malloc() gave.
};

void* Allocate(std::size_t size, std::size_t alignment) {
  const std::size_t offset = std::max(sizeof(Header), alignment);
  const std::size_t total = (offset + size + alignment - 1) / alignment * alignment;
  auto* start = static_cast<std::byte*>(std::aligned_alloc(alignment, total));
  if (start == nullptr) throw std::bad_alloc();
  std::byte* block = start + offset;
  new (block - sizeof(Header))
      Header{.size = size, .owner = owner_now, .offset = static_cast<std::uint32_t>(offset)};
  Counted& one = counted[static_cast<std::size_t>(owner_now)];
  const auto bytes = static_cast<std::int64_t>(size);
  const std::int64_t live = one.live.fetch_add(bytes, std::memory_order_relaxed) + bytes;
  std::int64_t peak = one.peak.load(std::memory_order_relaxed);
  while (live > peak && !one.peak.compare_exchange_weak(peak, live)) continue;
  return block;
}

void Free(void* block) noexcept {
  if (block == nullptr) return;
  auto* bytes = static_cast<std::byte*>(block);
  const Header header = *reinterpret_cast<Header*>(bytes - sizeof(Header));
  counted[static_cast<std::size_t>(header.owner)].live.fetch_sub(
      static_cast<std::int64_t>(header.size), std::memory_order_relaxed);
  std::free(bytes - header.offset);
}

}  // namespace
#endif

}  // namespace collision::faults

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
// The other forms of the standard library call these.
void* operator new(std::size_t size) {
  return collision::faults::Allocate(size, alignof(std::max_align_t));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return collision::faults::Allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* block) noexcept { collision::faults::Free(block); }
void operator delete(void* block, std::size_t) noexcept { collision::faults::Free(block); }
void operator delete(void* block, std::align_val_t) noexcept { collision::faults::Free(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept {
  collision::faults::Free(block);
}
#endif
