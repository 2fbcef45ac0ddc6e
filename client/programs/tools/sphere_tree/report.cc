#include "client/programs/tools/sphere_tree/report.h"

#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <thread>
#include <utility>

#include "client/library/shape/core_mesh.h"
#include "client/programs/tools/collisionctl/pages/text_pages.h"
#include "collision/shape.h"
#include "collision_core/sphere_tree/tree_cut.h"

namespace collision::client {
namespace {

constexpr std::uint32_t kCuts[] = {8, 64, 512};

/// Prints a line of progress every second on a terminal; silent otherwise.
class Progress {
 public:
  explicit Progress(std::string what) : what_(std::move(what)) {
    if (isatty(STDERR_FILENO) == 1) thread_ = std::thread([this] { Print(); });
  }
  ~Progress() {
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
  }

 private:
  void Print() {
    std::unique_lock lock(mutex_);
    int seconds = 0;
    while (!changed_.wait_for(lock, std::chrono::seconds(1), [this] { return ended_; })) {
      std::fprintf(stderr, "\r%s: %d s ", what_.c_str(), ++seconds);
      std::fflush(stderr);
    }
    if (seconds > 0) std::fprintf(stderr, "\r%*s\r", static_cast<int>(what_.size() + 12), "");
  }

  const std::string what_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool ended_ = false;
  std::thread thread_;
};

void SetCut(const MeshTree& mesh_tree, const std::vector<NodeIndex>& cut,
            v1::TreeCutReport* report) {
  const sphere_tree::Overshoot overshoot = OvershootOf(mesh_tree.tree(), cut);
  const double percent = 100 / mesh_tree.diagonal();
  report->set_balls(static_cast<std::uint32_t>(cut.size()));
  report->set_overshoot_max_m(overshoot.max);
  report->set_overshoot_mean_m(overshoot.mean);
  report->set_overshoot_max_percent(overshoot.max * percent);
  report->set_overshoot_mean_percent(overshoot.mean * percent);
}

std::vector<std::string> Row(std::string first, const v1::TreeCutReport& cut) {
  return {std::move(first),
          std::to_string(cut.balls()),
          NumberText(cut.overshoot_max_m(), "%.4g"),
          NumberText(cut.overshoot_max_percent(), "%.3g"),
          NumberText(cut.overshoot_mean_m(), "%.4g"),
          NumberText(cut.overshoot_mean_percent(), "%.3g")};
}

std::string TableOf(const std::string& heading,
                    const google::protobuf::RepeatedPtrField<v1::TreeCutReport>& cuts) {
  std::vector<std::vector<std::string>> rows = {
      {heading, "BALLS", "MAX [m]", "MAX [%]", "MEAN [m]", "MEAN [%]"}};
  for (const v1::TreeCutReport& cut : cuts) {
    rows.push_back(Row(std::to_string(std::max(cut.level(), cut.balls_at_most())), cut));
  }
  return Table(rows);
}

constexpr const char* kClosedText =
    "closed: a solid. Balls whose centres lie inside certify contact, and how deep it is\n";
constexpr const char* kOpenText =
    "open: a surface without inside. Balls certify only that agents are apart; contact is "
    "certified by crossing triangles\n";

}  // namespace

MeshTree BuildMeshTree(const std::string& file, const MeshFileOptions& frame,
                       const sphere_tree::ShapeOptions& options) {
  MeshTree result;
  result.file = file;
  result.options = options;
  const auto read = LoadShape(file, frame, &result.read);
  result.content_hash = HexText(read->hash());
  const Progress progress("building the " + std::string(BuilderName(options.builder)) +
                          " tree of " + std::to_string(result.read.triangles) + " triangles");
  geometry::TriangleMesh mesh = ToCore(read->triangles());
  const auto start = std::chrono::steady_clock::now();
  result.shape = collision::shape::Shape::Build(std::move(mesh), options);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  result.build_seconds = taken.count();
  return result;
}

const char* BuilderName(sphere_tree::TreeBuilder builder) {
  return builder == sphere_tree::TreeBuilder::kFitted ? "fitted" : "octree";
}

v1::TreeReport ReportOf(const MeshTree& mesh_tree) {
  const sphere_tree::SphereTree& tree = mesh_tree.tree();
  v1::TreeReport report;
  report.set_file(mesh_tree.file);
  report.set_triangles(static_cast<std::uint32_t>(mesh_tree.shape->mesh().triangles.size()));
  report.set_closed(mesh_tree.shape->closed());
  report.set_diagonal_m(mesh_tree.diagonal());
  report.set_content_hash(mesh_tree.content_hash);
  report.set_builder(BuilderName(mesh_tree.options.builder));
  report.set_build_seconds(mesh_tree.build_seconds);
  report.set_balls(static_cast<std::uint32_t>(tree.nodes.size()));
  report.set_bytes(static_cast<double>(tree.bytes() + mesh_tree.shape->packed().bytes()));
  for (std::uint32_t level = 0; level < tree.levels; ++level) {
    v1::TreeCutReport* cut = report.add_levels();
    cut->set_level(level);
    SetCut(mesh_tree, tree.Cut(level), cut);
  }
  for (const std::uint32_t count : kCuts) {
    v1::TreeCutReport* cut = report.add_cuts();
    cut->set_balls_at_most(count);
    SetCut(mesh_tree, CutOfCount(tree, count), cut);
  }
  return report;
}

std::string ReportText(const MeshTree& mesh_tree, const v1::TreeReport& report) {
  std::string text = mesh_tree.read.Text(report.file()) + "\n";
  text += report.closed() ? kClosedText : kOpenText;
  text += report.builder() + ": " + std::to_string(report.balls()) + " balls in " +
          std::to_string(report.levels_size()) + " levels, " +
          NumberText(report.bytes() / 1e6, "%.3g MB") + ", built in " +
          NumberText(report.build_seconds(), "%.3g s") +
          NumberText(1e6 * report.build_seconds() / report.triangles(), " (%.3g us a triangle)\n");
  text += "overshoot: how far a ball may reach beyond the surface, certified; % of the diagonal, " +
          NumberText(report.diagonal_m(), "%.6g m\n\n");
  text += TableOf("LEVEL", report.levels());
  return text + "\n" + TableOf("AT MOST", report.cuts());
}

std::uint32_t LevelWithin(const sphere_tree::SphereTree& tree, std::size_t balls_max) {
  std::uint32_t level = 0;
  while (level + 1 < tree.levels && tree.Cut(level + 1).size() <= balls_max) ++level;
  return level;
}

}  // namespace collision::client
