// Our time of contact, and stepping, which sees nothing between its frames.
#include "tests/bench/pairs/contact_ours.h"

#include <Eigen/Geometry>
#include <cmath>

#include "collision_core/narrow_phase/separation/separation.h"
#include "tests/bench/pairs/pose.h"
#include "tests/collision_core/sphere_tree/meshes.h"

namespace collision::bench {
namespace {

constexpr std::uint64_t kPlenty = 400'000'000;
constexpr double kTolerances[] = {1e-1, 3e-2, 1e-2, 1e-3, 1e-4,  1e-5,
                                  1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-12};
constexpr double kRates[] = {60, 240, 1000, 10'000};

Eigen::Vector3d VectorOf(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

geometry::TriangleMesh MeshOf(const MovingBody& body) {
  if (body.kind == MovingBody::Kind::kBox) return Box(-VectorOf(body.half), VectorOf(body.half));
  geometry::TriangleMesh mesh;
  for (const auto& p : body.mesh->vertices) mesh.vertices.push_back(VectorOf(p));
  mesh.triangles = body.mesh->triangles;
  return mesh;
}

motion::SpaceTimeBound BoundOf(const MovingBody& body, double at,
                               const std::shared_ptr<const shape::Shape>& shape) {
  motion::SpaceTimeBound bound;
  bound.state.stamp = Instant::FromNanoseconds(std::llround(at * 1e9));
  bound.state.p_WA = VectorOf(body.p);
  bound.state.v_WA = VectorOf(body.v);
  bound.state.w_WB = VectorOf(body.w);
  bound.state.q_WB = Eigen::Quaterniond(body.q[0], body.q[1], body.q[2], body.q[3]);
  bound.limits.radius = shape ? shape->facts().radius : body.half[0];
  bound.limits.angular_acceleration_max = 0;
  return bound;
}

narrow_phase::KnownMotion MotionOf(const MovingBody& body, const ContactCase& of,
                                   const std::shared_ptr<const shape::Shape>& shape) {
  narrow_phase::KnownMotion motion;
  motion.shape = shape;
  motion.last = BoundOf(body, 0, shape);
  if (of.both_ends) motion.next = BoundOf(body.After(of.duration), of.duration, shape);
  return motion;
}

ContactReply ReplyOf(const narrow_phase::TimeOfContactResult& found) {
  using Verdict = ContactReply::Verdict;
  const Verdict verdict = found.status == narrow_phase::ContactStatus::kFree ? Verdict::kFree
                          : found.status == narrow_phase::ContactStatus::kContact
                              ? Verdict::kContact
                              : Verdict::kUndecided;
  return {verdict, found.begin.lower, found.begin.upper};
}

/// A box as a convex solid.
std::shared_ptr<const shape::Shape> SolidShapeOf(const MovingBody& body) {
  if (body.kind == MovingBody::Kind::kBall) return nullptr;
  shape::ConvexDescription box;
  box.core = geometry::ConvexCore::kBox;
  box.half = {body.half[0], body.half[1], body.half[2]};
  return shape::Shape::Compound(nullptr, {shape::ConvexSolid::Build(box)});
}

ContactMethod Ours(const std::string& name, bool solids, double tolerance) {
  ContactMethod method;
  method.name = name;
  method.setting = SettingText("", tolerance, "s");
  method.origin = Origin::kOurs;
  method.certified = true;
  method.limited_by = "the tolerance asked for; at last rounding over the closing speed";
  method.make = [solids, tolerance](const ContactCase& of) -> ContactQuery {
    ContactShapes shapes{solids ? SolidShapeOf(of.a) : ShapeOf(of.a),
                         solids ? SolidShapeOf(of.b) : ShapeOf(of.b)};
    // Two balls are the same either way.
    if (solids && !shapes.a && !shapes.b) return nullptr;
    return [of, shapes, tolerance] {
      return ReplyOf(OurContact(of, shapes, narrow_phase::ContactTolerance{tolerance, 0}));
    };
  };
  return method;
}

narrow_phase::BodySegment SegmentOf(const MovingBody& body) {
  narrow_phase::BodySegment segment;
  segment.shape = ShapeOf(body);
  segment.ball.radius = segment.shape ? segment.shape->facts().radius : body.half[0];
  return segment;
}

narrow_phase::RelativePose PoseAt(const ContactCase& of, double seconds) {
  const MovingBody a = of.a.After(seconds), b = of.b.After(seconds);
  const auto matrix = [](const MovingBody& body) {
    return Eigen::Quaterniond(body.q[0], body.q[1], body.q[2], body.q[3])
        .normalized()
        .toRotationMatrix();
  };
  const Eigen::Vector3d between(b.p[0] - a.p[0], b.p[1] - a.p[1], b.p[2] - a.p[2]);
  return collision::narrow_phase::PoseOf(matrix(a).transpose() * matrix(b),
                                         matrix(a).transpose() * between);
}

bool BallsTouch(const ContactCase& of, double seconds) {
  double square = 0;
  for (int i = 0; i < 3; ++i) {
    const double d = of.b.p[i] - of.a.p[i] + seconds * (of.b.v[i] - of.a.v[i]);
    square += d * d;
  }
  const double reach = of.a.half[0] + of.b.half[0];
  return square <= reach * reach;
}

std::optional<double> Step(const ContactCase& of, const narrow_phase::BodySegment& a,
                           const narrow_phase::BodySegment& b, double rate) {
  const auto frames = static_cast<int>(std::lround(of.duration * rate));
  const bool balls = !a.shape && !b.shape;
  for (int frame = 0; frame <= frames; ++frame) {
    const double at = frame / rate;
    WorkBudget work(kUnlimited);
    const bool touch =
        balls ? BallsTouch(of, at)
              : narrow_phase::DecideAt(
                    {narrow_phase::BodyTree(a), narrow_phase::BodyTree(b), PoseAt(of, at)}, &work)
                        .verdict == narrow_phase::Verdict::kTouching;
    if (touch) return at;
  }
  return std::nullopt;
}

}  // namespace

std::shared_ptr<const shape::Shape> ShapeOf(const MovingBody& body) {
  if (body.kind == MovingBody::Kind::kBall) return nullptr;
  return shape::Shape::Build(MeshOf(body), {.builder = sphere_tree::TreeBuilder::kFitted});
}

narrow_phase::TimeOfContactResult OurContact(const ContactCase& of, const ContactShapes& shapes,
                                             const narrow_phase::ContactTolerance& tolerance) {
  WorkBudget work(kPlenty);
  return TimeOfContact(MotionOf(of.a, of, shapes.a), MotionOf(of.b, of, shapes.b),
                       {Instant(), Instant::FromNanoseconds(std::llround(of.duration * 1e9))},
                       tolerance, &work);
}

ContactMethods OurContactCurves() {
  ContactMethods methods;
  for (const double tolerance : kTolerances) methods.push_back(Ours("ours", false, tolerance));
  for (const double tolerance : kTolerances) {
    methods.push_back(Ours("ours, as solids", true, tolerance));
  }
  return methods;
}

ContactMethods SteppingMethods() {
  ContactMethods methods;
  for (const double rate : kRates) {
    ContactMethod method;
    method.name = "stepping";
    method.setting = SettingText("", rate, "Hz");
    method.origin = Origin::kBaseline;
    method.naive = true;
    method.limited_by = "what lies between two frames";
    method.make = [rate](const ContactCase& of) -> ContactQuery {
      return [of, a = SegmentOf(of.a), b = SegmentOf(of.b), rate] {
        return Plainly(Step(of, a, b, rate));
      };
    };
    methods.push_back(std::move(method));
  }
  return methods;
}

}  // namespace collision::bench
