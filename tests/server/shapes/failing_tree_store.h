// A store of trees with a bug, for tests of what a failed check does.
#pragma once

#include "collision_core/base/check.h"
#include "server/shapes/tree_store.h"

namespace collision::server {

/// Fails a check on the thread that builds a shape, as a bug in a builder would.
class FailingTreeStore final : public TreeStore {
 public:
  std::optional<sphere_tree::SphereTree> Load(const std::string&,
                                              const geometry::TriangleMesh&) override {
    CORE_CHECK(false, "planted in the store of trees");
    return std::nullopt;
  }
  void Store(const std::string&, const sphere_tree::SphereTree&) override {}
  TreeCacheCounters counters() const override { return {}; }
};

}  // namespace collision::server
