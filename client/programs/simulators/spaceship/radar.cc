#include "client/programs/simulators/spaceship/radar.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace collision::client {
namespace {

constexpr std::size_t kColumnsMin = 12;
constexpr std::size_t kRowsMin = 4;
constexpr double kSameHeight = 0.1;  // of the range
constexpr std::array<double, 3> kSeries = {1, 2, 5};
constexpr int kSeriesSteps = 21;  // up to 10⁸ m

using Row = std::vector<std::string>;  // one character each

double SeriesValue(int step) {
  double value = 10 * kSeries[static_cast<std::size_t>(step % 3)];
  for (int decade = 0; decade < step / 3; ++decade) value *= 10;
  return value;
}

std::string Arrow(const Vector3& heading) {
  static const std::array<const char*, 8> arrows = {"→", "↗", "↑", "↖", "←", "↙", "↓", "↘"};
  // Straight up or down there is no direction to show.
  if (std::hypot(heading[0], heading[1]) < 0.2) return heading[2] > 0 ? "⊙" : "⊗";
  const double eighths = std::atan2(heading[1], heading[0]) / (std::acos(-1.0) / 4);
  return arrows[static_cast<std::size_t>(std::lround(eighths) + 8) % 8];
}

std::string Mark(const RadarBlip& blip, const RadarPicture& picture) {
  if (blip.touching) return "*";
  const double height = blip.position_m[2] - picture.own_m[2];
  if (std::fabs(height) <= kSameHeight * picture.range_m) return "o";
  return height > 0 ? "^" : "v";
}

// The metres that a length of the scale stands for: about a quarter of the width.
void DrawScale(double metres_per_column, Row* row) {
  int step = 0;
  const double room = static_cast<double>(row->size()) / 4 * metres_per_column;
  while (step < kSeriesSteps && SeriesValue(step + 1) <= room) ++step;
  const double length_m = std::min(SeriesValue(step), std::max(1.0, std::floor(room)));
  const auto length = static_cast<std::size_t>(std::lround(length_m / metres_per_column));
  char text[32];
  std::snprintf(text, sizeof text, " %g m", length_m);
  std::string label(text);
  std::size_t at = 1;
  const auto put = [&](const std::string& character) {
    if (at < row->size()) (*row)[at++] = character;
  };
  put("├");
  for (std::size_t i = 1; i < length; ++i) put("─");
  put("┤");
  for (const char character : label) put(std::string(1, character));
}

}  // namespace

double RadarRange(const RadarPicture& picture, int zoom) {
  std::vector<double> distances;
  for (const RadarBlip& blip : picture.others) {
    distances.push_back(std::max(std::fabs(blip.position_m[0] - picture.own_m[0]),
                                 std::fabs(blip.position_m[1] - picture.own_m[1])));
  }
  double needed = SeriesValue(1);
  if (!distances.empty()) {
    std::sort(distances.begin(), distances.end());
    needed = distances[(distances.size() - 1) * 9 / 10];
  }
  int step = 0;
  while (step < kSeriesSteps && SeriesValue(step) < needed) ++step;
  return SeriesValue(std::clamp(step + zoom, 0, kSeriesSteps));
}

std::vector<std::string> DrawRadar(const RadarPicture& picture, std::size_t columns,
                                   std::size_t rows) {
  if (columns < kColumnsMin || rows < kRowsMin) return {};
  std::vector<Row> grid(rows, Row(columns, " "));
  const double middle_column = static_cast<double>(columns - 1) / 2;
  const double middle_row = static_cast<double>(rows - 2) / 2;
  // Metres of a column; a row is worth two.
  const double metres = picture.range_m / std::min(middle_column, 2 * middle_row);
  for (std::size_t i = 0; i < columns; ++i) grid[rows - 1][i] = "─";
  for (const RadarBlip& blip : picture.others) {
    const double x = (blip.position_m[0] - picture.own_m[0]) / metres + middle_column;
    const double y = middle_row - (blip.position_m[1] - picture.own_m[1]) / (2 * metres);
    if (!(x > -0.5 && x < static_cast<double>(columns) - 0.5)) continue;
    if (!(y > -0.5 && y < static_cast<double>(rows) - 1.5)) continue;
    std::string& cell =
        grid[static_cast<std::size_t>(std::lround(y))][static_cast<std::size_t>(std::lround(x))];
    const std::string mark = Mark(blip, picture);
    if (cell != "*") cell = mark;
  }
  grid[static_cast<std::size_t>(std::lround(middle_row))]
      [static_cast<std::size_t>(std::lround(middle_column))] = Arrow(picture.heading);
  DrawScale(metres, &grid[rows - 1]);
  std::vector<std::string> lines;
  for (const Row& row : grid) {
    std::string line;
    for (const std::string& character : row) line += character;
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace collision::client
