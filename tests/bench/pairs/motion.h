// How the bodies of a precision benchmark lie to each other or move.
#pragma once

namespace collision::bench {

enum class Motion {
  kTranslation,  ///< Upright, any direction; gaps and overlaps of 1e-3 to 0.5 of the size.
  kRotation,     ///< Turned any way; the same gaps and overlaps.
  kGrazing       ///< Turned any way; gaps and overlaps of 1e-3 to 1e-12 of the size.
};
const char* Name(Motion motion);
inline constexpr Motion kMotions[] = {Motion::kTranslation, Motion::kRotation, Motion::kGrazing};

}  // namespace collision::bench
