// Sphere trees as messages: the one document that is made of the core's own data, for daemon and
// tools alike.
#pragma once

#include <optional>

#include "collision_core/sphere_tree/sphere_tree.h"
#include "collision_core/sphere_tree/tree_options.h"
#include "idl/sphere_tree.pb.h"

namespace collision {

v1::SphereTree ToMessage(const sphere_tree::SphereTree& tree);

/// nullopt: columns of different lengths, or more nodes than can be numbered. Values are not
/// judged: RefusalOf(tree, mesh) of collision_core/sphere_tree/tree_check.h does that.
std::optional<sphere_tree::SphereTree> FromMessage(const v1::SphereTree& message);

/// Without the fingerprint.
v1::TreeRecipe RecipeOf(const sphere_tree::ShapeOptions& options);

}  // namespace collision
