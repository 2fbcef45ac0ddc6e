#include "server/quotas/simulator_quotas.h"

#include <algorithm>
#include <cmath>

#include "collision_core/base/check.h"
#include "idl/identity.h"
#include "server/config/limit_blocks.h"

namespace collision::server {
namespace {

constexpr std::array kAllResources = {Resource::kAgents,    Resource::kPairs,
                                      Resource::kShapes,    Resource::kShapeBytes,
                                      Resource::kTreeBytes, Resource::kRejections};
static_assert(kAllResources.size() == kResources);

/// What a block says; 0: nothing.
std::uint64_t MaxOf(const v1::SimulatorLimits& block, Resource resource) {
  switch (resource) {
    case Resource::kAgents:
      return block.agents_max();
    case Resource::kPairs:
      return block.pairs_max();
    case Resource::kShapes:
      return block.shapes_max();
    case Resource::kShapeBytes:
      return block.shape_bytes_max();
    case Resource::kTreeBytes:
      return block.tree_bytes_max();
    case Resource::kRejections:
      return block.rejections_per_second_max();
  }
  return 0;
}

}  // namespace

const char* Name(Resource resource) {
  switch (resource) {
    case Resource::kAgents:
      return "agents";
    case Resource::kPairs:
      return "pairs";
    case Resource::kShapes:
      return "shapes";
    case Resource::kShapeBytes:
      return "shape_bytes";
    case Resource::kTreeBytes:
      return "tree_bytes";
    case Resource::kRejections:
      return "rejections_per_second";
  }
  return "";
}

std::uint64_t LimitOf(const v1::Config& config, Resource resource) {
  switch (resource) {
    case Resource::kAgents:
      return config.agents_max();
    case Resource::kPairs:
      return config.pairs_max();
    case Resource::kShapes:
      return config.shapes_max();
    case Resource::kShapeBytes:
      return config.shape_bytes_max();
    case Resource::kTreeBytes:
      return config.tree_bytes_max();
    case Resource::kRejections:
      return config.rejections_per_second_max();
  }
  return 0;
}

Share ShareOf(const v1::Config& config, const std::string& name, Resource resource) {
  const std::uint64_t limit = LimitOf(config, resource);
  // One part more than simulators: there is some room for a newcomer, and to refuse a stranger.
  Share share{.max = limit, .guaranteed = limit / (config.simulators_max() + std::uint64_t{1})};
  // Pairs that are tracked cannot be refused later: what a newcomer needs is kept beforehand.
  if (resource == Resource::kPairs && config.simulators_max() > 1) share.max -= share.guaranteed;
  const auto& blocks = config.limits();
  const auto block = std::find_if(blocks.begin(), blocks.end(), [&name](const auto& one) {
    return FitsPattern(name, one.name());
  });
  if (block == blocks.end()) return share;
  if (MaxOf(*block, resource) > 0) share.max = MaxOf(*block, resource);
  if (block->has_guaranteed()) {
    share.guaranteed =
        static_cast<std::uint64_t>(std::floor(block->guaranteed() * static_cast<double>(limit)));
  }
  share.guaranteed = std::min(share.guaranteed, share.max);
  return share;
}

std::set<std::uint64_t> ExpectedIds(const v1::Config& config) {
  std::set<std::uint64_t> ids;
  for (const v1::SimulatorLimits& block : config.limits()) {
    if (!IsPattern(block.name())) ids.insert(SimulatorId(block.name()));
  }
  return ids;
}

SimulatorQuotas::SimulatorQuotas(const v1::Config& config) : config_(config) {
  for (const v1::SimulatorLimits& block : config.limits()) {
    if (IsPattern(block.name())) continue;
    Enter(SimulatorId(block.name()), block.name());
    present_[SimulatorId(block.name())] = true;
  }
}

void SimulatorQuotas::Enter(std::uint64_t id, const std::string& name) {
  if (!present_.try_emplace(id, false).second) return;
  for (const Resource resource : kAllResources) {
    Limit& limit = Of(resource);
    limit.SetShare(limit.Enter(id), server::ShareOf(config_, name, resource));
  }
}

void SimulatorQuotas::Keep(const std::function<bool(std::uint64_t id)>& is_there) {
  std::erase_if(present_, [&](const auto& one) {
    const auto& [id, stays] = one;
    if (stays || is_there(id)) return false;
    for (Limit& limit : limits_) limit.Leave(limit.Find(id));
    return true;
  });
}

std::uint64_t SimulatorQuotas::RoomFor(std::uint64_t id, Resource resource,
                                       std::uint64_t free) const {
  const Limit& limit = Of(resource);
  const Limit::Account* account = limit.Find(id);
  return limit.RoomFor(account != nullptr ? *account : Limit::Account{}, free);
}

void SimulatorQuotas::Take(std::uint64_t id, Resource resource, std::uint64_t amount) {
  Of(resource).Take(Of(resource).At(id), amount);
}

void SimulatorQuotas::GiveBack(std::uint64_t id, Resource resource, std::uint64_t amount) {
  Limit::Account* account = Of(resource).Find(id);
  CORE_CHECK(account != nullptr && account->used >= amount, "what is given back was taken", id,
             amount);
  Of(resource).GiveBack(account, amount);
}

std::uint64_t SimulatorQuotas::Used(std::uint64_t id, Resource resource) const {
  const Limit::Account* account = Of(resource).Find(id);
  return account != nullptr ? account->used : 0;
}

Share SimulatorQuotas::ShareOf(std::uint64_t id, Resource resource) const {
  const Limit::Account* account = Of(resource).Find(id);
  return account != nullptr ? account->share : Share{};
}

}  // namespace collision::server
