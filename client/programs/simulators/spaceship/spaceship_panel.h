// The pilot's view in characters: instruments, radar, events.
#pragma once

#include <string>
#include <vector>

#include "client/programs/simulators/spaceship/radar.h"
#include "client/programs/simulators/spaceship/spaceship_helm.h"

namespace collision::client {

struct SpaceshipPanel {
  double time_s = 0;
  double speed_m_s = 0;
  double thrust = 0;  ///< Share of the engine's power.
  double turn_rate_rad_s = 0;
  bool braking = false;
  std::string clearance;  ///< "clear for 1.20 s"; empty: the service has not said yet.
  std::string earliest;   ///< The pair that can touch first, and when.
  std::string nearest;    ///< "drone-3, 12.1 m".
  RadarPicture radar;
  int zoom = 0;
  std::vector<std::string> events;  ///< The newest last.
  std::size_t bounces = 0;
  bool help = false;
};

/// The screen in lines: two of instruments, the radar, the newest events, the keys. Parts that do
/// not fit are left out, the events first, so a terminal of any size shows a picture.
std::vector<std::string> PanelLines(SpaceshipPanel panel, std::size_t columns, std::size_t rows);

}  // namespace collision::client
