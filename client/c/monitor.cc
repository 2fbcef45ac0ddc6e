#include "collision/monitor.h"

#include <utility>

#include "client/c/given.h"
#include "client/c/guard.h"
#include "client/c/news.h"
#include "collision/collision.h"

using namespace collision::client;
using c::Guarded;
using c::News;
using c::Require;

struct collision_monitor {
  explicit collision_monitor(const MonitorOptions& options)
      : connected(options,
                  {.event = Keeps<Event>(COLLISION_NEWS_EVENT),
                   .earliest = Keeps<EarliestIntersection>(COLLISION_NEWS_EARLIEST),
                   .status = Keeps<ServiceStatus>(COLLISION_NEWS_STATUS),
                   .clearance = KeepsOf<Clearance>(COLLISION_NEWS_CLEARANCE),
                   .rejection = Keeps<Rejection>(COLLISION_NEWS_REJECTION),
                   .breach = Keeps<Breach>(COLLISION_NEWS_BREACH),
                   .description = Keeps<DescribedAgent>(COLLISION_NEWS_DESCRIPTION),
                   .removal =
                       [this](std::uint64_t simulator, std::uint32_t slot) {
                         news.Add({.kind = COLLISION_NEWS_REMOVAL,
                                   .agent = {.simulator = simulator, .slot = slot}});
                       },
                   .state = KeepsOf<State>(COLLISION_NEWS_STATE),
                   .clock = Keeps<SimulatorClock>(COLLISION_NEWS_CLOCK),
                   .notice = [this](const Notice& notice) { news.Add(c::NewsOf(notice)); }}) {}

  collision_monitor(const collision_monitor&) = delete;
  collision_monitor& operator=(const collision_monitor&) = delete;

  template <class Value>
  std::function<void(const Value&)> Keeps(std::int32_t kind) {
    return [this, kind](const Value& value) { news.Add({.kind = kind, .value = value}); };
  }

  template <class Value>
  std::function<void(const AgentId&, const Value&)> KeepsOf(std::int32_t kind) {
    return [this, kind](const AgentId& agent, const Value& value) {
      news.Add({.kind = kind, .agent = agent, .value = value});
    };
  }

  c::NewsQueue news;
  Monitor connected;
};

void collision_monitor_options_init(collision_monitor_options* options, size_t size) {
  c::Initialize(c::DefaultMonitorOptions(), options, size);
}

collision_result collision_monitor_open(const collision_monitor_options* options,
                                        collision_monitor** monitor) {
  return Guarded([&] {
    Require("monitor", monitor);
    *monitor =
        new collision_monitor(c::FromC(c::Given("options", c::DefaultMonitorOptions(), options)));
    return COLLISION_OK;
  });
}

void collision_monitor_close(collision_monitor* monitor) { delete monitor; }

collision_result collision_monitor_poll(collision_monitor* monitor, int64_t timeout_ns) {
  return Guarded([&] {
    Require("monitor", monitor);
    monitor->connected.Poll(std::chrono::nanoseconds(timeout_ns));
    return COLLISION_OK;
  });
}

const collision_news* collision_monitor_next(collision_monitor* monitor) {
  return c::GuardedPointer<collision_news>(
      [&] { return monitor == nullptr ? nullptr : monitor->news.Take(); });
}

uint64_t collision_monitor_news_lost(const collision_monitor* monitor) {
  return monitor == nullptr ? 0 : monitor->news.lost();
}

uint64_t collision_monitor_contacts_missed(const collision_monitor* monitor) {
  return monitor == nullptr ? 0 : monitor->connected.contacts_missed();
}

int collision_monitor_service_alive(const collision_monitor* monitor) {
  return monitor != nullptr && monitor->connected.service_alive() ? 1 : 0;
}
