#include "tests/bench/hubbard/parts.h"

#include "tests/support/obj.h"

namespace collision::bench {
namespace {

const std::vector<std::string> kFigures = {"narrow_bsp_over_ours_20",
                                           "narrow_bsp_over_ours_100",
                                           "both_turk_bsp_over_ours_20",
                                           "both_turk_bsp_over_ours_100",
                                           "both_turk_bsp_over_ours_worst",
                                           "both_turk_bsp_over_ours_best",
                                           "both_turk_trees_over_ours_worst",
                                           "both_turk_trees_over_ours_best",
                                           "slowest_frame_turk_bsp_over_ours_worst",
                                           "slowest_frame_turk_bsp_over_ours_best",
                                           "slowest_frame_turk_trees_over_ours_worst",
                                           "slowest_frame_turk_trees_over_ours_best",
                                           "frames_that_differ",
                                           "service_missed"};

constexpr std::size_t kPartWidth = 8, kSceneWidth = 22, kMethodWidth = 30, kTimeWidth = 12,
                      kHashWidth = 18;

/// Cubic metres of the box for each ship: the demo's.
constexpr double kVolume = 2000;

std::optional<ShipKind> ReadKind(const std::string& path, double acceleration_max,
                                 double speed_max) {
  const geometry::PolygonMesh polygons = ReadObj(path);
  if (polygons.sizes.empty()) return std::nullopt;
  geometry::MeshRepair repair;
  ShipKind kind;
  kind.mesh = Triangulate(polygons, &repair);
  kind.shape = shape::Shape::Build(kind.mesh, {.builder = sphere_tree::TreeBuilder::kFitted});
  kind.radius = kind.shape->facts().radius;
  kind.acceleration_max = acceleration_max, kind.speed_max = speed_max;
  return kind;
}

struct Scene {
  std::uint32_t drones;
  double volume;
};

std::vector<Scene> ScenesOf(const HubbardSettings& settings) {
  if (settings.quick) return {{20, kVolume}, {100, kVolume}, {100, kVolume / 8}};
  std::vector<Scene> scenes;
  for (const std::uint32_t drones : {20u, 50u, 100u, 200u}) {
    for (const double volume : {kVolume / 8, kVolume / 4, kVolume, kVolume * 4})
      scenes.push_back({drones, volume});
  }
  return scenes;
}

}  // namespace

HubbardReport::HubbardReport()
    : RowReport(kFigures,
                Padded("part", kPartWidth) + Padded("scene", kSceneWidth) +
                    Padded("method", kMethodWidth) + Padded("time", kTimeWidth) + "result hash",
                "figures (theirs over ours: larger is better; the paper: 5 to 7 for both phases)") {
}

std::string HubbardRow::Line() const {
  return Padded(part, kPartWidth) + Padded(scene, kSceneWidth) + Padded(method, kMethodWidth) +
         Padded(SecondsText(seconds), kTimeWidth) + Padded(hash, kHashWidth) + remark;
}

std::string HubbardRow::Json() const {
  std::vector<Field> fields = {Text("part", part), Text("scene", scene), Text("method", method),
                               Number("seconds", seconds), Text("hash", hash)};
  if (!remark.empty()) fields.push_back(Text("remark", remark));
  fields.insert(fields.end(), more.begin(), more.end());
  return Object(fields);
}

HubbardRow RowOf(const std::string& part, const HubbardScene& scene, const std::string& method) {
  HubbardRow row;
  row.part = part, row.scene = scene.name, row.method = method;
  row.more = {Number("drones", scene.options.drones), Number("volume_m3", scene.options.volume),
              Number("seed", static_cast<double>(scene.options.seed)),
              Number("bounces", static_cast<double>(scene.flight.bounces())),
              Number("undecided_in_flight", static_cast<double>(scene.flight.undecided()))};
  return row;
}

bool MeasureHubbard(const HubbardSettings& settings, HubbardReport* report) {
  const auto spaceship = ReadKind(settings.scenes_dir + "/spaceship.obj", 6, 10);
  const auto drone = ReadKind(settings.scenes_dir + "/drone-ship.obj", 5, 6);
  if (!spaceship || !drone) return false;
  for (const Scene& of : ScenesOf(settings)) {
    const FlightOptions options{of.drones, of.volume, settings.frames(), 1995};
    const Flight flight(*spaceship, *drone, options);
    const HubbardScene scene{std::to_string(of.drones) + " drones, " + Format("%g m3", of.volume),
                             *spaceship, *drone, flight, options};
    NarrowRows(settings, scene, report);
    BothRows(settings, scene, report);
    ServiceRows(settings, scene, report);
  }
  return true;
}

}  // namespace collision::bench
