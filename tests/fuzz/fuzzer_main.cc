// One target as libFuzzer wants it. FUZZ_TARGET is the function's name.
#include <sanitizer/allocator_interface.h>

#include "tests/fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  collision::fuzz::FUZZ_TARGET({data, size});
  // A library without instrumentation may write beyond a block. The sanitizer notices when it gives
  // the block beside it back to the heap, which otherwise is hundreds of inputs later.
  __sanitizer_purge_allocator();
  return 0;
}
