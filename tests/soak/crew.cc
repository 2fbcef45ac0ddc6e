// One program of a crew: crew CREW LIFE WATCHES WORLD DOMAIN. See plan.h.
//
// It prints "flies FIRST" once it knows with which watch it begins.
#include <signal.h>

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "collision/shape.h"
#include "collision/world.h"
#include "tests/soak/plan.h"

namespace collision::soak {
namespace {

using client::Agent;
using client::World;

/// Longer than the world stands still for anything.
constexpr std::chrono::seconds kPatience{120};

class Crew {
 public:
  Crew(const Plan& plan, int crew, int life, const std::string& world, std::uint32_t domain)
      : plan_(plan),
        crew_(crew),
        life_(LifeOf(plan, crew, life)),
        world_(World::Connect({.world = world, .simulator = life_.name, .domain = domain})) {
    // Else they are kept for later.
    world_.OnEvent([](const client::Event&) {});
  }

  void Fly(bool from_the_begin) {
    const int first = from_the_begin ? 0 : Join();
    std::printf("flies %d\n", first);
    std::fflush(stdout);
    const int end = std::min(first + life_.watches, plan_.watches());
    for (int watch = first; watch < end; ++watch) {
      FlyWatch(watch, life_.killed && watch == end - 1);
    }
    agents_.clear();
    Advance(plan_.BeginOf(std::max(first, end)));
  }

 private:
  /// Returns the next watch that begins.
  int Join() {
    const auto now_ns = world_.Join(kPatience);
    if (!now_ns) throw std::runtime_error("nobody said what time it is");
    Advance(*now_ns);
    return static_cast<int>(*now_ns / plan_.watch_ns()) + 1;
  }

  void Advance(std::int64_t t_ns) {
    if (world_.AdvanceTo(t_ns, kPatience) == client::Advance::kTimeout) {
      throw std::runtime_error("no grant for " + std::to_string(t_ns));
    }
  }

  void FlyWatch(int watch, bool killed) {
    agents_.clear();
    for (int site = 0; site < kSites; ++site) Add(watch, site);
    for (int step = 0; step < kSteps; ++step) {
      if (killed && step == kSteps / 2) raise(SIGKILL);
      const std::int64_t t_ns = plan_.BeginOf(watch) + step * plan_.step_ns();
      for (int site = 0; site < kSites; ++site) {
        agents_[static_cast<std::size_t>(site)].SetState(StateAt(watch, site, t_ns));
      }
      Advance(t_ns);
    }
  }

  void Add(int watch, int site) {
    const Flight flight = FlightOf(plan_, watch, crew_, site);
    const double watch_s = 1e-9 * static_cast<double>(plan_.watch_ns());
    client::AgentDescription description{.name = std::to_string(site),
                                         .radius_m = flight.radius_m,
                                         .acceleration_max_m_s2 = 0.25 / (watch_s * watch_s)};
    if (flight.has_shape) {
      description.shape = client::Shape::Make({.solids = {client::Solid::Ball(flight.radius_m)}});
      description.radius_m = description.shape->radius_m();
    }
    agents_.push_back(world_.AddAgent(description, StateAt(watch, site, plan_.BeginOf(watch))));
    // Slots that are given back are taken again: those of a watch are the ones of the last but one.
    if (agents_.back().id().slot >= 2 * kSites) throw std::runtime_error("slots are not reused");
  }

  client::State StateAt(int watch, int site, std::int64_t t_ns) const {
    const Flight flight = FlightOf(plan_, watch, crew_, site);
    const double seconds = 1e-9 * static_cast<double>(t_ns - plan_.BeginOf(watch));
    const Eigen::Vector3d p = flight.p_m + seconds * flight.v_m_s, &v = flight.v_m_s;
    return {.stamp_ns = t_ns,
            .position_m = {p.x(), p.y(), p.z()},
            .velocity_m_s = {v.x(), v.y(), v.z()}};
  }

  const Plan plan_;
  const int crew_;
  const Life life_;
  World world_;
  std::vector<Agent> agents_;
};

}  // namespace
}  // namespace collision::soak

int main(int count, char** words) {
  if (count != 6) {
    std::fprintf(stderr, "usage: soak_crew CREW LIFE WATCHES WORLD DOMAIN\n");
    return 2;
  }
  using namespace collision::soak;
  try {
    const int life = std::atoi(words[2]);
    Crew crew(Plan(std::atoi(words[3])), std::atoi(words[1]), life, words[4],
              static_cast<std::uint32_t>(std::atoi(words[5])));
    crew.Fly(life == 0);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "soak_crew: %s\n", error.what());
    return 1;
  }
  return 0;
}
