// What flies when in the week: the programs that fly it and the judge know it from here alone.
//
// The week consists of watches, all of one length. In each watch every crew that is there has an
// agent at each site: new ones, which fly straight and are removed at its end. Those of one site
// may touch, and sites are far apart, also from those of the next watch. So all contacts of the
// week are known in closed form.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

namespace collision::soak {

inline constexpr std::int64_t kWeekNs = 604'800'000'000'000;
inline constexpr int kCrews = 4;   ///< Programs at a time.
inline constexpr int kSites = 64;  ///< Agents of each.
inline constexpr int kSteps = 8;   ///< Of a watch.

/// A week of so many watches.
class Plan {
 public:
  explicit Plan(int watches) : watches_(watches), step_ns_(kWeekNs / watches / kSteps) {}

  int watches() const { return watches_; }
  std::int64_t step_ns() const { return step_ns_; }
  std::int64_t watch_ns() const { return kSteps * step_ns_; }
  std::int64_t BeginOf(int watch) const { return watch * watch_ns(); }

 private:
  int watches_;
  std::int64_t step_ns_;
};

/// A ball in straight flight from the begin of its watch.
struct Flight {
  Eigen::Vector3d p_m, v_m_s;
  double radius_m = 0;
  bool has_shape = false;  ///< A ball as a shape, which no other agent has.
};
Flight FlightOf(const Plan& plan, int watch, int crew, int site);

/// Which site a point is at.
int SiteOf(double x_m);

/// Two agents of one site at their nearest within a watch.
struct Meeting {
  double depth_m = 0;  ///< Of their overlap; negative: they stay so far apart.
  /// Of the overlap, if there is one, and at most of the watch.
  std::int64_t begin_ns = 0, end_ns = 0;
  bool begins_inside = false;  ///< The watch, not with it.
};
Meeting MeetingOf(const Plan& plan, int watch, int site, int crew, int other);

/// One program of a crew: the first one flies from the begin, each later one takes over from it.
struct Life {
  std::string name;     ///< Of the simulator.
  int watches = 0;      ///< That it flies at most.
  bool killed = false;  ///< In the middle of its last watch; else it ends in good order.
};
/// Crew 0 flies the whole week in one life, the programs of crew 3 have ever-new names.
Life LifeOf(const Plan& plan, int crew, int life);

}  // namespace collision::soak
