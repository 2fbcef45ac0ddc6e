// Whether this is a build with a sanitizer, where all takes several times as long.
#pragma once

namespace collision {

/// Then random tests draw fewer cases: what a sanitizer finds it finds in few.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace collision
