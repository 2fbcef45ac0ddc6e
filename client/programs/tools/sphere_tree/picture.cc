#include "client/programs/tools/sphere_tree/picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "client/programs/tools/sphere_tree/raster.h"
#include "collision_core/sphere_tree/tree_cut.h"

namespace collision::client {
namespace {

using Eigen::Vector3d;

constexpr int kCells = 640;       ///< Along the longer side.
constexpr int kUnitsPerCell = 2;  ///< Of the picture.
constexpr int kMargin = 28;       ///< [units]
constexpr int kHead = 76;         ///< For the title, above.
constexpr int kFoot = 56;         ///< For scale and legend, below.
constexpr int kWidthMin = 560;    ///< So that the title has room.

std::string Text(const char* format, auto... values) {
  char text[512];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

std::string Escaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    escaped += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
  }
  return escaped;
}

/// Rows: right, down, towards. Right-handed with up in place of down, so nothing is mirrored.
Eigen::Matrix3d AxesAlongTheShortest(const Vector3d& extent) {
  Eigen::Matrix3d axes;
  int shortest = 0;
  extent.minCoeff(&shortest);
  if (shortest == 2) {
    axes << 1, 0, 0, 0, -1, 0, 0, 0, 1;
  } else if (shortest == 1) {
    axes << 1, 0, 0, 0, 0, -1, 0, -1, 0;
  } else {
    axes << 0, 1, 0, 0, 0, -1, 1, 0, 0;
  }
  return axes;
}

/// Room for the mesh and for the balls.
View ViewOf(const MeshTree& mesh_tree, const std::vector<NodeIndex>& cut) {
  const geometry::MeshFacts& facts = mesh_tree.shape->facts();
  Vector3d lower = facts.lower, upper = facts.upper;
  for (const NodeIndex index : cut) {
    const sphere_tree::SphereNode& node = mesh_tree.tree().node(index);
    lower = lower.cwiseMin(node.centre - Vector3d::Constant(node.radius));
    upper = upper.cwiseMax(node.centre + Vector3d::Constant(node.radius));
  }
  View view;
  view.axes = AxesAlongTheShortest(facts.upper - facts.lower);
  const Vector3d a = view.axes * lower, b = view.axes * upper;
  view.corner = a.cwiseMin(b).head<2>();
  const Eigen::Vector2d size = (a - b).cwiseAbs().head<2>();
  view.cells_per_metre = kCells / size.maxCoeff();
  view.columns = std::max(1, static_cast<int>(std::ceil(size.x() * view.cells_per_metre)));
  view.rows = std::max(1, static_cast<int>(std::ceil(size.y() * view.cells_per_metre)));
  return view;
}

/// One path per tone, of runs of cells.
std::string MeshPaths(const std::vector<std::uint8_t>& tones, const View& view) {
  std::string paths[kTones + 1];
  for (int row = 0; row < view.rows; ++row) {
    const std::uint8_t* cells = tones.data() + static_cast<std::size_t>(row) * view.columns;
    for (int begin = 0, end = 0; begin < view.columns; begin = end) {
      while (end < view.columns && cells[end] == cells[begin]) ++end;
      if (cells[begin] == 0) continue;
      paths[cells[begin]] += Text("M%d %dh%dv1h%dz", begin, row, end - begin, begin - end);
    }
  }
  std::string svg =
      Text("<g transform=\"scale(%d)\" shape-rendering=\"crispEdges\">\n", kUnitsPerCell);
  for (int tone = 1; tone <= kTones; ++tone) {
    if (paths[tone].empty()) continue;
    const int grey = 150 + 90 * (tone - 1) / (kTones - 1);
    svg += Text("<path fill=\"rgb(%d,%d,%d)\" d=\"", grey, grey + 3, grey + 8) + paths[tone] +
           "\"/>\n";
  }
  return svg + "</g>\n";
}

/// From blue-green (none) through yellow to red (the most).
std::string Colour(double share) {
  static constexpr int kStops[3][3] = {{22, 122, 138}, {226, 165, 36}, {200, 50, 46}};
  const int first = share < 0.5 ? 0 : 1;
  const double t = std::clamp(2 * share - first, 0.0, 1.0);
  const auto mix = [&](int i) {
    return static_cast<int>(std::lround((1 - t) * kStops[first][i] + t * kStops[first + 1][i]));
  };
  return Text("rgb(%d,%d,%d)", mix(0), mix(1), mix(2));
}

double OvershootOf(const sphere_tree::SphereNode& node) {
  return node.radius + node.signed_distance;
}

/// The farthest first.
std::string Balls(const sphere_tree::SphereTree& tree, std::vector<NodeIndex> cut, const View& view,
                  double overshoot_max) {
  const auto depth = [&](NodeIndex index) { return view.axes.row(2).dot(tree.node(index).centre); };
  std::stable_sort(cut.begin(), cut.end(),
                   [&](NodeIndex a, NodeIndex b) { return depth(a) < depth(b); });
  // Many balls lie over each other: then each covers less.
  const double opacity = std::clamp(3.5 / std::sqrt(static_cast<double>(cut.size())), 0.03, 0.16);
  std::string svg =
      Text("<g fill-opacity=\"%.3f\" stroke-opacity=\"0.75\" stroke-width=\"%.2f\">\n", opacity,
           cut.size() > 200 ? 1.0 : 1.6);
  for (const NodeIndex index : cut) {
    const sphere_tree::SphereNode& node = tree.node(index);
    const Vector3d at = kUnitsPerCell * view.Cell(node.centre);
    const double share = overshoot_max > 0 ? OvershootOf(node) / overshoot_max : 0;
    const std::string colour = Colour(share);
    svg += Text("<circle cx=\"%.2f\" cy=\"%.2f\" r=\"%.2f\"", at.x(), at.y(),
                kUnitsPerCell * node.radius * view.cells_per_metre) +
           " fill=\"" + colour + "\" stroke=\"" + colour + "\"/>\n";
  }
  return svg + "</g>\n";
}

/// 1, 2 or 5 times a power of ten, at most `length`.
double RoundLength(double length) {
  const double power = std::pow(10, std::floor(std::log10(length)));
  return power * (length >= 5 * power ? 5 : length >= 2 * power ? 2 : 1);
}

std::string Label(double x, double y, const char* more, const std::string& text) {
  return Text("<text x=\"%.1f\" y=\"%.1f\" %s>", x, y, more) + Escaped(text) + "</text>\n";
}

std::string Scale(const View& view, double y) {
  const double units_per_metre = kUnitsPerCell * view.cells_per_metre;
  const double length = RoundLength(0.25 * kUnitsPerCell * view.columns / units_per_metre);
  const double right = kMargin + length * units_per_metre;
  return Text("<path d=\"M%d %.1fv6h%.2fv-6\" fill=\"none\" stroke=\"#333\"/>\n", kMargin, y - 6,
              length * units_per_metre) +
         Label(right + 8, y + 2, "", Text("%g m", length));
}

std::string Legend(double right, double y, double overshoot_max) {
  std::string svg;
  constexpr int kSteps = 24, kStep = 6;
  const double left = right - kSteps * kStep - 74;
  for (int i = 0; i < kSteps; ++i) {
    svg += Text("<rect x=\"%.1f\" y=\"%.1f\" width=\"%d\" height=\"9\" fill=\"", left + kStep * i,
                y - 8, kStep) +
           Colour((i + 0.5) / kSteps) + "\"/>\n";
  }
  svg += Label(left - 8, y, "text-anchor=\"end\"", "overshoot 0");
  return svg + Label(left + kSteps * kStep + 8, y, "", Text("%.3g m", overshoot_max));
}

}  // namespace

std::string LevelPicture(const MeshTree& mesh_tree, std::uint32_t level) {
  const std::vector<NodeIndex> cut = mesh_tree.tree().Cut(level);
  const View view = ViewOf(mesh_tree, cut);
  const sphere_tree::Overshoot overshoot =
      collision::sphere_tree::OvershootOf(mesh_tree.tree(), cut);
  const int width = std::max(kWidthMin, kUnitsPerCell * view.columns + 2 * kMargin);
  const int height = kUnitsPerCell * view.rows + kHead + kFoot;
  const double percent = 100 / mesh_tree.diagonal();
  const std::string name = std::filesystem::path(mesh_tree.file).filename().string();
  std::string svg = Text(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" width=\"%d\" height=\"%d\" "
      "font-family=\"sans-serif\" font-size=\"13\" fill=\"#333\">\n"
      "<rect width=\"100%%\" height=\"100%%\" fill=\"#fdfdfb\"/>\n",
      width, height, width, height);
  svg += Label(kMargin, 32, "font-size=\"19\" font-weight=\"bold\"",
               name + ": " + BuilderName(mesh_tree.options.builder) + " tree, level " +
                   std::to_string(level) + ", " + std::to_string(cut.size()) + " balls");
  svg += Label(kMargin, 54, "",
               Text("reaching beyond the surface by at most %.3g m (%.3g %% of the diagonal), ",
                    overshoot.max, overshoot.max * percent) +
                   Text("%.3g m (%.3g %%) on average", overshoot.mean, overshoot.mean * percent));
  svg += Text("<g transform=\"translate(%d %d)\">\n", kMargin, kHead);
  svg += MeshPaths(Shaded(mesh_tree.shape->mesh(), view), view);
  svg += Balls(mesh_tree.tree(), cut, view, overshoot.max) + "</g>\n";
  svg += Scale(view, height - 22) + Legend(width - kMargin, height - 22, overshoot.max);
  return svg + "</svg>\n";
}

}  // namespace collision::client
