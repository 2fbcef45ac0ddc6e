#include "client/programs/tools/sphere_tree/raster.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace collision::client {
namespace {

using Eigen::Vector3d;

/// From the upper left, in front, in the picture's axes.
Vector3d Light() { return Vector3d(-0.4, -0.6, 0.7).normalized(); }

/// Both sides are shaded alike: meshes may be open, or turned inside out.
std::uint8_t ToneOf(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  Vector3d normal = (b - a).cross(c - a);
  if (normal.z() < 0) normal = -normal;
  const double length = normal.norm();
  const double cosine = length > 0 ? std::max(0.0, normal.dot(Light()) / length) : 1;
  return static_cast<std::uint8_t>(1 + std::lround((kTones - 1) * cosine));
}

double Cross(const Vector3d& a, const Vector3d& b, double x, double y) {
  return (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
}

class Raster {
 public:
  explicit Raster(const View& view)
      : view_(view),
        tones_(static_cast<std::size_t>(view.columns) * view.rows),
        depths_(tones_.size(), -std::numeric_limits<double>::infinity()) {}

  /// Fills each cell whose middle it covers, and those along its edges, so that thin ones show.
  void Add(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const std::uint8_t tone = ToneOf(a, b, c);
    const int left = Column(std::min({a.x(), b.x(), c.x()}));
    const int right = Column(std::max({a.x(), b.x(), c.x()}));
    const int top = Row(std::min({a.y(), b.y(), c.y()}));
    const int bottom = Row(std::max({a.y(), b.y(), c.y()}));
    MarkEdge(a, b, tone);
    MarkEdge(b, c, tone);
    MarkEdge(c, a, tone);
    const double area = Cross(a, b, c.x(), c.y());
    if (area == 0) return;
    for (int row = top; row <= bottom; ++row) {
      for (int column = left; column <= right; ++column) {
        const double x = column + 0.5, y = row + 0.5;
        const double u = Cross(b, c, x, y) / area, v = Cross(c, a, x, y) / area;
        if (u < 0 || v < 0 || u + v > 1) continue;
        Mark(column, row, u * a.z() + v * b.z() + (1 - u - v) * c.z(), tone);
      }
    }
  }

  std::vector<std::uint8_t> TakeTones() { return std::move(tones_); }

 private:
  int Column(double x) const { return std::clamp(static_cast<int>(x), 0, view_.columns - 1); }
  int Row(double y) const { return std::clamp(static_cast<int>(y), 0, view_.rows - 1); }

  void Mark(int column, int row, double depth, std::uint8_t tone) {
    const std::size_t cell = static_cast<std::size_t>(Row(row)) * view_.columns + Column(column);
    if (depth <= depths_[cell]) return;
    depths_[cell] = depth;
    tones_[cell] = tone;
  }

  void MarkEdge(const Vector3d& a, const Vector3d& b, std::uint8_t tone) {
    const int steps = 1 + static_cast<int>((b - a).head<2>().cwiseAbs().maxCoeff());
    for (int i = 0; i <= steps; ++i) {
      const Vector3d p = a + (b - a) * (static_cast<double>(i) / steps);
      Mark(static_cast<int>(p.x()), static_cast<int>(p.y()), p.z(), tone);
    }
  }

  const View& view_;
  std::vector<std::uint8_t> tones_;
  std::vector<double> depths_;
};

}  // namespace

std::vector<std::uint8_t> Shaded(const geometry::TriangleMesh& mesh, const View& view) {
  Raster raster(view);
  for (const auto& [a, b, c] : mesh.triangles) {
    raster.Add(view.Cell(mesh.vertices[a]), view.Cell(mesh.vertices[b]),
               view.Cell(mesh.vertices[c]));
  }
  return raster.TakeTones();
}

}  // namespace collision::client
