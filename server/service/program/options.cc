#include "server/service/program/options.h"

#include <google/protobuf/stubs/strutil.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <limits>
#include <sstream>

#include "idl/credentials/files.h"
#include "idl/recording/utc.h"
#include "server/config/config.h"
#include "server/config/config_options.h"
#include "server/process/version.h"

namespace collision::server {
namespace {

constexpr char kDescription[] =
    "collisiond - a collision detection service: tells independent simulators in advance which of "
    "their agents could touch";

constexpr char kFooter[] = R"(
Examples:
  collisiond                                    serve world "default" on DDS domain 0
  collisiond --config collisiond.textproto      serve as configured
  collisiond --config F --check-config          check F; every error with its line
  collisiond --print-config > F                 write all defaults, explained
  collisiond --calibrate                        how fast the narrow phase is on this machine
  collisiond --domain 7 --log-level debug       override two settings
  collisiond --reload 1234                      let process 1234 read its configuration anew
  COLLISION_WORLD=lab collisiond                the same for all programs of a shell
  collisiond --record run.rec                   serve, and keep every input
  collisiond --replay run.rec > events.jsonl    repeat that run without a network
  collisiond --replay /var/lib/collisiond/lab --from 2026-11-29T03:00
                                                likewise from the flight recorder, from then on

Signals: SIGTERM, SIGINT end it after the step; SIGHUP does what --reload does; SIGUSR1 writes what
it knows to the log.

Exit codes:
   0  ended as asked (SIGTERM, SIGINT), or the command is done
   2  wrong command line
  69  DDS is not available, or the credentials do not hold
  70  a check has failed: a bug in collisiond, which the log describes
  71  memory, or another resource of the system, is exhausted
  74  a file or folder cannot be written or read, or is damaged: a recording (later than at the
      start with on_recording_failure END), the journal in state_dir (with on_state_failure END),
      log_file, tree_cache_dir
  75  another service has the world
  78  the configuration is wrong, or its file cannot be read)";

/// Takes the range from the table of the configuration.
CLI::Validator AllowedBy(const char* field) {
  const ConfigOption* option = FindConfigOption(field);
  const auto check = [option](const std::string& text) -> std::string {
    const bool is_number = !option->least.empty();
    v1::Config config;
    if (SetValue(&config, *option,
                 is_number ? text : '"' + google::protobuf::CEscape(text) + '"')) {
      return CheckValue(config, *option);
    }
    return text + " is not a valid value; allowed: " + AllowedRange(*option);
  };
  return CLI::Validator(check, AllowedRange(*option));
}

/// Wall time, as wire::kUtcAllowed says.
CLI::Option* AddTime(CLI::App* app, const char* name, std::optional<std::int64_t>* time_ns,
                     const char* meaning) {
  const auto take = [time_ns](const std::string& text) { *time_ns = wire::FromUtc(text); };
  const auto check = [](const std::string& text) {
    return wire::FromUtc(text) ? "" : '"' + text + "\"; allowed: " + wire::kUtcAllowed;
  };
  return app->add_option_function<std::string>(name, take, meaning)
      ->type_name("TIME")
      ->check(CLI::Validator(check, ""));
}

CLI::Validator NotEmpty() {
  const auto check = [](const std::string& text) {
    return std::string(text.empty() ? "is empty" : "");
  };
  return CLI::Validator(check, "");
}

/// Returns the option --replay.
CLI::Option* DefineReplay(CLI::App* app, Options* options) {
  auto* replay =
      app->add_option("--replay", options->replay_file,
                      "Repeat the run that --record wrote to FILE, without DDS, with its own "
                      "configuration; prints each event of its readers as a line of JSON. FILE may "
                      "be a segment of the flight recorder, or a folder of them (state_dir)");
  AddTime(app, "--from", &options->from_ns,
          "Print what was told from this time (UTC) on, as 2026-11-29T03:00:00; of a folder, begin "
          "with the segment that contains it")
      ->needs(replay);
  AddTime(app, "--until", &options->until_ns, "Replay up to this time (UTC)")->needs(replay);
  app->add_flag("--transcript", options->transcript,
                "Print all inputs and all that the service tells, as bytes for programs "
                "(idl/recording.proto), instead of events; from the begin of the segment on")
      ->needs(replay);
  return replay;
}

void Define(CLI::App* app, Options* options) {
  auto* config =
      app->add_option("--config", options->config_file,
                      "Configuration file, protobuf text; without it every field has its default");
  auto* check = app->add_flag("--check-config", options->check_config,
                              "Check the configuration, print every error, and end");
  auto* print = app->add_flag("--print-config", options->print_config,
                              "Print the configuration in effect, explained, and end");
  auto* calibrate = app->add_flag(
      "--calibrate", options->calibrate,
      "Measure work_units_per_us on this machine, print the line for the configuration, and end");
  auto* reload =
      app->add_option("--reload", options->reload,
                      "Let the service of this process read its configuration anew, and "
                      "open its log file anew; end when it has (within 60 s), with 78 if "
                      "it refuses")
          ->type_name("PID")
          ->check(CLI::Range(2, std::numeric_limits<std::int32_t>::max(), "PID"));
  app->set_version_flag("--version", std::string("collisiond ") + Version(),
                        "Print the version and end");
  auto* world =
      app->add_option("--world", options->world,
                      "World, instead of the configured one; default: COLLISION_WORLD, if set")
          ->check(AllowedBy("world"));
  auto* domain =
      app->add_option(
             "--domain", options->domain,
             "DDS domain, instead of the configured one; default: COLLISION_DOMAIN, if set")
          ->check(AllowedBy("domain"));
  app->add_option("--credentials", options->credentials,
                  "Folder of the service's credentials, instead of the configured one; default: "
                  "COLLISION_CREDENTIALS, if set")
      ->type_name("DIR")
      ->check(AllowedBy("credentials_dir"));
  app->add_option("--log-level", options->log_level, "Log level, instead of the configured one")
      ->check(AllowedBy("log_level"));
  auto* record = app->add_option("--record", options->record_file,
                                 "Write every input to FILE; a former FILE is kept as FILE.1, "
                                 "up to FILE.3");
  auto* replay = DefineReplay(app, options);
  for (auto* file : {config, record, replay}) file->type_name("FILE")->check(NotEmpty());
  check->needs(config)->excludes(print);
  for (auto* other : {config, check, print, world, domain, record}) replay->excludes(other);
  for (auto* other : {check, print}) record->excludes(other);
  for (auto* other : {config, check, print, world, domain, record, replay})
    calibrate->excludes(other);
  for (auto* other : {config, check, print, world, domain, record, replay, calibrate})
    reload->excludes(other);
}

/// A variable that is set and not empty, if the configuration allows it as this field.
std::optional<std::string> Variable(const char* name, const char* field) {
  const char* value = std::getenv(name);
  if (value == nullptr || *value == '\0') return std::nullopt;
  std::string text = value;
  const std::string error = AllowedBy(field)(text);
  if (!error.empty()) throw CLI::ValidationError(name, error);
  return text;
}

/// The same for the programs of simulators and monitors, so that one setting is for all.
void TakeEnvironment(Options* options) {
  if (options->calibrate || options->reload || !options->replay_file.empty()) return;
  if (!options->world) options->world = Variable("COLLISION_WORLD", "world");
  if (!options->credentials) {
    options->credentials = Variable(credentials::kVariable, "credentials_dir");
  }
  const auto domain = options->domain ? std::nullopt : Variable("COLLISION_DOMAIN", "domain");
  if (domain) options->domain = static_cast<std::uint32_t>(std::stoul(*domain));
}

}  // namespace

OptionsResult ParseOptions(int argc, const char* const* argv) {
  OptionsResult result;
  Options options;
  CLI::App app(kDescription, "collisiond");
  app.footer(kFooter);
  Define(&app, &options);
  try {
    app.parse(argc, argv);
    TakeEnvironment(&options);
    result.options = options;
  } catch (const CLI::ParseError& error) {
    std::ostringstream output, errors;
    result.exit_code = app.exit(error, output, errors) == 0 ? kExitOk : kExitUsage;
    result.output = output.str();
    result.error = errors.str();
  }
  return result;
}

}  // namespace collision::server
