// scene-runner: runs a scene of separate processes and judges it.

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "client/programs/scene_runner/runner.h"
#include "client/programs/scene_runner/view.h"
#include "client/programs/shared/command_line.h"
#include "client/programs/shared/stop_signal.h"

namespace collision::client {
namespace {

constexpr double kSecondsMax = 3600;

/// Checked before a run that may be long. Leaves no new file behind.
bool IsWritable(const std::string& path) {
  const bool was_there = std::filesystem::exists(path);
  const bool writable = std::ofstream(path, std::ios::app).is_open();
  std::error_code ignored;
  if (writable && !was_there) std::filesystem::remove(path, ignored);
  return writable;
}

/// What to do with the scenes, beside running one.
struct ViewOptions {
  bool list = false;
  bool in_browser = false;
  std::uint16_t port = 8787;
};

void AddOptions(CLI::App* app, RunnerOptions* options, ViewOptions* view) {
  app->add_option("scene", options->scene, "Name of the scene")->capture_default_str();
  app->add_flag("--list", view->list, "List the scenes");
  app->add_option("--seconds", options->seconds, "Simulated length; default: as the scene says")
      ->check(Finite(kSecondsMax, false));
  app->add_flag("--real-time", options->real_time, "In real time instead of lock-step");
  app->add_flag("--stream", options->stream,
                "Simulators send every state, not only those that the service needs: to compare");
  CLI::Option* secure = app->add_flag(
      "--secure", options->secure,
      "In a secured world: each program has credentials of its own, made for this run");
  app->add_option("--config", options->config,
                  "Fields that override the scene's service configuration, as protobuf text: "
                  "'time_budget_us: 100'");
  app->add_option("--arguments", options->arguments,
                  "Further options of every simulator: '--known-acceleration never'");
  app->add_flag("--every-event", options->every_event,
                "Print every possible, dismissed and withdrawn event");
  CLI::Option* json =
      app->add_option("--json", options->json, "Write the report (v1::RunReport) to this file");
  app->add_flag("--unjudged", options->unjudged,
                "Leave the checker out: only whether the programs ran to their end counts")
      ->excludes(json);
  app->add_flag(
         "--view", view->in_browser,
         "Show it in a browser: starts the gateway, prints its address, and runs the scene at "
         "the pace of the wall clock until Ctrl-C")
      ->excludes(json)
      ->excludes(secure);
  app->add_option("--port", view->port, "Port of the gateway, 0 to 65535; 0: any that is free")
      ->capture_default_str()
      ->check(WholeBetween(0, 65535))
      ->needs("--view");
  app->add_option("--record", options->record,
                  "Let the service write its recording to this file, for collisionctl convert, "
                  "export and plot, and collisiond --replay");
  app->add_option("--logs", options->logs,
                  "Keep configuration, logs and motion logs in this folder");
  app->add_option("--scenes", options->folders.scenes, "Folder of the scenes")
      ->capture_default_str();
  app->add_option("--data", options->folders.data, "Folder of the real data sets")
      ->capture_default_str();
  app->add_option("--bin", options->folders.bin, "Folder of the programs")->capture_default_str();
  app->add_option("--domain", options->domain, "DDS domain; default: depends on the process id")
      ->check(DomainRange());
}

}  // namespace
}  // namespace collision::client

int main(int argc, char** argv) {
  using namespace collision::client;
  RunnerOptions options;
  ViewOptions view;
  CLI::App app(
      "Runs a scene: collisiond, simulators and a monitor on loopback, judged by the checker.",
      "scene-runner");
  AddOptions(&app, &options, &view);
  if (const auto code = ParseCommandLine(&app, argc, argv)) return *code;
  if (!options.json.empty() && !IsWritable(options.json)) {
    std::fprintf(stderr, "scene-runner: --json: %s cannot be written\n", options.json.c_str());
    return kExitUsage;
  }
  CatchStopSignals();
  try {
    if (view.list) {
      std::printf("%s", ListScenes(options.folders).c_str());
      return kSatisfied;
    }
    if (view.in_browser) return ViewScene(options, view.port);
    return Runner(options).Run();
  } catch (const NoSuchScene& error) {
    std::fprintf(stderr, "scene-runner: %s\n", error.what());
    return kExitUsage;
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "scene-runner: %s\n", error.what());
    return kExitUsage;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "scene-runner: %s\n", error.what());
    return kNotSatisfied;
  }
}
