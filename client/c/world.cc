#include "collision/world.h"

#include <algorithm>
#include <cstring>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

#include "client/c/agents.h"
#include "client/c/given.h"
#include "client/c/guard.h"
#include "client/c/news.h"
#include "client/library/identity/library_version.h"
#include "client/library/validation.h"
#include "collision/collision.h"

using namespace collision::client;
using c::Guarded;
using c::GuardedPointer;
using c::News;
using c::Require;

struct collision_world {
  explicit collision_world(World world) : connected(std::move(world)) {}
  collision_world(const collision_world&) = delete;
  collision_world& operator=(const collision_world&) = delete;

  /// All that the library calls back for becomes news.
  void Listen(bool notices);

  /// The same text for as long as the world is there.
  const char* Kept(const std::string& text) { return kept.insert(text).first->c_str(); }

  c::NumberedAgents agents;
  c::NewsQueue news;
  std::set<std::string> kept;
  std::string name, waits_for_name, ended_because;
  World connected;  // Ends first: it decides whether its agents leave with it.
};

void collision_world::Listen(bool notices) {
  connected.OnEvent(
      [this](const Event& event) { news.Add({.kind = COLLISION_NEWS_EVENT, .value = event}); });
  const auto keeps = [this](std::int32_t kind) {
    return [this, kind](const AgentId& agent, const Clearance& clearance) {
      news.Add({.kind = kind, .agent = agent, .value = clearance});
    };
  };
  connected.OnClearanceLowered(keeps(COLLISION_NEWS_LOWERED));
  connected.OnVoid(keeps(COLLISION_NEWS_VOID));
  connected.OnServiceLost([this] { news.Add({.kind = COLLISION_NEWS_SERVICE_LOST}); });
  connected.OnServiceBack([this] { news.Add({.kind = COLLISION_NEWS_SERVICE_BACK}); });
  connected.OnWaiting([this](const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& one : names) text += (text.empty() ? "" : ", ") + one;
    news.Add({.kind = COLLISION_NEWS_WAITING, .text = text});
  });
  if (!notices) return;
  connected.OnNotice([this](const Notice& notice) { news.Add(c::NewsOf(notice)); });
}

namespace {

/// Runs `call` with the world behind a handle.
template <class Call>
collision_result With(collision_world* world, const Call& call) noexcept {
  return Guarded([&] {
    Require("world", world);
    return call(*world);
  });
}

WorldOptions Checked(const collision_world_options* given) {
  WorldOptions options = c::FromC(c::Given("options", c::DefaultWorldOptions(), given));
  try {
    Validate(options);
  } catch (const std::runtime_error& error) {
    throw std::invalid_argument(error.what());
  }
  return options;
}

State StateFrom(const char* name, const collision_state* state) {
  return c::FromC(c::Given(name, c::DefaultState(), state));
}

AgentDescription DescriptionFrom(const collision_agent_description* description) {
  return c::FromC(c::Given("description", c::DefaultDescription(), description));
}

const char* TextOrNull(std::string text, std::string* kept) {
  *kept = std::move(text);
  return kept->empty() ? nullptr : kept->c_str();
}

}  // namespace

const char* collision_error(void) { return c::LastError(); }

const char* collision_version(void) { return LibraryVersion(); }

const char* collision_status_name(int32_t status) {
  if (status < COLLISION_POSSIBLE || status > COLLISION_ENDED) return nullptr;
  return Name(static_cast<EventStatus>(status));
}

void collision_world_options_init(collision_world_options* options, size_t size) {
  c::Initialize(c::DefaultWorldOptions(), options, size);
}

void collision_agent_description_init(collision_agent_description* description, size_t size) {
  c::Initialize(c::DefaultDescription(), description, size);
}

void collision_state_init(collision_state* state, size_t size) {
  c::Initialize(c::DefaultState(), state, size);
}

collision_result collision_world_connect(const collision_world_options* options,
                                         collision_world** world) {
  return Guarded([&] {
    Require("world", world);
    const WorldOptions checked = Checked(options);
    auto connected = std::make_unique<collision_world>(World::Connect(checked));
    const auto given = c::Given("options", c::DefaultWorldOptions(), options);
    connected->Listen(given.tell_notices != 0);
    *world = connected.release();
    return COLLISION_OK;
  });
}

void collision_world_close(collision_world* world) { delete world; }

collision_result collision_world_wait_for_service(collision_world* world, int64_t timeout_ns) {
  return With(world, [&](collision_world& one) {
    const bool is_there = one.connected.WaitForService(std::chrono::nanoseconds(timeout_ns));
    return is_there ? COLLISION_OK : COLLISION_TIMEOUT;
  });
}

collision_result collision_world_join(collision_world* world, int64_t timeout_ns, int64_t* now_ns) {
  return With(world, [&](collision_world& one) {
    Require("now_ns", now_ns);
    const auto now = one.connected.Join(std::chrono::nanoseconds(timeout_ns));
    if (now) *now_ns = *now;
    return now ? COLLISION_OK : COLLISION_TIMEOUT;
  });
}

collision_result collision_world_publish(collision_world* world, int64_t clock_ns) {
  return With(world, [&](collision_world& one) {
    one.connected.Publish(clock_ns);
    return COLLISION_OK;
  });
}

collision_result collision_world_advance_to(collision_world* world, int64_t clock_ns,
                                            int64_t timeout_ns) {
  return With(world, [&](collision_world& one) {
    const Advance advance = one.connected.AdvanceTo(clock_ns, std::chrono::nanoseconds(timeout_ns));
    if (advance == Advance::kReached) return COLLISION_OK;
    // Nothing would ever be granted.
    const std::string ended = one.connected.ended_because();
    if (!ended.empty()) throw std::logic_error("the run has ended: " + ended);
    return COLLISION_TIMEOUT;
  });
}

collision_result collision_world_finish(collision_world* world) {
  return With(world, [](collision_world& one) {
    one.connected.Finish();
    return COLLISION_OK;
  });
}

collision_result collision_world_poll(collision_world* world, int64_t timeout_ns) {
  return With(world, [&](collision_world& one) {
    one.connected.Poll(std::chrono::nanoseconds(timeout_ns));
    return COLLISION_OK;
  });
}

int64_t collision_world_clock_ns(const collision_world* world) {
  return world == nullptr ? COLLISION_ALWAYS : world->connected.clock_ns();
}

int64_t collision_world_granted_until_ns(const collision_world* world) {
  return world == nullptr ? COLLISION_ALWAYS : world->connected.granted_until_ns();
}

int collision_world_lock_step(const collision_world* world) {
  if (world == nullptr || !world->connected.world_lock_step()) return -1;
  return *world->connected.world_lock_step() ? 1 : 0;
}

const char* collision_world_waits_for_name(collision_world* world) {
  return GuardedPointer<char>([&]() -> const char* {
    if (world == nullptr) return nullptr;
    return TextOrNull(world->connected.waits_for_name(), &world->waits_for_name);
  });
}

const char* collision_world_ended_because(collision_world* world) {
  return GuardedPointer<char>([&]() -> const char* {
    if (world == nullptr) return nullptr;
    return TextOrNull(world->connected.ended_because(), &world->ended_because);
  });
}

uint64_t collision_world_contacts_missed(const collision_world* world) {
  return world == nullptr ? 0 : world->connected.contacts_missed();
}

uint64_t collision_world_news_lost(const collision_world* world) {
  return world == nullptr ? 0 : world->news.lost();
}

collision_result collision_world_traffic(const collision_world* world, collision_traffic* traffic,
                                         size_t size) {
  return Guarded([&] {
    Require("world", world);
    Require("traffic", traffic);
    c::RequireSize(size);
    const Traffic& sent = world->connected.traffic();
    c::Initialize(
        collision_traffic{0, sent.states_set, sent.states_sent, sent.samples_sent, sent.bytes_sent},
        traffic, size);
    return COLLISION_OK;
  });
}

const char* collision_world_name(collision_world* world, collision_agent_id id) {
  return GuardedPointer<char>([&]() -> const char* {
    if (world == nullptr) return nullptr;
    return TextOrNull(world->connected.Name(c::FromC(id)), &world->name);
  });
}

collision_result collision_world_add_agent(collision_world* world,
                                           const collision_agent_description* description,
                                           const collision_state* state, collision_agent* agent) {
  return With(world, [&](collision_world& one) {
    Require("agent", agent);
    *agent = one.agents.Add(
        one.connected.AddAgent(DescriptionFrom(description), StateFrom("state", state)));
    return COLLISION_OK;
  });
}

collision_result collision_world_remove_agent(collision_world* world, collision_agent agent) {
  return With(world, [&](collision_world& one) {
    one.agents.Remove(agent);
    return COLLISION_OK;
  });
}

collision_result collision_world_describe_agent(collision_world* world, collision_agent agent,
                                                const collision_agent_description* description) {
  return With(world, [&](collision_world& one) {
    one.agents.At(agent).SetDescription(DescriptionFrom(description));
    return COLLISION_OK;
  });
}

collision_result collision_world_set_states(collision_world* world, const collision_agent* agents,
                                            const collision_state* states, size_t count) {
  return With(world, [&](collision_world& one) {
    if (count == 0) return COLLISION_OK;
    Require("agents", agents);
    Require("states", states);
    const auto* bytes = reinterpret_cast<const unsigned char*>(states);
    for (std::size_t i = 0; i < count; ++i) {
      const auto* state = reinterpret_cast<const collision_state*>(bytes + i * states->struct_size);
      try {
        one.agents.At(agents[i]).SetState(StateFrom("state", state));
      } catch (const std::invalid_argument& error) {
        throw std::invalid_argument("states[" + std::to_string(i) + "]: " + error.what());
      }
    }
    return COLLISION_OK;
  });
}

collision_result collision_world_clearances(collision_world* world, const collision_agent* agents,
                                            collision_clearance* clearances, size_t size,
                                            size_t count) {
  return With(world, [&](collision_world& one) {
    if (count == 0) return COLLISION_OK;
    Require("agents", agents);
    Require("clearances", clearances);
    c::RequireSize(size);
    for (std::size_t i = 0; i < count; ++i) one.agents.At(agents[i]);
    auto* bytes = reinterpret_cast<unsigned char*>(clearances);
    for (std::size_t i = 0; i < count; ++i) {
      const Clearance clearance = one.agents.At(agents[i]).clearance();
      collision_clearance told = c::ToC(clearance);
      told.cause = one.Kept(clearance.cause);
      c::Initialize(told, reinterpret_cast<collision_clearance*>(bytes + i * size), size);
    }
    return COLLISION_OK;
  });
}

collision_result collision_world_agent_id(const collision_world* world, collision_agent agent,
                                          collision_agent_id* id) {
  return Guarded([&] {
    Require("world", world);
    Require("id", id);
    *id = c::ToC(world->agents.At(agent).id());
    return COLLISION_OK;
  });
}

const collision_news* collision_world_next(collision_world* world) {
  return GuardedPointer<collision_news>([&]() -> const collision_news* {
    if (world == nullptr) return nullptr;
    for (const Rejection& rejection : world->connected.TakeRejections()) {
      world->news.Add({.kind = COLLISION_NEWS_REJECTION, .value = rejection});
    }
    return world->news.Take();
  });
}
