// Built whatever COLLISION_WIDE_BITS says: the processor decides.
#undef COLLISION_WIDE_BITS
#define COLLISION_WIDE_BITS 512
#include "collision_core/simd/lanes_avx2.h"
#include "tests/collision_core/simd/lanes_answers.h"

#ifdef COLLISION_SIMD
#include "tests/collision_core/simd/lanes_answers_wide.h"
#endif

namespace collision::simd {

AnswerLanes Avx2Answers() {
#ifdef COLLISION_SIMD
  return avx2::IsSupported() ? &lanes_answers::avx2::Answer : nullptr;
#else
  return nullptr;
#endif
}

}  // namespace collision::simd
