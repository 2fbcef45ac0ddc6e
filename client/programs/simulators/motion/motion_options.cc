#include "client/programs/simulators/motion/motion_options.h"

#include "client/library/validation.h"
#include "client/programs/shared/command_line.h"

namespace collision::client {

void AddSpeedOptions(CLI::App* app, double* speed_max_m_s, double* acceleration_max_m_s2) {
  app->add_option("--speed-max", *speed_max_m_s, "Greatest speed [m/s]")
      ->check(Finite(kSpeedMax, false))
      ->capture_default_str();
  app->add_option("--acceleration-max", *acceleration_max_m_s2, "Greatest acceleration [m/s2]")
      ->check(Finite(kAccelerationMax, false))
      ->capture_default_str();
}

void AddTurnOptions(CLI::App* app, TurnLimits* limits) {
  app->add_option("--angular-acceleration-max", limits->angular_acceleration_max_rad_s2,
                  "Greatest angular acceleration [rad/s2]")
      ->check(Finite(kTurnAccelerationMax, false))
      ->capture_default_str();
  app->add_option("--turn-max", limits->angular_speed_max_rad_s, "Greatest turn rate [rad/s]")
      ->check(Finite(kTurnSpeedMax, false))
      ->capture_default_str();
}

void AddStepOptions(CLI::App* app, double* rate_hz, std::size_t* state_every) {
  app->add_option("--rate", *rate_hz, "Steps per second")
      ->check(WholeBetween(10, 1000))
      ->capture_default_str();
  app->add_option("--state-every", *state_every, "Steps between two states")
      ->check(WholeBetween(1, 1000))
      ->capture_default_str();
}

}  // namespace collision::client
