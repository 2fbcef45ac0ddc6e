#include "client/programs/shared/command_line.h"

#include <cstdio>

#include "idl/limits.h"

namespace collision::client {

CLI::Range DomainRange() { return {0, int{wire::kDomainMax}}; }

void AddWorldOptions(CLI::App* app, const std::string& purpose, std::string* world,
                     std::uint32_t* domain) {
  app->add_option("--world", *world, purpose)->envname("COLLISION_WORLD")->capture_default_str();
  app->add_option("--domain", *domain, "DDS domain")
      ->envname("COLLISION_DOMAIN")
      ->check(DomainRange())
      ->capture_default_str();
}

void AddSimulatorOptions(CLI::App* app, SimulatorOptions* options) {
  AddWorldOptions(app, "World to join", &options->world, &options->domain);
  app->add_option("--simulator", options->simulator, "Name of this simulator, unique in the world")
      ->required();
  auto* real_time = app->add_flag("--real-time", options->real_time,
                                  "Stamps are times since 1970, and no simulator waits");
  app->add_flag_callback(
         "--lock-step", [] {},
         "All simulators advance together, as the service grants (the default)")
      ->excludes(real_time);
  app->add_option("--speed", options->speed,
                  "Lock-step: at most X simulated seconds per second; 0: as fast as granted")
      ->check(Finite(1e9, true))
      ->excludes(real_time);
  app->add_option("--start-ns", options->start_ns,
                  "With --real-time: the run's start in nanoseconds since 1970; default: now")
      ->check(CLI::NonNegativeNumber);
  app->add_flag("--stream", options->stream,
                "Send every state, not only those that the service needs");
  app->add_option("--traffic", options->traffic,
                  "File for how many states were set and sent (message SimulatorTraffic)");
  app->add_option("--motion-log", options->motion_log,
                  "File for the exact motion, for motion-checker");
  app->add_flag("--linger", options->linger,
                "At the end wait for SIGTERM before leaving the world");
}

CLI::Validator Finite(double greatest, bool zero) {
  char range[48];
  std::snprintf(range, sizeof range, "0 %s x <= %.9g", zero ? "<=" : "<", greatest);
  const auto check = [greatest, zero, range = std::string(range)](const std::string& text) {
    double value = 0;
    const bool parsed = CLI::detail::lexical_cast(text, value);
    const bool allowed = parsed && (zero ? value >= 0 : value > 0) && value <= greatest;
    return allowed ? std::string() : text + ", allowed: " + range;
  };
  return CLI::Validator(check, range);
}

int RunProgram(const char* program, const std::function<int()>& run) {
  const auto fail = [program](const std::exception& error, int code) {
    std::fprintf(stderr, "%s: %s\n", program, error.what());
    return code;
  };
  try {
    return run();
  } catch (const RefusedError& error) {
    return fail(error, kExitRefused);
  } catch (const BadInput& error) {
    return fail(error, kExitBadData);
  } catch (const std::exception& error) {
    return fail(error, kExitUnavailable);
  }
}

std::optional<int> ParseCommandLine(CLI::App* app, int argc, char** argv) {
  try {
    app->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app->exit(error) == 0 ? kExitOk : kExitUsage;
  }
  return std::nullopt;
}

}  // namespace collision::client
