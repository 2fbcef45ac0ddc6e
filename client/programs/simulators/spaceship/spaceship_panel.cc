#include "client/programs/simulators/spaceship/spaceship_panel.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "client/programs/shared/terminal.h"

namespace collision::client {
namespace {

constexpr std::size_t kInstruments = 2;
constexpr std::size_t kRadarShare = 70;  // percent of the rows below the instruments
constexpr std::size_t kRadarRowsMin = 4;
constexpr int kThrustBars = 5;

double Degrees(double radians) { return radians * 180 / std::acos(-1.0); }

// As on a compass: +y is north, 0°, +x east, 90°.
double Bearing(const Vector3& direction) {
  const double degrees = 90 - Degrees(std::atan2(direction[1], direction[0]));
  return std::fmod(degrees + 360, 360);
}

std::string Bars(double share) {
  const auto lit = static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * kThrustBars));
  std::string bars;
  for (int i = 0; i < kThrustBars; ++i) bars += i < lit ? "█" : "·";
  return bars;
}

std::string Instruments(const SpaceshipPanel& panel) {
  const Vector3& heading = panel.radar.heading;
  char text[160];
  std::snprintf(
      text, sizeof text,
      "%7.1f s  %5.1f m/s  heading %03.0f° %+3.0f°  turning %3.0f°/s  thrust %s%s", panel.time_s,
      panel.speed_m_s, Bearing(heading), Degrees(std::asin(std::clamp(heading[2], -1.0, 1.0))),
      Degrees(panel.turn_rate_rad_s), Bars(panel.thrust).c_str(), panel.braking ? "  braking" : "");
  return text;
}

std::string Surroundings(const SpaceshipPanel& panel) {
  std::string text = panel.clearance.empty() ? "no promise yet" : panel.clearance;
  if (!panel.nearest.empty()) text += "  nearest: " + panel.nearest;
  if (!panel.earliest.empty()) text += "  first of all: " + panel.earliest;
  text += "  bounces: " + std::to_string(panel.bounces);
  return text;
}

}  // namespace

std::vector<std::string> PanelLines(SpaceshipPanel panel, std::size_t columns, std::size_t rows) {
  std::vector<std::string> lines = {Instruments(panel), Surroundings(panel)};
  const std::vector<std::string> keys =
      panel.help ? HelmHelp() : std::vector<std::string>{"h: keys   q: end"};
  const std::size_t below = rows > kInstruments ? rows - kInstruments : 0;
  const std::size_t free = below > keys.size() ? below - keys.size() : 0;
  const std::size_t radar_rows = std::max(free * kRadarShare / 100, std::min(free, kRadarRowsMin));
  panel.radar.range_m = RadarRange(panel.radar, panel.zoom);
  for (std::string& line : DrawRadar(panel.radar, columns, radar_rows)) {
    lines.push_back(std::move(line));
  }
  const std::size_t used = lines.size() + keys.size();
  const std::size_t events = std::min(panel.events.size(), rows > used ? rows - used : 0);
  lines.insert(lines.end(), panel.events.end() - static_cast<std::ptrdiff_t>(events),
               panel.events.end());
  while (lines.size() + keys.size() < rows) lines.emplace_back();
  lines.insert(lines.end(), keys.begin(), keys.end());
  if (lines.size() > rows) lines.resize(rows);
  for (std::string& line : lines) line = Cut(line, columns);
  return lines;
}

}  // namespace collision::client
