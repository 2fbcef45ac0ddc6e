#include "tests/bench/hubbard_parts.h"

#include <cstdio>

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

std::string RowText(const HubbardRow& row) {
  return Padded(row.part, kPartWidth) + Padded(row.scene, kSceneWidth) +
         Padded(row.method, kMethodWidth) + Padded(SecondsText(row.seconds), kTimeWidth) +
         Padded(row.hash, kHashWidth) + row.remark;
}

std::string RowJson(const HubbardRow& row) {
  std::vector<Field> fields = {Text("part", row.part), Text("scene", row.scene),
                               Text("method", row.method), Number("seconds", row.seconds),
                               Text("hash", row.hash)};
  if (!row.remark.empty()) fields.push_back(Text("remark", row.remark));
  fields.insert(fields.end(), row.more.begin(), row.more.end());
  return Object(fields);
}

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

HubbardReport::HubbardReport() : figures_(kFigures) {}

void HubbardReport::Add(HubbardRow row) {
  std::fprintf(stderr, "bench: %s\n", RowText(row).c_str());
  rows_.push_back(std::move(row));
}

void HubbardReport::FigureLeast(const std::string& name, double value) {
  figures_.Set(name, std::min(figures_.Get(name).value_or(value), value));
}

void HubbardReport::FigureGreatest(const std::string& name, double value) {
  figures_.Set(name, std::max(figures_.Get(name).value_or(value), value));
}

void HubbardReport::FigureSum(const std::string& name, double value) {
  figures_.Set(name, figures_.Get(name).value_or(0) + value);
}

std::string HubbardReport::Table() const {
  std::string text = Padded("part", kPartWidth) + Padded("scene", kSceneWidth) +
                     Padded("method", kMethodWidth) + Padded("time", kTimeWidth) + "result hash\n";
  for (const HubbardRow& row : rows_) text += RowText(row) + "\n";
  return text +
         "\nfigures (theirs over ours: larger is better; the paper: 5 to 7 for both phases)\n" +
         figures_.Table();
}

std::string HubbardReport::Json() const {
  std::vector<std::string> measurements;
  for (const HubbardRow& row : rows_) measurements.push_back(RowJson(row));
  return figures_.Json(measurements);
}

bool Wanted(const HubbardSettings& settings, const HubbardRow& row) {
  return row.path().find(settings.only) != std::string::npos;
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
