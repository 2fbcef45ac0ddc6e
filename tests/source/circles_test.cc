// Goal:   within a room of the core no two files need each other, and the sub-rooms of the narrow
//         phase stand in one order.
// Method: a unit is x.h with x.cc, its inline functions, its hidden implementation and its sources
//         for wide vectors; the includes of all units make a graph, which is searched for circles.
//         The search is first tried on planted graphs.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>

#include "tests/source/include_rules.h"
#include "tests/source/source_tree.h"

namespace collision::source {
namespace {

/// For each unit the units that it includes.
using Graph = std::map<std::string, std::set<std::string>>;

/// Code that each source for wide vectors includes for its own processor: no unit of its own.
bool IsWideCode(const std::string& path) { return path.ends_with("_wide.h"); }

/// x.h, x.cc, x_inline.h, x_implementation.{h,cc}, x_avx2.cc and x_avx512.cc are one unit.
std::string UnitOf(const std::string& path) {
  static const std::regex ending("(_avx2|_avx512|_inline|_implementation)?\\.(h|cc)$");
  return std::regex_replace(path, ending, "");
}

using Texts = std::map<std::string, std::string>;

void AddIncludes(const Texts& texts, const std::string& path, const std::string& unit,
                 std::set<std::string>* included) {
  for (const Include& include : Includes(texts.at(path))) {
    if (!include.quoted || texts.count(include.name) == 0) continue;
    if (IsWideCode(include.name)) {
      AddIncludes(texts, include.name, unit, included);
    } else if (UnitOf(include.name) != unit) {
      included->insert(UnitOf(include.name));
    }
  }
}

Graph GraphOf(const Texts& texts) {
  Graph graph;
  for (const auto& [path, text] : texts) {
    if (!IsWideCode(path)) AddIncludes(texts, path, UnitOf(path), &graph[UnitOf(path)]);
  }
  return graph;
}

/// The units that depend on themselves: units without a dependency that is left are taken away
/// until none is, then those on which nothing that is left depends.
std::set<std::string> UnitsInCircles(const Graph& graph) {
  std::set<std::string> left;
  for (const auto& [unit, included] : graph) left.insert(unit);
  const auto depends_on_some = [&](const std::string& unit) {
    const auto& included = graph.at(unit);
    return std::any_of(included.begin(), included.end(),
                       [&](const auto& other) { return left.count(other) > 0; });
  };
  const auto is_needed_by_some = [&](const std::string& unit) {
    return std::any_of(left.begin(), left.end(),
                       [&](const auto& other) { return graph.at(other).count(unit) > 0; });
  };
  const auto take_away = [&](const auto& may_stay) {
    for (bool changed = true; changed;) {
      changed = false;
      for (auto unit = left.begin(); unit != left.end();) {
        const bool stays = may_stay(*unit);
        changed = changed || !stays;
        unit = stays ? std::next(unit) : left.erase(unit);
      }
    }
  };
  take_away(depends_on_some);
  take_away(is_needed_by_some);
  return left;
}

Texts TextsOf(const std::string& room) {
  Texts texts;
  for (const SourceFile& file : SourceFiles({".h", ".cc"})) {
    if (file.path.rfind(room, 0) == 0) texts[file.path] = file.text;
  }
  return texts;
}

/// Includes that go from one sub-room of `room` to a later one.
std::vector<std::string> IncludesOfLater(const std::string& room,
                                         const std::vector<std::string>& order) {
  const auto place = [&](const std::string& path) {
    const auto name = path.substr(room.size(), path.find('/', room.size()) - room.size());
    return std::find(order.begin(), order.end(), name) - order.begin();
  };
  std::vector<std::string> found;
  for (const auto& [path, text] : TextsOf(room)) {
    if (path.substr(room.size()).find('/') == std::string::npos) continue;
    for (const Include& include : Includes(text)) {
      if (include.name.rfind(room, 0) != 0 || place(include.name) <= place(path)) continue;
      found.push_back(path + " includes " + include.name);
    }
  }
  return found;
}

std::string Line(const std::string& path) { return "#include \"" + path + "\"\n"; }

TEST(Circles, PlantedCirclesAreFoundWithoutWhatLeadsToThem) {
  const Texts texts = {{"r/a.h", ""},
                       {"r/a.cc", Line("r/a.h") + Line("r/b.h")},
                       {"r/b.h", Line("r/c.h") + Line("r/below.h")},
                       {"r/c.h", Line("r/a.h")},
                       {"r/below.h", ""},
                       {"r/above.cc", Line("r/a.h")}};
  EXPECT_EQ(UnitsInCircles(GraphOf(texts)), (std::set<std::string>{"r/a", "r/b", "r/c"}));
}

TEST(Circles, AUnitAndItsWideCodeAreNoCircle) {
  const Texts texts = {{"r/a.h", ""},
                       {"r/a.cc", Line("r/part_wide.h")},
                       {"r/a_avx2.cc", Line("r/a.h") + Line("r/part_wide.h")},
                       {"r/part_wide.h", Line("r/a.h")}};
  EXPECT_EQ(UnitsInCircles(GraphOf(texts)), std::set<std::string>{});
}

TEST(Circles, AUnitAndItsImplementationAreNoCircle) {
  const Texts texts = {{"r/a.h", Line("r/a_inline.h")},
                       {"r/a.cc", Line("r/a_implementation.h")},
                       {"r/a_inline.h", Line("r/a.h")},
                       {"r/a_implementation.h", Line("r/a.h")}};
  EXPECT_EQ(UnitsInCircles(GraphOf(texts)), std::set<std::string>{});
}

/// "collision_core/motion/" and the like, from the files that there are.
std::set<std::string> RoomsOfTheCore() {
  const std::string core = "collision_core/";
  std::set<std::string> rooms;
  for (const SourceFile& file : SourceFiles({".h", ".cc"})) {
    if (file.path.rfind(core, 0) != 0) continue;
    const std::size_t end = file.path.find('/', core.size());
    if (end != std::string::npos) rooms.insert(file.path.substr(0, end + 1));
  }
  return rooms;
}

TEST(Circles, NoneInTheRoomsOfTheCore) {
  const std::set<std::string> rooms = RoomsOfTheCore();
  EXPECT_GE(rooms.size(), 11u);
  for (const std::string& room : rooms) {
    EXPECT_EQ(UnitsInCircles(GraphOf(TextsOf(room))), std::set<std::string>{}) << room;
  }
}

TEST(SubRooms, OfTheNarrowPhaseDependInOneOrder) {
  const std::vector<std::string> order = {
      "pose", "convex_pair", "sphere_pairs", "separation", "advancement", "penetration", "contact"};
  EXPECT_EQ(IncludesOfLater("collision_core/narrow_phase/", order), std::vector<std::string>{});
}

}  // namespace
}  // namespace collision::source
