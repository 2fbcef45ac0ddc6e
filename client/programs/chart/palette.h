// Colours, marks and dashes of curves. They belong to names, so that a reader learns them once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace collision::chart {

/// Colours that the colour-blind tell apart (Okabe and Ito, "Color universal design", 2008), with
/// grey in place of yellow, which is too light on white.
enum class Colour { kBlue, kVermilion, kGreen, kPurple, kOrange, kSky, kBlack, kGrey };
inline constexpr std::size_t kColours = 8;

/// Gnuplot's numbers of its marks. The cross is missing: it stands for points at infinity.
enum class Mark {
  kPlus = 1,
  kStar = 3,
  kOpenSquare = 4,
  kSquare = 5,
  kOpenCircle = 6,
  kCircle = 7,
  kOpenTriangle = 8,
  kTriangle = 9,
  kOpenTriangleDown = 10,
  kTriangleDown = 11,
  kOpenDiamond = 12,
  kDiamond = 13,
  kOpenPentagon = 14,
  kPentagon = 15
};

/// Different patterns of a dashed line; 0 is solid.
inline constexpr int kDashes = 8;

/// How a curve is drawn.
struct Look {
  Colour colour = Colour::kBlack;
  Mark mark = Mark::kOpenCircle;
  int dash = 0;  ///< In [0, kDashes).

  bool operator==(const Look&) const = default;
};

/// "#0072b2".
std::string HtmlColour(Colour colour);
/// Gnuplot's words for a dash, "solid" or "(12,4)".
std::string GnuplotDash(int dash);

/// A number that depends on the letters alone (FNV-1a).
std::uint32_t HashOfName(const std::string& name);

/// The look of a name of its own accord: always the same, with an open mark. Filled marks are left
/// to the names that a caller has chosen a look for.
Look LookOf(const std::string& name);

/// The marks that LookOf() chooses from.
inline constexpr std::array kOpenMarks = {
    Mark::kOpenCircle,       Mark::kOpenSquare,   Mark::kOpenTriangle, Mark::kOpenDiamond,
    Mark::kOpenTriangleDown, Mark::kOpenPentagon, Mark::kStar,         Mark::kPlus};

}  // namespace collision::chart
