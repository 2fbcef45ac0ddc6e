// The names by which descriptions refer to other agents, as numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "collision_core/broad_phase/collision_filter.h"
#include "idl/config.pb.h"
#include "idl/messages.pb.h"

namespace collision::server {

/// Numbers the assemblies and agents that descriptions name, and completes filters with them.
///
/// A name belongs to its simulator: of two simulators the same name has two numbers. A name keeps
/// its number while a description in force contains it, and after that among the kUnusedMax names
/// last given up, so that an agent that is removed and comes back at once has the number that it
/// had. No number is given twice. After 2^32 − 1 names no new one gets a number: its agent meets
/// what it would not, which is never late. The pairs that the configuration excludes are added to
/// the lists of the first of the two. O(log names) a name; some 150 bytes each. One thread.
class PartnerNames {
 public:
  static constexpr std::size_t kUnusedMax = 65536;

  /// Unchecked: the configuration is valid (CheckConfig()).
  explicit PartnerNames(const v1::Config& config);

  /// Sets assembly, name and lists of `filter` as the description says. The names keep their
  /// numbers at least as long as what is returned lives; it may outlive this.
  std::shared_ptr<const void> Complete(const v1::AgentDescription& wire,
                                       broad_phase::CollisionFilter* filter);

  /// Names that have a number.
  std::size_t size() const;

 private:
  using Key = std::pair<std::uint64_t, std::string>;  ///< Simulator and name.
  class Table;
  class Use;

  std::shared_ptr<Table> table_;
  std::map<Key, std::vector<Key>> excluded_;  ///< By the first of the two.
};

}  // namespace collision::server
