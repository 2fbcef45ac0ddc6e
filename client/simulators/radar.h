// A radar in characters: what is around a ship, seen from above.
#pragma once

#include <string>
#include <vector>

#include "client/types.h"

namespace collision::client {

struct RadarBlip {
  Vector3 position_m{};
  bool touching = false;  ///< In a confirmed contact.
};

struct RadarPicture {
  Vector3 own_m{};           ///< In the middle.
  Vector3 heading{1, 0, 0};  ///< Unit.
  std::vector<RadarBlip> others;
  double range_m = 50;  ///< From the middle to the nearer edge.
};

/// The least of 10, 20, 50, 100, ... metres in which most (nine of ten) of the others are seen,
/// `zoom` steps of that series farther (> 0) or closer (< 0); 10 m at least.
double RadarRange(const RadarPicture& picture, int zoom);

/// `rows` lines of `columns` characters (not bytes), x to the right and y up; a character is twice
/// as high as wide. The ship is an arrow along its heading, the others are `o` at its height within
/// a tenth of the range, `^` above, `v` below, `*` in contact. In the last line a scale. Less than
/// 12 columns or 4 rows give no picture.
std::vector<std::string> DrawRadar(const RadarPicture& picture, std::size_t columns,
                                   std::size_t rows);

/// The first `columns` characters of UTF-8 text.
std::string Cut(const std::string& text, std::size_t columns);

}  // namespace collision::client
