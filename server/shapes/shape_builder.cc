#include "server/shapes/shape_builder.h"

#include <chrono>
#include <optional>
#include <utility>

#include "collision_core/base/check.h"
#include "server/shapes/shape_decoding.h"

namespace collision::server {
namespace {

class Stopwatch {
 public:
  std::int64_t microseconds() const {
    const auto passed = std::chrono::steady_clock::now() - start_;
    return std::chrono::duration_cast<std::chrono::microseconds>(passed).count();
  }

 private:
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Builds the wanted tree and keeps it in the cache.
std::shared_ptr<const shape::Shape> BuildSurface(const std::string& hash,
                                                 geometry::TriangleMesh mesh,
                                                 const BuildOptions& options,
                                                 const shape::Shape* twin) {
  auto surface = shape::Shape::Build(std::move(mesh), options.tree, twin);
  if (options.cache) options.cache->Store(hash, surface->tree());
  return surface;
}

/// Takes the tree from the cache or builds it: it is the same.
std::shared_ptr<const shape::Shape> SurfaceOf(const std::string& hash, geometry::TriangleMesh mesh,
                                              bool may_wait, const BuildOptions& options,
                                              BuiltShape* built) {
  std::optional<sphere_tree::SphereTree> cached;
  if (options.cache) cached = options.cache->Load(hash, mesh);
  built->from_cache = cached.has_value();
  if (cached) return shape::Shape::FromTree(std::move(mesh), std::move(*cached));
  built->coarse = !may_wait && mesh.triangles.size() > kCoarseFirstTriangles &&
                  options.tree.builder != kCoarseTree.builder;
  if (built->coarse) return shape::Shape::Build(std::move(mesh), kCoarseTree);
  return BuildSurface(hash, std::move(mesh), options, nullptr);
}

/// `may_wait`: the wanted tree is built, however long that takes.
BuiltShape Build(const std::string& hash, std::string bytes, bool may_wait,
                 const BuildOptions& options) {
  const Stopwatch stopwatch;
  BuiltShape built;
  std::optional<DecodedShape> decoded =
      DecodeAndCheck(std::move(bytes), options.triangles_max, &built.refusal);
  if (!decoded) return built;
  built.dropped = decoded->dropped;
  if (!decoded->mesh.triangles.empty()) {
    built.shape = SurfaceOf(hash, std::move(decoded->mesh), may_wait, options, &built);
  }
  if (!decoded->solids.empty()) {
    built.shape = shape::Shape::Compound(std::move(built.shape), std::move(decoded->solids));
  }
  built.microseconds = stopwatch.microseconds();
  return built;
}

}  // namespace

BuildOptions BuildOptionsOf(const v1::Config& complete) {
  BuildOptions options{.triangles_max = complete.shape_triangles_max()};
  if (complete.tree_builder() == v1::Config::FITTED)
    options.tree.builder = sphere_tree::TreeBuilder::kFitted;
  if (complete.tree_builder() == v1::Config::MEDIAN_SPLIT)
    options.tree.builder = sphere_tree::TreeBuilder::kMedianSplit;
  return options;
}

BuiltShape BuildShape(const std::string& hash, std::string bytes, const BuildOptions& options) {
  return Build(hash, std::move(bytes), true, options);
}

BuiltShape BuildFirst(const std::string& hash, std::string bytes, const BuildOptions& options) {
  return Build(hash, std::move(bytes), false, options);
}

BuiltShape Refine(const std::string& hash, const shape::Shape& coarse,
                  const BuildOptions& options) {
  const Stopwatch stopwatch;
  BuiltShape built;
  const bool compound = !coarse.solids().empty();
  built.shape = BuildSurface(hash, coarse.mesh(), options, compound ? nullptr : &coarse);
  if (compound)
    built.shape = shape::Shape::Compound(std::move(built.shape), coarse.solids(), &coarse);
  built.microseconds = stopwatch.microseconds();
  return built;
}

void ShapeBuilder::AddFinished(std::vector<v1::Input>* inputs) {
  for (const ReadyTree& tree : TakeFinished()) {
    v1::ShapeReady& ready = *inputs->emplace_back().mutable_shape_ready();
    ready.set_content_hash(tree.hash);
    ready.set_coarse(tree.coarse);
  }
}

void InlineShapeBuilder::Start(const std::string& hash, std::string bytes, std::uint64_t) {
  started_[hash] = {.bytes = std::move(bytes), .coarse = nullptr};
  finished_.push_back({hash});
}

std::vector<ReadyTree> InlineShapeBuilder::TakeFinished() { return std::exchange(finished_, {}); }

BuiltShape InlineShapeBuilder::Await(const ReadyTree& tree) {
  const auto started = started_.find(tree.hash);
  CORE_CHECK(started != started_.end(), "a shape that is awaited was started");
  std::erase(finished_, ReadyTree{tree.hash});
  Job& job = started->second;
  BuiltShape built;
  if (job.coarse) {
    built = Refine(tree.hash, *job.coarse, options_);
  } else if (tree.coarse) {
    built = BuildFirst(tree.hash, std::move(job.bytes), options_);
  } else {
    built = BuildShape(tree.hash, std::move(job.bytes), options_);
  }
  microseconds_ += static_cast<std::uint64_t>(built.microseconds);
  if (built.coarse) {
    job = {.bytes = {}, .coarse = built.shape};
  } else {
    started_.erase(started);
  }
  return built;
}

void InlineShapeBuilder::Forget(const std::string& hash) {
  started_.erase(hash);
  std::erase(finished_, ReadyTree{hash});
}

ShapeBuilderCounters InlineShapeBuilder::counters() const {
  return {.building = started_.size(),
          .microseconds = microseconds_,
          .cache = options_.cache ? options_.cache->counters() : TreeCacheCounters{}};
}

}  // namespace collision::server
