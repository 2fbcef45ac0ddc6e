// Goal:   no two files need each other, nor two folders outside the core, and the sub-rooms of the
//         core stand in one order.
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

/// The same for folders: one includes another if a unit in it does.
Graph FoldersOf(const Graph& units) {
  const auto folder_of = [](const std::string& unit) { return unit.substr(0, unit.rfind('/')); };
  Graph folders;
  for (const auto& [unit, included] : units) {
    auto& others = folders[folder_of(unit)];
    for (const std::string& other : included) {
      if (folder_of(other) != folder_of(unit)) others.insert(folder_of(other));
    }
  }
  return folders;
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

/// Includes that go from one part of `room` to a later one. A part is a sub-room, or a unit that
/// stands in the room itself. What has no place in the order is named, too.
std::vector<std::string> IncludesOfLater(const Texts& texts, const std::string& room,
                                         const std::vector<std::string>& order) {
  const auto place = [&](const std::string& path) {
    const std::string inside = UnitOf(path).substr(room.size());
    return std::find(order.begin(), order.end(), inside.substr(0, inside.find('/')));
  };
  std::vector<std::string> found;
  for (const auto& [path, text] : texts) {
    if (path.rfind(room, 0) != 0) continue;
    if (place(path) == order.end()) found.push_back(path + " has no place in " + room);
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

TEST(Circles, PlantedCirclesOfFoldersAreFound) {
  const Graph units = GraphOf({{"a/x.h", Line("b/x.h")},
                               {"a/y.h", ""},
                               {"b/x.h", ""},
                               {"b/y.h", Line("a/y.h")},
                               {"c/x.h", Line("a/x.h")}});
  EXPECT_EQ(UnitsInCircles(units), std::set<std::string>{});
  EXPECT_EQ(UnitsInCircles(FoldersOf(units)), (std::set<std::string>{"a", "b"}));
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

// In a folder of the core a façade may stand beside the sub-rooms that it is made of: their order
// is tested below.
TEST(Circles, NoneInServerClientAndIdl) {
  for (const std::string room : {"server/", "client/", "idl/"}) {
    const Graph units = GraphOf(TextsOf(room));
    EXPECT_GE(units.size(), 10u) << room;
    EXPECT_EQ(UnitsInCircles(units), std::set<std::string>{});
    EXPECT_EQ(UnitsInCircles(FoldersOf(units)), std::set<std::string>{});
  }
}

TEST(Circles, NoneAmongTheFilesOfTests) {
  EXPECT_EQ(UnitsInCircles(GraphOf(TextsOf("tests/"))), std::set<std::string>{});
}

TEST(SubRooms, PlantedIncludesOfALaterOneAreFound) {
  const Texts texts = {{"r/low/a.h", Line("r/top.h")},
                       {"r/low/b.h", Line("elsewhere/c.h")},
                       {"r/top.h", Line("r/low/a.h") + Line("r/high/a.h")},
                       {"r/top_implementation.cc", Line("r/low/b.h") + Line("r/top.h")},
                       {"r/high/a.h", Line("r/low/b.h")},
                       {"r/new/a.h", Line("r/low/b.h")}};
  EXPECT_EQ(IncludesOfLater(texts, "r/", {"low", "top", "high"}),
            (std::vector<std::string>{"r/low/a.h includes r/top.h", "r/new/a.h has no place in r/",
                                      "r/top.h includes r/high/a.h"}));
}

struct Order {
  std::string room;
  std::vector<std::string> parts;  ///< Each includes itself and those before it.
};

TEST(SubRooms, DependInOneOrder) {
  const Order orders[] = {
      {"geometry/", {"triangle", "convex", "mesh"}},
      {"sphere_tree/",
       {"tree_options", "underflow", "sphere_tree", "packed_layout", "packed_tree", "surface_query",
        "surface_distance", "winding", "tree_check", "tree_cut", "median_split", "octree",
        "fitted"}},
      // Interfaces of the broad phase come first, and what chooses among its methods last.
      {"broad_phase/",
       {"collision_filter", "agent_bound", "half_space", "agent_bounds", "broad_phase_work",
        "broad_phase_method", "neighbour_index", "earliest_sweep", "sweeping_index", "filter",
        "index", "face_sweep", "adaptive_broad_phase"}},
      {"narrow_phase/",
       {"pose", "convex_pair", "sphere_pairs", "separation", "advancement", "penetration",
        "contact", "approach"}},
      {"detection/",
       {"step", "events", "agents", "encounter", "pairs", "clearance", "earliest", "detector"}},
      {"detection/clearance/",
       {"keys", "search", "clearance_filter", "key_lowering", "clearance_queries", "clearances"}}};
  for (const Order& order : orders) {
    const std::string room = "collision_core/" + order.room;
    EXPECT_EQ(IncludesOfLater(TextsOf(room), room, order.parts), std::vector<std::string>{});
  }
}

}  // namespace
}  // namespace collision::source
