#include <google/protobuf/stubs/logging.h>

#include <cmath>
#include <stdexcept>

#include "collision/shape.h"
#include "collision_core/narrow_phase/separation/separation.h"
#include "collision_core/sphere_tree/tree_check.h"
#include "idl/shape_bytes.h"
#include "idl/tree_message.h"
#include "server/shapes/shape_builder.h"
#include "tests/fuzz/fuzzed_shapes.h"
#include "tests/fuzz/targets.h"

namespace collision::fuzz {
namespace {

constexpr std::size_t kTrianglesMax = 64;
constexpr std::uint64_t kUnits = 20000;

server::BuiltShape Built(const std::string& bytes, FuzzedData* data) {
  const sphere_tree::TreeBuilder builder =
      data->Flag() ? sphere_tree::TreeBuilder::kOctree : sphere_tree::TreeBuilder::kFitted;
  return server::BuildShape(Sha256(bytes), bytes,
                            {.triangles_max = kTrianglesMax,
                             .tree = {.builder = builder, .nodes_max = std::size_t{1} << 12}});
}

narrow_phase::BodySegment BodyOf(const std::shared_ptr<const shape::Shape>& shape) {
  narrow_phase::BodySegment body;
  body.shape = shape;
  body.ball.radius = shape->facts().radius;
  return body;
}

/// The tree may lie about distances, but no traversal leaves it or fails to end.
void LookWith(const std::shared_ptr<const shape::Shape>& shape, FuzzedData* data) {
  const narrow_phase::BodySegment a = BodyOf(shape), b = BodyOf(shape);
  const double reach = shape->facts().radius;
  const Eigen::Vector3d offset(data->Within(4 * reach), data->Within(4 * reach), 0);
  const auto turn = Eigen::Quaterniond(1, data->Within(1), data->Within(1), 0).normalized();
  WorkBudget work(kUnits);
  const narrow_phase::RelativePose pose = narrow_phase::PoseOf(turn.toRotationMatrix(), offset);
  const narrow_phase::SeparationBracket look =
      narrow_phase::QuerySeparation({narrow_phase::BodyTree(a), narrow_phase::BodyTree(b), pose},
                                    narrow_phase::Goal::kNearest, &work);
  Require(!std::isnan(look.lower) && !std::isnan(look.upper), "no number: ", look.lower, " ",
          look.upper);
  Require(work.spent() <= kUnits + kBatchUnits, "spent ", work.spent());
}

/// One number of one column is another one, or a column is longer or shorter.
void Damage(v1::SphereTree* tree, FuzzedData* data) {
  google::protobuf::RepeatedField<std::uint32_t>* const indices[] = {
      tree->mutable_level(),     tree->mutable_first_child(),
      tree->mutable_children(),  tree->mutable_first_triangle(),
      tree->mutable_triangles(), tree->mutable_triangle_indices()};
  google::protobuf::RepeatedField<double>* const numbers[] = {
      tree->mutable_centre_m(), tree->mutable_radius_m(), tree->mutable_signed_distance_m()};
  const std::size_t column = data->Below(10);
  if (column == 9) return tree->set_levels(static_cast<std::uint32_t>(data->Bits(4)));
  if (column < 6) {
    auto& values = *indices[column];
    if (values.empty()) return;
    const int at = static_cast<int>(data->Bits(2)) % values.size();
    values[at] = static_cast<std::uint32_t>(data->Bits(data->Below(5)));
    if (data->Byte() == 255) values.Add(0);
    return;
  }
  auto& values = *numbers[column - 6];
  if (values.empty()) return;
  values[static_cast<int>(data->Bits(2)) % values.size()] = data->Wild(1e7);
  if (data->Byte() == 255) values.RemoveLast();
}

void CheckTree(const std::shared_ptr<const shape::Shape>& shape, FuzzedData* data) {
  const auto walked = RefusalOf(
      shape->tree(), sphere_tree::TreeElements{.triangles = shape->mesh().triangles.size(),
                                               .solids = shape->solids().size()});
  Require(!walked, "a builder's tree is refused: ", walked.value_or(""));
  if (shape->mesh().triangles.empty() || !shape->solids().empty()) return;
  v1::SphereTree message = ToMessage(shape->tree());
  const std::optional<sphere_tree::SphereTree> back = FromMessage(message);
  Require(back.has_value(), "its own tree cannot be read back");
  const auto refusal = RefusalOf(*back, shape->mesh());
  Require(!refusal, "its own tree is refused: ", refusal.value_or(""));
  for (std::size_t i = data->Below(4); i > 0; --i) Damage(&message, data);
  if (data->Byte() == 255) {
    const google::protobuf::LogSilencer silent;
    if (!message.ParseFromString(data->Text(1024))) return;
  }
  std::optional<sphere_tree::SphereTree> tree = FromMessage(message);
  if (!tree || RefusalOf(*tree, shape->mesh())) return;
  LookWith(shape::Shape::FromTree(shape->mesh(), std::move(*tree)), data);
}

/// What the client takes, the service takes as the same body.
void FromClient(FuzzedData* data) {
  std::shared_ptr<const client::Shape> made;
  try {
    made = client::Shape::Make(FuzzedGeometry(data));
  } catch (const std::invalid_argument&) {
    return;
  }
  const server::BuiltShape built = Built(made->bytes(), data);
  Require(built.shape != nullptr, "the service refuses what the client made: ", built.refusal);
  Require(built.shape->facts().radius <= made->radius_m() * (1 + 1e-9), "reaches as far as ",
          built.shape->facts().radius, ", reported as ", made->radius_m());
  Require(built.shape->closed() == made->closed(), "closed to one only");
  LookWith(built.shape, data);
  CheckTree(built.shape, data);
}

/// Any bytes; what can be read is written the same way again.
void FromBytes(FuzzedData* data) {
  const std::string bytes = data->Text(4096);
  std::string error;
  const std::optional<ShapeContent> content = DecodeShape(bytes, &error);
  Require(content.has_value() || !error.empty(), "refused without a reason");
  if (!content) return;
  Require(EncodeShape(*content) == bytes, "written in another way than it was read");
  const server::BuiltShape built = Built(bytes, data);
  Require(built.shape != nullptr || !built.refusal.empty(), "refused without a reason");
  if (!built.shape) return;
  Require(std::isfinite(built.shape->facts().radius), "radius ", built.shape->facts().radius);
  LookWith(built.shape, data);
  CheckTree(built.shape, data);
}

}  // namespace

void FuzzShape(Bytes bytes) {
  FuzzedData data(bytes);
  if (data.Flag()) {
    FromBytes(&data);
  } else {
    FromClient(&data);
  }
}

}  // namespace collision::fuzz
