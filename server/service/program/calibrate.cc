#include "server/service/program/calibrate.h"

#include <algorithm>
#include <ctime>
#include <vector>

#include "collision_core/narrow_phase/separation/separation.h"

namespace collision::server {
namespace {

constexpr std::uint32_t kCells = 16;  ///< Along an edge: 3072 triangles.
constexpr std::uint64_t kBudget = 10'000;
constexpr int kMeasurements = 15;
constexpr double kMeasurement = 0.04;  ///< [s]

/// Processor time of this program [s]; other programs do not count.
double ProcessorTime() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// A cube of side 2 with bumps and dents: closed, not convex. Its faces meet in the same bits.
Eigen::Vector3d Bump(const Eigen::Vector3d& p) {
  return p * (1 + 0.125 * (p.x() * p.y() + p.y() * p.z() - p.z() * p.x()));
}

void AddFace(int axis, bool positive, geometry::TriangleMesh* mesh) {
  const auto first = static_cast<std::uint32_t>(mesh->vertices.size());
  for (std::uint32_t i = 0; i <= kCells; ++i) {
    for (std::uint32_t j = 0; j <= kCells; ++j) {
      Eigen::Vector3d p;
      p[axis] = positive ? 1 : -1;
      p[(axis + 1) % 3] = 2.0 * i / kCells - 1;
      p[(axis + 2) % 3] = 2.0 * j / kCells - 1;
      mesh->vertices.push_back(Bump(p));
    }
  }
  for (std::uint32_t i = 0; i < kCells; ++i) {
    for (std::uint32_t j = 0; j < kCells; ++j) {
      const std::uint32_t a = first + i * (kCells + 1) + j;
      const std::uint32_t b = a + kCells + 1;
      geometry::Triangle lower = {a, b, b + 1}, upper = {a, b + 1, a + 1};
      if (!positive) {
        std::swap(lower[1], lower[2]);
        std::swap(upper[1], upper[2]);
      }
      mesh->triangles.push_back(lower);
      mesh->triangles.push_back(upper);
    }
  }
}

narrow_phase::BodySegment BumpyCube() {
  geometry::TriangleMesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool positive : {false, true}) AddFace(axis, positive, &mesh);
  }
  narrow_phase::BodySegment body;
  body.shape = shape::Shape::Build(std::move(mesh));
  return body;
}

/// From deep inside each other to well apart, turned by 3-4-5 about two axes.
std::vector<narrow_phase::RelativePose> Poses() {
  Eigen::Matrix3d about_z, about_x;
  about_z << 0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1;
  about_x << 1, 0, 0, 0, 0.8, -0.6, 0, 0.6, 0.8;
  std::vector<narrow_phase::RelativePose> poses;
  for (int i = 0; i < 24; ++i) {
    narrow_phase::RelativePose& pose = poses.emplace_back();
    pose.R_AB = i % 2 == 0 ? Eigen::Matrix3d(about_z * about_x) : about_z;
    pose.p_AB = Eigen::Vector3d(1.2 + 0.1 * i, 0.3, -0.2);
  }
  return poses;
}

std::uint64_t LookOnce(const narrow_phase::BodyTree& a, const narrow_phase::BodyTree& b,
                       const std::vector<narrow_phase::RelativePose>& poses) {
  std::uint64_t spent = 0;
  for (const narrow_phase::RelativePose& pose : poses) {
    WorkBudget work(kBudget);
    narrow_phase::QuerySeparation({a, b, pose}, narrow_phase::Goal::kDecision, &work);
    spent += work.spent();
  }
  return spent;
}

}  // namespace

double MeasureWorkUnitsPerUs() {
  const narrow_phase::BodySegment body = BumpyCube();
  const narrow_phase::BodyTree a(body), b(body);
  const std::vector<narrow_phase::RelativePose> poses = Poses();
  std::vector<double> rates;
  for (int i = 0; i < kMeasurements; ++i) {
    const double start = ProcessorTime();
    std::uint64_t units = 0;
    double taken = 0;
    do {
      units += LookOnce(a, b, poses);
      taken = ProcessorTime() - start;
    } while (taken < kMeasurement);
    rates.push_back(static_cast<double>(units) / (taken * 1e6));
  }
  std::nth_element(rates.begin(), rates.begin() + kMeasurements / 2, rates.end());
  return rates[kMeasurements / 2];
}

}  // namespace collision::server
