// Goal:   the radar shows positions: x to the right, y up, to scale, at any size.
#include "client/programs/simulators/spaceship/radar.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "client/programs/shared/terminal.h"

namespace collision::client {
namespace {

// Characters, not bytes.
std::size_t Columns(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char byte) {
    return (static_cast<unsigned char>(byte) & 0xc0) != 0x80;
  }));
}

std::string At(const std::vector<std::string>& lines, std::size_t row, std::size_t column) {
  const std::string before = Cut(lines.at(row), column);
  return Cut(lines.at(row).substr(before.size()), 1);
}

RadarPicture Around(std::vector<RadarBlip> others) {
  RadarPicture picture;
  picture.own_m = {100, -50, 20};
  picture.others = std::move(others);
  picture.range_m = 20;
  return picture;
}

// 41 columns and 21 rows of picture: 20 columns or 10 rows are 20 m, the ship in the middle.
TEST(Radar, ShowsWhereOthersAre) {
  const RadarPicture picture = Around({{{110, -50, 20}},        // 10 m in +x
                                       {{100, -40, 23}},        // 10 m in +y, above
                                       {{90, -50, 10}},         // 10 m in −x, below
                                       {{100, -60, 20}, true},  // touching
                                       {{200, -50, 20}}});      // out of range
  const auto lines = DrawRadar(picture, 41, 22);
  ASSERT_EQ(lines.size(), 22u);
  EXPECT_EQ(At(lines, 10, 20), "→");
  EXPECT_EQ(At(lines, 10, 30), "o");
  EXPECT_EQ(At(lines, 5, 20), "^");
  EXPECT_EQ(At(lines, 10, 10), "v");
  EXPECT_EQ(At(lines, 15, 20), "*");
  std::size_t marks = 0;
  for (const std::string& line : lines) {
    EXPECT_EQ(Columns(line), 41u);
    for (const char mark : {'o', '^', 'v', '*'}) {
      marks += static_cast<std::size_t>(std::count(line.begin(), line.end(), mark));
    }
  }
  EXPECT_EQ(marks, 4u);
}

TEST(Radar, TheArrowIsTheHeading) {
  const std::vector<std::pair<Vector3, std::string>> headings = {
      {{1, 0, 0}, "→"},  {{0.7, 0.7, 0}, "↗"},   {{0, 1, 0}, "↑"},  {{-0.7, 0.7, 0}, "↖"},
      {{-1, 0, 0}, "←"}, {{-0.7, -0.7, 0}, "↙"}, {{0, -1, 0}, "↓"}, {{0.7, -0.7, 0}, "↘"},
      {{0, 0, 1}, "⊙"},  {{0, 0, -1}, "⊗"}};
  for (const auto& [heading, arrow] : headings) {
    RadarPicture picture = Around({});
    picture.heading = heading;
    EXPECT_EQ(At(DrawRadar(picture, 41, 22), 10, 20), arrow);
  }
}

TEST(Radar, AContactIsNotHiddenByAnAgentAbove) {
  const RadarBlip touching{{110, -50, 20}, true}, other{{110, -50, 25}};
  EXPECT_EQ(At(DrawRadar(Around({touching, other}), 41, 22), 10, 30), "*");
  EXPECT_EQ(At(DrawRadar(Around({other, touching}), 41, 22), 10, 30), "*");
}

// A length of 10 m on the scale is as long as 10 m in the picture.
TEST(Radar, TheScaleIsTrue) {
  const std::string scale = DrawRadar(Around({}), 41, 22).back();
  EXPECT_NE(scale.find("├─────────┤ 10 m"), std::string::npos) << scale;
}

TEST(Radar, RangeShowsMostOfTheOthers) {
  EXPECT_EQ(RadarRange(Around({}), 0), 20);
  RadarPicture picture = Around({});
  for (int i = 0; i < 10; ++i) picture.others.push_back({{100.0 + 8 * i, -50, 20}});
  EXPECT_EQ(RadarRange(picture, 0), 100);  // 64 m and nearer, one at 72 m
  picture.others.push_back({{1e9, 0, 0}});
  EXPECT_EQ(RadarRange(picture, 0), 100) << "one straggler";
  EXPECT_EQ(RadarRange(picture, 1), 200);
  EXPECT_EQ(RadarRange(picture, -1), 50);
  EXPECT_EQ(RadarRange(picture, -99), 10);
  EXPECT_GE(RadarRange(Around({{{1e300, 0, 0}}}), 99), 1e7);
}

TEST(Radar, FitsAnySize) {
  const RadarPicture picture = Around({{{119, -31, 20}}, {{80, -70, 20}}, {{-1e300, 1e300, 0}}});
  for (std::size_t columns = 0; columns <= 60; ++columns) {
    for (std::size_t rows = 0; rows <= 30; ++rows) {
      const auto lines = DrawRadar(picture, columns, rows);
      if (columns < 12 || rows < 4) {
        EXPECT_TRUE(lines.empty());
        continue;
      }
      ASSERT_EQ(lines.size(), rows);
      for (const std::string& line : lines) ASSERT_EQ(Columns(line), columns);
    }
  }
}

}  // namespace
}  // namespace collision::client
