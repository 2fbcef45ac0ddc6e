#include "client/programs/shared/command_line.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <limits>

#include "client/library/identity/library_version.h"
#include "idl/credentials/files.h"
#include "idl/limits.h"

namespace collision::client {

namespace {

std::string ShortText(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

/// `fits` says whether a text is allowed.
template <typename Fits>
CLI::Validator Allowed(const std::string& range, Fits fits) {
  const auto check = [range, fits](const std::string& text) {
    return fits(text) ? std::string() : text + ", allowed: " + range;
  };
  return CLI::Validator(check, range);
}

template <typename Number>
CLI::Validator NumberBetween(Number least, Number greatest, const std::string& range) {
  return Allowed(range, [least, greatest](const std::string& text) {
    Number value = 0;
    return CLI::detail::lexical_cast(text, value) && value >= least && value <= greatest;
  });
}

}  // namespace

CLI::Validator DomainRange() { return WholeBetween(0, std::int64_t{wire::kDomainMax}); }

CLI::Validator IdentifierWord() {
  const auto check = [](const std::string& text) {
    return wire::IsName(text) ? std::string() : "\"" + text + "\", allowed: " + wire::kNameText;
  };
  return CLI::Validator(check, "NAME");
}

void AddWorldOptions(CLI::App* app, const std::string& purpose, std::string* world,
                     std::uint32_t* domain, std::string* credentials) {
  app->add_option("--world", *world, purpose)
      ->envname("COLLISION_WORLD")
      ->check(IdentifierWord())
      ->capture_default_str();
  app->add_option("--domain", *domain, "DDS domain")
      ->envname("COLLISION_DOMAIN")
      ->check(DomainRange())
      ->capture_default_str();
  app->add_option("--credentials", *credentials,
                  "Folder of this program's credentials in a secured world")
      ->envname(credentials::kVariable)
      ->type_name("DIR");
}

void AddSimulatorOptions(CLI::App* app, SimulatorOptions* options) {
  AddWorldOptions(app, "World to join", &options->world, &options->domain, &options->credentials);
  app->add_option("--simulator", options->simulator, "Name of this simulator, unique in the world")
      ->required()
      ->check(IdentifierWord());
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
      ->check(WholeBetween(0, std::numeric_limits<std::int64_t>::max()));
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
  const double least = zero ? 0 : std::numeric_limits<double>::denorm_min();
  const std::string range = (zero ? "0 <= x <= " : "0 < x <= ") + ShortText(greatest);
  return NumberBetween(least, greatest, range);
}

CLI::Validator Between(double least, double greatest) {
  return NumberBetween(least, greatest, ShortText(least) + " to " + ShortText(greatest));
}

CLI::Validator WholeBetween(std::int64_t least, std::int64_t greatest) {
  return NumberBetween(least, greatest, std::to_string(least) + " to " + std::to_string(greatest));
}

CLI::Validator OneOf(std::vector<std::string> words) {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "" : ", ") + word;
  return Allowed(list, [words = std::move(words)](const std::string& text) {
    return std::ranges::count(words, text) > 0;
  });
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

void NameAsCalled(CLI::App* app, const char* path) {
  app->name(std::filesystem::path(path).filename().string());
}

void AddVersion(CLI::App* app) {
  app->set_version_flag("--version", app->get_name() + " " + LibraryVersion(),
                        "Print the version and end");
}

std::optional<int> ParseCommandLine(CLI::App* app, int argc, char** argv) {
  NameAsCalled(app, argv[0]);
  AddVersion(app);
  try {
    app->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app->exit(error) == 0 ? kExitOk : kExitUsage;
  }
  return std::nullopt;
}

}  // namespace collision::client
