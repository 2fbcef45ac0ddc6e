// The answer to the question whether two bodies touch.
#pragma once

namespace collision::narrow_phase {

/// Whether two bodies are apart or touch; for solids, one inside the other is touching.
enum class Verdict { kApart, kTouching, kUndecided };

}  // namespace collision::narrow_phase
