// Bullet's GImpact: its two trees of quantised boxes, and its own test of two triangles until one
// pair meets. Its dispatcher would collect every contact of all pairs, which takes longer.
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>

#include <memory>

#include "tests/bench/pairs/peers.h"
#include "tests/bench/peers/bullet_types.h"

namespace collision::bench {
namespace {

class GImpact {
 public:
  GImpact(const PlainMesh& mesh, double margin) : margin_(static_cast<btScalar>(margin)) {
    for (const auto& p : mesh.vertices) {
      for (const double x : p) points_.push_back(static_cast<btScalar>(x));
    }
    for (const auto& t : mesh.triangles) {
      for (const std::uint32_t v : t) corners_.push_back(static_cast<int>(v));
    }
    triangles_ = std::make_unique<btTriangleIndexVertexArray>(
        static_cast<int>(mesh.triangles.size()), corners_.data(), static_cast<int>(3 * sizeof(int)),
        static_cast<int>(mesh.vertices.size()), points_.data(),
        static_cast<int>(3 * sizeof(btScalar)));
    shape_ = std::make_unique<btGImpactMeshShape>(triangles_.get());
    shape_->setMargin(margin_);
    shape_->updateBound();
    part_ = shape_->getMeshPart(0);
  }

  bool Touching(const btTransform& to_world) {
    const btTransform none = btTransform::getIdentity();
    pairs_.resize(0);
    btGImpactQuantizedBvh::find_collision(part_->getBoxSet(), none, part_->getBoxSet(), to_world,
                                          pairs_);
    part_->lockChildShapes();
    bool touching = false;
    for (int i = 0; i < pairs_.size() && !touching; ++i) {
      touching = Meet(pairs_[i].m_index1, pairs_[i].m_index2, to_world);
    }
    part_->unlockChildShapes();
    return touching;
  }

 private:
  bool Meet(int of_a, int of_b, const btTransform& to_world) const {
    btPrimitiveTriangle a, b;
    part_->getPrimitiveManager()->get_primitive_triangle(of_a, a);
    part_->getPrimitiveManager()->get_primitive_triangle(of_b, b);
    b.applyTransform(to_world);
    a.m_margin = b.m_margin = margin_;
    a.buildTriPlane();
    b.buildTriPlane();
    if (!a.overlap_test_conservative(b)) return false;
    GIM_TRIANGLE_CONTACT contact;
    return a.find_triangle_collision_clip_method(b, contact);
  }

  std::vector<btScalar> points_;
  std::vector<int> corners_;
  std::unique_ptr<btTriangleIndexVertexArray> triangles_;
  std::unique_ptr<btGImpactMeshShape> shape_;
  btGImpactMeshShapePart* part_ = nullptr;
  btPairSet pairs_;
  const btScalar margin_;
};

PairMethod Decision(const PlainMesh& mesh, double margin) {
  const auto gimpact = std::make_shared<GImpact>(mesh, margin);
  return {
      .name = "Bullet GImpact",
      .task = Task::kDecision,
      .limited_by = "single precision and quantised boxes; then the margin",
      .ask = [gimpact](const PlainPose& at) { return Plain(gimpact->Touching(BulletPose(at))); }};
}

}  // namespace

PairMethods BulletMesh(const PlainMesh& mesh) { return {Decision(mesh, 0)}; }

PairMethods BulletMeshCurves(const PlainMesh& mesh) {
  PairMethods methods;
  for (const double margin : kBulletMargins) {
    methods.push_back(Decision(mesh, margin));
    methods.back().setting = SettingText("margin", margin, "m");
  }
  return methods;
}

}  // namespace collision::bench
