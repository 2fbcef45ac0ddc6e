// A radar in characters: the surroundings of a ship, seen from above.
#pragma once

#include <string>
#include <vector>

#include "collision/types.h"

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

/// The least of 10, 20, 50, 100, ... metres that shows nine of ten of the others, then `zoom` steps
/// of that series farther (> 0) or closer (< 0); at least 10 m.
double RadarRange(const RadarPicture& picture, int zoom);

/// `rows` lines of `columns` characters (not bytes), x to the right and y up; a character is twice
/// as high as wide. The ship is an arrow along its heading; the others are `o` at its height within
/// a tenth of the range, `^` above, `v` below, `*` in contact. The last line has a scale. There is
/// no picture for less than 12 columns or 4 rows.
std::vector<std::string> DrawRadar(const RadarPicture& picture, std::size_t columns,
                                   std::size_t rows);

}  // namespace collision::client
