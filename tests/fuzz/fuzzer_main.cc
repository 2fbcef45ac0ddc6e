// One target as libFuzzer wants it. FUZZ_TARGET is the function's name.
#include "tests/fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  collision::fuzz::FUZZ_TARGET({data, size});
  return 0;
}
