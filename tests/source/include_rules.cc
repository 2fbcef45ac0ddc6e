#include "tests/source/include_rules.h"

#include <algorithm>
#include <regex>
#include <sstream>

namespace collision::source {
namespace {

using Names = std::vector<std::string>;

/// Files under `folder` may include ours only from `ours`. The first folder that fits counts. What
/// users of the client library include lies in client/include/collision and is named collision/.
struct Layer {
  std::string folder;
  Names ours;
};

/// The folders of rooms of the core.
Names CoreRooms(const std::string& rooms) {
  Names folders;
  std::istringstream words(rooms);
  for (std::string room; words >> room;) folders.push_back("collision_core/" + room + "/");
  return folders;
}

/// A file that none of these fits is refused.
const std::vector<Layer>& Layers() {
  static const std::string core = "collision_core/", api = "collision/",
                           library = "client/library/", checker = "client/checker/",
                           programs = "client/programs/";
  static const std::string validation = library + "validation.h", mesh = "client/mesh/mesh_file.h";
  static const std::vector<Layer> layers = {
      // The rooms of the core, each behind those that it may stand on.
      {core + "base/", CoreRooms("base")},
      {core + "numeric/", CoreRooms("base numeric")},
      {core + "simd/", CoreRooms("simd")},
      {core + "geometry/", CoreRooms("base numeric geometry")},
      {core + "sphere_tree/", CoreRooms("base numeric geometry sphere_tree")},
      // A shape does not know that it moves.
      {core + "shape/", CoreRooms("base numeric geometry sphere_tree shape")},
      {core + "motion/", CoreRooms("base numeric motion")},
      {core + "intersection/", CoreRooms("base numeric motion intersection")},
      {core + "broad_phase/", CoreRooms("base numeric simd motion intersection broad_phase")},
      {core + "narrow_phase/",
       CoreRooms("base numeric simd geometry sphere_tree shape motion narrow_phase")},
      {core + "detection/",
       CoreRooms("base numeric shape motion intersection broad_phase narrow_phase detection")},
      // A tree at rest is made of the core's own data; daemon and tools write the same.
      // A program of the build, which needs nothing of ours.
      {"idl/plain/", {"idl/plain/"}},
      {"idl/tree_message", {"idl/", core + "sphere_tree/", core + "shape/"}},
      {"idl/", {"idl/"}},
      // The rooms of the server, each behind those that it stands on; main sees only the program.
      {"server/process/", {"server/process/"}},
      {"server/config/", {"idl/", "server/config/"}},
      {"server/bus/", {"idl/", "server/bus/"}},
      {"server/claim/", {core, "idl/", "server/process/", "server/claim/"}},
      {"server/recording/",
       {core, "idl/", "server/process/", "server/config/", "server/bus/", "server/claim/",
        "server/recording/"}},
      {"server/codec/", {core, "idl/", "server/codec/"}},
      {"server/quotas/", {core, "idl/", "server/config/", "server/quotas/"}},
      {"server/shapes/",
       {core, "idl/", "server/process/", "server/codec/", "server/quotas/", "server/shapes/"}},
      {"server/world/",
       {core, "idl/", "server/process/", "server/bus/", "server/claim/", "server/codec/",
        "server/quotas/", "server/world/"}},
      {"server/detectors/", {core, "idl/", "server/config/", "server/codec/", "server/detectors/"}},
      {"server/intake/",
       {core, "idl/", "server/process/", "server/codec/", "server/quotas/", "server/shapes/",
        "server/world/", "server/detectors/", "server/intake/"}},
      {"server/publish/",
       {core, "idl/", "server/process/", "server/bus/", "server/claim/", "server/codec/",
        "server/quotas/", "server/shapes/", "server/world/", "server/detectors/", "server/intake/",
        "server/publish/"}},
      {"server/service/", {core, "idl/", "server/"}},
      {"server/main.cc", {"server/service/"}},
      // What users of the client library include: nothing of the network.
      {"client/include/collision/", {api}},
      // So that client and service judge motions, meshes, solids and half-spaces alike.
      {library + "validation.cc",
       {"idl/control_character.h", "idl/limits.h", api, validation,
        core + "shape/fixed_half_space.h"}},
      {library + "world/contract.cc",
       {api, library + "vector.h", library + "world/contract.h",
        core + "motion/contract_between.h"}},
      {library + "shape/core_mesh.h", {api, core + "geometry/mesh/triangle_mesh.h"}},
      {library + "shape/shape.cc", {"idl/shape_bytes.h", api, validation, library + "shape/"}},
      {library + "shape/solid_check.cc",
       {api, validation, library + "shape/", core + "shape/convex_solid.h"}},
      // The interface in C, on that in C++.
      {"client/c/", {api, library + "identity/library_version.h", validation, "client/c/"}},
      {"client/mesh/mesh_file.cc",
       {api, validation, "client/mesh/", core + "geometry/mesh/triangle_mesh.h"}},
      {"client/mesh/", {api, validation, "client/mesh/"}},
      {library + "shape/", {"idl/shape_bytes.h", api, library + "shape/"}},
      {library + "identity/", {core + "base/recent_map.h", "idl/", api, library + "identity/"}},
      {library + "network/",
       {core + "base/recent_map.h", "idl/", api, validation, library + "network/"}},
      {library + "notices/", {api, library + "notices/"}},
      {library + "world/",
       {"idl/", api, validation, library + "deadline.h", library + "identity/",
        library + "network/", library + "notices/", library + "world/"}},
      {library, {"idl/credentials/files.h", "idl/limits.h", api, validation}},
      // Written from the IDL alone.
      {"client/examples/fast_dds/",
       {"bus.h", "collisionPubSubTypes.h", "event_line.h", "options.h", "simulator.h"}},
      {"client/examples/", {api}},
      // The checker shares nothing with what it checks but the messages.
      {checker + "shape/", {checker + "shape/"}},
      {checker + "motion/", {checker + "shape/", checker + "motion/"}},
      {checker, {"idl/", checker}},
      // Shows what the service would build, so it builds it.
      {programs + "tools/sphere_tree/",
       {"idl/", api, library + "shape/core_mesh.h", mesh, programs + "shared/", programs + "tools/",
        core + "geometry/mesh/", core + "sphere_tree/", core + "shape/"}},
      // Derives bounds from rows and states as the player does.
      {programs + "tools/suggest_bounds/",
       {"idl/", api, library, programs + "shared/", programs + "tools/",
        programs + "simulators/motion/", programs + "simulators/player/"}},
      // Asks what the service asks, from what a monitor knows.
      {programs + "tools/collisionctl/why/",
       {"idl/", api, library, programs + "shared/", programs + "tools/", core + "broad_phase/",
        core + "intersection/"}},
      {programs + "tools/recordings/",
       {"idl/", api, library, programs + "shared/", programs + "tools/", programs + "scene/",
        programs + "recordings/", programs + "chart/"}},
      {programs + "tools/",
       {"idl/", api, library, mesh, checker, programs + "shared/", programs + "tools/"}},
      // A monitor like anybody's, with the documents that collisionctl prints.
      {programs + "scene/",
       {"idl/", api, library, programs + "shared/", programs + "tools/collisionctl/",
        programs + "scene/"}},
      {programs + "foxglove/",
       {"idl/", api, library, programs + "shared/", programs + "scene/", programs + "foxglove/"}},
      {programs + "gateway/web/",
       {"idl/sha256.h", programs + "scene/payload.h", programs + "shared/web_text.h",
        programs + "gateway/web/"}},
      {programs + "gateway/",
       {"idl/", api, library, programs + "shared/", programs + "tools/collisionctl/",
        programs + "scene/", programs + "foxglove/", programs + "recordings/",
        programs + "gateway/"}},
      {programs + "recordings/",
       {"idl/", api, library, programs + "shared/", programs + "scene/", programs + "foxglove/",
        programs + "recordings/"}},
      // Plots of any numbers; the report of the tests draws with them, too.
      {programs + "chart/", {programs + "chart/"}},
      {programs + "shared/", {"idl/", api, library, mesh, programs + "shared/"}},
      {programs + "simulators/motion/",
       {api, library, programs + "shared/", programs + "simulators/motion/"}},
      {programs + "simulators/",
       {"idl/", api, library, programs + "shared/", programs + "simulators/"}},
      {programs + "scene_runner/",
       {"idl/", api, library, checker, programs + "shared/", programs + "scene_runner/"}},
      {"tests/", {core, "idl/", "server/", api, "client/", "tests/"}},
  };
  return layers;
}

bool StartsWith(const std::string& text, const std::string& start) {
  return text.rfind(start, 0) == 0;
}

bool StartsWithAny(const std::string& text, const Names& starts) {
  return std::any_of(starts.begin(), starts.end(),
                     [&](const auto& start) { return StartsWith(text, start); });
}

/// A header of the C++ standard library has no folder and no ending.
bool IsStandard(const std::string& name) { return name.find_first_of("/.") == std::string::npos; }

/// What the core may have of the standard library: no files, threads, clocks or output.
bool IsForCore(const std::string& name) {
  static const Names refused = {"atomic", "chrono",       "condition_variable",
                                "ctime",  "filesystem",   "fstream",
                                "future", "iostream",     "mutex",
                                "random", "shared_mutex", "thread"};
  return StartsWith(name, "Eigen/") ||
         (IsStandard(name) && std::find(refused.begin(), refused.end(), name) == refused.end());
}

/// Cyclone DDS itself, and what idlc makes of collision.idl.
bool IsDds(const std::string& name) {
  return StartsWith(name, "dds/") || StartsWith(name, "ddsc/") || name == "collision.h" ||
         name == "idl/collision.h";
}

/// Code for one kind of processor: sources, and the kernels and lanes that they include.
bool IsWide(const std::string& path) {
  static const std::regex wide(
      R"(collision_core/(simd/lanes_\w+\.h|.*_avx(2|512)\.cc|.*_wide\.h))");
  return std::regex_match(path, wide);
}

/// What such code may include: its own kind, and interfaces that define no function.
bool IsForWide(const std::string& name) {
  static const Names interfaces = {"collision_core/broad_phase/filter/point_filter.h",
                                   "collision_core/broad_phase/filter/sphere_filter.h",
                                   "collision_core/narrow_phase/convex_pair/box_separating_axis.h",
                                   "collision_core/narrow_phase/convex_pair/gjk_small.h",
                                   "collision_core/narrow_phase/sphere_pairs/sphere_pair_kernel.h",
                                   "collision_core/numeric/allowances.h",
                                   "collision_core/sphere_tree/packed_layout.h"};
  static const Names standard = {"cmath", "cstdint", "immintrin.h"};
  return IsWide(name) ||
         std::find(interfaces.begin(), interfaces.end(), name) != interfaces.end() ||
         std::find(standard.begin(), standard.end(), name) != standard.end();
}

bool IsPublicClientHeader(const std::string& path) {
  return StartsWith(path, "client/include/collision/");
}

/// Null: the file belongs to no layer.
const Layer* LayerOf(const std::string& path) {
  for (const Layer& layer : Layers()) {
    if (StartsWith(path, layer.folder)) return &layer;
  }
  return nullptr;
}

std::string FolderOf(const std::string& path) { return path.substr(0, path.rfind('/') + 1); }

std::string Complaint(const std::string& path, const Include& include) {
  const Layer* layer = LayerOf(path);
  if (layer == nullptr) {
    return "the rules (tests/source/include_rules.cc) have no entry for " + FolderOf(path);
  }
  if (IsDds(include.name)) {
    return StartsWithAny(path, {"idl/dds/", "tests/idl/", "tests/fuzz/wire_fuzz"})
               ? ""
               : "only idl/dds knows DDS";
  }
  // Built for processors that not every machine has: code that others share must not be compiled
  // there.
  if (IsWide(path)) {
    return IsForWide(include.name) ? "" : "wide vectors know nothing but their processor";
  }
  if (!include.quoted) {
    if (StartsWith(path, "collision_core/") && !IsForCore(include.name)) {
      return "the core has nothing but Eigen and the standard library, without files, threads and "
             "clocks";
    }
    // Of C, too.
    const bool is_of_c = include.name == "stddef.h" || include.name == "stdint.h";
    if (IsPublicClientHeader(path) && !IsStandard(include.name) && !is_of_c) {
      return "users of the client see nothing but the standard library";
    }
    return "";
  }
  return StartsWithAny(include.name, layer->ours) ? "" : "not from " + layer->folder;
}

}  // namespace

std::vector<Include> Includes(const std::string& text) {
  static const std::regex pattern(R"(^\s*#\s*include\s*([<"])([^">]+)[">])");
  std::vector<Include> includes;
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::smatch match;
    if (std::regex_search(line, match, pattern)) {
      includes.push_back({number, match[2], match[1] == "\""});
    }
  }
  return includes;
}

std::vector<std::string> Violations(const std::string& path, const std::string& text) {
  std::vector<std::string> violations;
  for (const Include& include : Includes(text)) {
    const std::string complaint = Complaint(path, include);
    if (complaint.empty()) continue;
    violations.push_back(path + ":" + std::to_string(include.line) + ": includes " + include.name +
                         ": " + complaint);
  }
  return violations;
}

}  // namespace collision::source
