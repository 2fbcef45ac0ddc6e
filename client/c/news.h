// News that waits until a C program takes it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <list>
#include <string>
#include <variant>
#include <vector>

#include "collision/collision.h"
#include "collision/monitor.h"
#include "collision/notice.h"
#include "collision/types.h"

namespace collision::client::c {

/// One piece of news, as the C++ library tells it.
struct News {
  std::int32_t kind = 0;  ///< COLLISION_NEWS_...
  AgentId agent = {};
  std::variant<std::monostate, Event, Clearance, Rejection, Breach, ServiceStatus,
               EarliestIntersection, DescribedAgent, State, SimulatorClock>
      value = {};
  std::string text = {};
  bool over = false;
  std::int32_t notice = 0;  ///< COLLISION_NOTICE_...
};

/// A notice of a world or a monitor.
News NewsOf(const Notice& notice);

/// One piece of news in C. Owns whatever it points to, but not the News.
class ToldNews {
 public:
  /// `news` must not change until the next call.
  const collision_news* Tell(const News& news);

 private:
  void Put(const std::monostate&) {}
  void Put(const Event& event);
  void Put(const Clearance& clearance);
  void Put(const Rejection& rejection);
  void Put(const Breach& breach);
  void Put(const ServiceStatus& status);
  void Put(const EarliestIntersection& earliest);
  void Put(const DescribedAgent& agent);
  void Put(const State& state);
  void Put(const SimulatorClock& clock);
  void Put(const AgentLabel& label, collision_label* to);
  const collision_tag* TagsOf(const std::vector<Tag>& tags);

  collision_news news_{};
  collision_event event_{};
  collision_proximity proximity_{};
  collision_state_used lower_state_{}, higher_state_{};
  collision_expectation expected_{};
  collision_closest_approach closest_{}, expected_closest_{};
  collision_clearance clearance_{};
  collision_rejection rejection_{};
  collision_breach breach_{};
  collision_service_status status_{};
  collision_earliest earliest_{};
  collision_agent_description description_{};
  collision_state state_{};
  collision_clock clock_{};
  std::string sentence_;
  std::list<std::vector<collision_tag>> tags_;  ///< Elements stay where they are.
  std::vector<const char*> meets_, never_meets_;
  std::vector<collision_simulator_status> simulators_;
  std::list<std::vector<collision_quota>> quotas_;  ///< Of each.
  std::vector<collision_counter> counters_;
  std::vector<collision_histogram> histograms_;
};

/// Oldest first; the oldest makes room beyond kNewsMax.
class NewsQueue {
 public:
  static constexpr std::size_t kNewsMax = 65536;

  void Add(News news);

  /// Null: there is none. What it hands out stays until the next call.
  const collision_news* Take();

  std::uint64_t lost() const { return lost_; }

 private:
  std::deque<News> waiting_;
  News taken_;
  ToldNews told_;
  std::uint64_t lost_ = 0;
};

collision_agent_id ToC(const AgentId& id);

/// `cause` is that of `clearance`, which must outlive it.
collision_clearance ToC(const Clearance& clearance);

}  // namespace collision::client::c
