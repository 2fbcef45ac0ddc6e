// What several channels ask about a scene: which agents there are, and how near to a contact.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "client/programs/scene/scene.h"

namespace collision::client {

/// How near an agent is to a contact, by the events that are open; a higher one counts. The page of
/// the gateway has the same levels.
enum class AlertLevel : std::uint8_t {
  kCalm,
  kPossible,  ///< A contact may come.
  kSoon,      ///< It may begin within kSoonNs, or a level of distance is reached.
  kContact,   ///< It lasts.
};

/// A forecast or a contact counts as near if it can begin within so much.
inline constexpr std::int64_t kSoonNs = 2'000'000'000;

/// The level that an open event means for its two agents.
AlertLevel LevelOf(const v1::CollisionEvent& event, std::int64_t now_ns);

/// Whether the two touch, or are expected to.
bool IsExpectedToTouch(const v1::CollisionEvent& event);

struct ShownAgent {
  bool is_there = false;       ///< Described, and held by the service.
  bool is_half_space = false;  ///< Then it has no frame: it lies in that of the world.
  bool never_moves = false;
  double radius = 0;  ///< [m]
  AlertLevel level = AlertLevel::kCalm;
  std::string frame;  ///< "SIMULATOR/AGENT".
  std::string shape;  ///< Hash; empty: none.
};

/// Kept while any channel is read. One thread.
class ShownWorld {
 public:
  /// With more agents they are shown together, by chunks, until there are few again.
  static constexpr std::size_t kAgentsApartMax = 1000, kAgentsFew = 900;

  /// All of the scene, as if nothing was known.
  void TakeAll(const Scene& scene);
  void Take(const Scene& scene, const SceneChanges& changes);

  /// By their numbers in the table of states.
  const std::vector<ShownAgent>& agents() const { return agents_; }

  /// Numbers of events that are possible or confirmed.
  const std::set<std::uint64_t>& open_events() const { return open_; }

  /// Of the agents whose level has changed in the last step.
  const std::vector<std::uint32_t>& releveled() const { return releveled_; }

  bool is_crowded() const { return is_crowded_; }

  /// The frame of the world: as the service names it, else "world".
  const std::string& frame() const { return frame_; }

  /// Whether an agent has an entity of its own: one of many has none, unless it never moves, as a
  /// floor or hills.
  bool IsApart(const ShownAgent& agent) const {
    return agent.is_there && (!is_crowded_ || agent.is_half_space || agent.never_moves);
  }

 private:
  void TakeAgent(const Scene& scene, std::uint32_t number);
  void TakeEvent(const Scene& scene, std::uint64_t number);
  void FindLevels(const Scene& scene);
  void FindCrowd();

  std::vector<ShownAgent> agents_;
  std::size_t there_ = 0;  ///< Agents that are there.
  bool is_crowded_ = false;
  std::set<std::uint64_t> open_;
  std::vector<std::uint32_t> releveled_;
  std::string frame_ = "world";
};

}  // namespace collision::client
