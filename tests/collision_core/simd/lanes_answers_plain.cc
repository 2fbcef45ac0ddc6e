#include "collision_core/simd/lanes_plain.h"

// The kernel comes after its lanes.
#include "tests/collision_core/simd/lanes_answers_wide.h"

namespace collision::simd {

AnswerLanes PlainAnswers() { return &lanes_answers::plain::Answer; }

}  // namespace collision::simd
