#include "tests/report/contestants.h"

#include <cctype>
#include <set>
#include <utility>

namespace collision::report {

using chart::Chart;
using chart::Colour;
using chart::GiveLooks;
using chart::HashOfName;
using chart::kDashes;
using chart::Look;
using chart::Mark;
using chart::Series;
namespace {

struct Contestant {
  const char* name;
  Colour colour;
  Mark mark;
};

/// A mark belongs to one line, so that a print without colours can be read.
constexpr Contestant kContestants[] = {
    {"ours", Colour::kBlue, Mark::kCircle},
    {"FCL", Colour::kVermilion, Mark::kSquare},
    {"Bullet", Colour::kGreen, Mark::kTriangle},
    {"Embree", Colour::kPurple, Mark::kDiamond},
    {"CGAL", Colour::kOrange, Mark::kTriangleDown},
    {"ODE", Colour::kSky, Mark::kPentagon},
    {"Turk", Colour::kGrey, Mark::kOpenPentagon},
    {"BSP trees", Colour::kBlack, Mark::kOpenDiamond},
    {"no-op program", Colour::kBlack, Mark::kOpenSquare},
    {"stepping", Colour::kGrey, Mark::kStar},
    {"coal", Colour::kOrange, Mark::kOpenTriangleDown},
    {"libccd", Colour::kSky, Mark::kOpenTriangle},
    {"Open-RMF", Colour::kPurple, Mark::kOpenCircle},
};

/// No contestants, but curves that share a chart.
constexpr Contestant kOthers[] = {
    {"cubes 0.01 %", Colour::kSky, Mark::kOpenCircle},
    {"cubes 0.1 %", Colour::kGreen, Mark::kOpenTriangle},
    {"cubes 1 %", Colour::kOrange, Mark::kOpenDiamond},
    {"cubes 10 %", Colour::kVermilion, Mark::kOpenSquare},
    {"killed", Colour::kBlue, Mark::kOpenCircle},
    {"stopped", Colour::kVermilion, Mark::kOpenTriangle},
    {"unplugged", Colour::kGreen, Mark::kOpenDiamond},
    {"promised: the lease + 50 ms", Colour::kBlack, Mark::kPlus},
};

/// The dash of a variant, by the end of its series' name; the first that fits counts.
constexpr std::pair<const char*, int> kVariants[] = {
    {"fitted tree, by width", 0},
    {"fitted tree, by budget", 1},
    {"octree, by width", 2},
    {"octree, by budget", 3},
    {"refinement, level by level", 4},
    {"refinement, largest first", 5},
    {"exact triangles", 6},
    {"libccd yes or no", 2},
    {"own solver yes or no", 3},
    {"yes or no at a glance", 7},
    {"yes or no", 7},
    {"convex routine, by width", 0},
    {"full search, by budget", 1},
    {"as solids", 1},
    {"all-pairs", 1},
    {"face-sweep", 2},
    {"spatial-index", 3},
    {"horns and sphere trees", 0},
    {"horns and BSP trees", 1},
    {"and sphere trees", 1},
    {"and BSP trees", 0},
    {"a pair's turn", 0},
    {"a step of all pairs", 1},
    {"windows", 1},
    {"asked lazily", 1},
    {"OBBRSS distance", 1},
    {"RSS distance", 0},
    {"libccd distance", 0},
    {"own solver distance", 1},
    {"FCL libccd", 0},
    {"own solver", 1},
    {"naive", 1},
    {"polynomial", 2},
    {"ray shooting", 3},
    {"advancement, libccd", 4},
    {"advancement, own", 5},
    {"advancement, meshes", 6},
    {"advancement", 0},
    {"by default", 7},
    {"Bullet convex", 0},
    {"Bullet continuous", 0},
    {"sub-simplex cast", 2},
    {"GJK cast", 1},
    {"Turk's hash", 0},
    {"stepping at 60 Hz", 0},
};

/// "FCL" begins "FCL, windows", but not "FCLX".
bool Begins(const std::string& series, const std::string& name) {
  if (!series.starts_with(name)) return false;
  return series.size() == name.size() ||
         std::isalnum(static_cast<unsigned char>(series[name.size()])) == 0;
}

const Contestant* Find(const std::string& series) {
  for (const Contestant& contestant : kContestants) {
    if (Begins(series, contestant.name)) return &contestant;
  }
  for (const Contestant& other : kOthers) {
    if (series == other.name) return &other;
  }
  return nullptr;
}

/// An unknown variant has a dash by its letters.
int DashOf(const std::string& series, const std::string& contestant) {
  if (series == contestant) return 0;
  for (const auto& [end, dash] : kVariants) {
    if (series.ends_with(end)) return dash;
  }
  return static_cast<int>(HashOfName(series) % kDashes);
}

}  // namespace

std::string ContestantOf(const std::string& series) {
  const Contestant* found = Find(series);
  return found == nullptr ? series : found->name;
}

std::string WithoutGrowth(const std::string& series) {
  return series.substr(0, series.find(" (N^"));
}

void DrawByContestant(Chart* chart) {
  std::set<std::pair<std::string, int>> taken;
  for (Series& series : chart->series) {
    const Contestant* found = Find(series.name);
    if (found == nullptr || series.look) continue;
    int dash = DashOf(series.name, found->name);
    // More variants than dashes: the rest share.
    for (int i = 1; i < kDashes && taken.contains({found->name, dash}); ++i) {
      dash = (dash + 1) % kDashes;
    }
    taken.insert({found->name, dash});
    series.look = Look{found->colour, found->mark, dash};
  }
  GiveLooks(chart);
}

}  // namespace collision::report
