#include "client/programs/scene_runner/runner.h"

#include <google/protobuf/text_format.h>
#include <google/protobuf/util/json_util.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "client/programs/shared/stop_signal.h"
#include "client/programs/shared/terminal.h"
#include "collision/event_text.h"

namespace collision::client {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

// Without any progress of the service's time: as long as a simulator waits for a grant.
constexpr std::chrono::seconds kStuck{120};
constexpr std::chrono::nanoseconds kRealTimeLead{
    3'000'000'000};                             // until all programs have discovered each other
constexpr std::int64_t kTransit = 200'000'000;  // [ns] delay of samples, in real time
constexpr double kGrantAheadDefault = 10;       // [s] the service's default
constexpr double kPersonSeconds = 300;  // a person's flight lasts at most this long by default
constexpr std::uint32_t kDomains = 200;
constexpr std::size_t kLinesShown = 12;

double SecondsSince(steady_clock::time_point start) {
  return std::chrono::duration<double>(steady_clock::now() - start).count();
}

std::string Text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

void WriteFile(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  file << text;
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

bool HasOption(const std::vector<std::string>& arguments, const std::string& option) {
  return std::find(arguments.begin(), arguments.end(), option) != arguments.end();
}

std::string MakeFolder(const std::string& wanted) {
  if (!wanted.empty()) {
    fs::create_directories(wanted);
    return wanted;
  }
  std::string name = (fs::temp_directory_path() / "collision-scene-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder can be made");
  return name;
}

}  // namespace

std::uint32_t OwnDomain() { return 1 + static_cast<std::uint32_t>(getpid()) % kDomains; }

Runner::Runner(const RunnerOptions& options)
    : options_(options),
      scene_(LoadScene(options.folders, options.scene)),
      world_(options.world.empty() ? options.scene + "-" + std::to_string(getpid())
                                   : options.world),
      domain_(options.domain.value_or(OwnDomain())),
      folder_(MakeFolder(options.logs)) {
  const auto& processes = scene_.processes();
  const bool person =
      HasTerminal() && std::any_of(processes.begin(), processes.end(),
                                   [](const auto& process) { return process.terminal(); });
  if (person) scene_.set_seconds(kPersonSeconds);
  if (options.seconds > 0) scene_.set_seconds(options.seconds);
  ChangeConfig(options.config, &scene_);
}

Runner::~Runner() {
  simulators_.clear();
  service_.reset();
  std::error_code ignored;
  if (options_.logs.empty()) fs::remove_all(folder_, ignored);
}

std::string Runner::Path(const std::string& file) const {
  return (fs::path(folder_) / file).string();
}

void UseLoopback(const Folders& folders) {
  const fs::path profile = fs::absolute(folders.scenes).parent_path() / "cyclonedds-loopback.xml";
  if (getenv("CYCLONEDDS_URI") != nullptr) return;
  if (!fs::exists(profile))
    throw std::runtime_error(profile.string() + ": the network profile does not exist");
  setenv("CYCLONEDDS_URI", ("file://" + profile.string()).c_str(), 1);
}

/// By the command that a user would give.
void Runner::MakeCredentials() const {
  std::vector<std::string> arguments = {(fs::path(options_.folders.bin) / "collisionctl").string(),
                                        "make-certificates",
                                        Path("credentials"),
                                        "--world",
                                        world_,
                                        "--domain",
                                        std::to_string(domain_),
                                        "--service",
                                        "--monitor",
                                        "observer"};
  for (const v1::SceneProcess& process : scene_.processes()) {
    arguments.insert(arguments.end(), {"--simulator", process.name()});
  }
  ChildProcess making("make-certificates", arguments, Path("make-certificates.log"));
  making.Finish(steady_clock::now() + kGrace);
  if (making.succeeded()) return;
  throw std::runtime_error("no credentials (" + making.Ending() + "):\n" +
                           making.LastLines(kLinesShown));
}

std::string Runner::CredentialsOf(const std::string& program) const {
  return options_.secure ? Path("credentials/" + program) : "";
}

void Runner::AddCredentials(const std::string& of, std::vector<std::string>* arguments) const {
  if (options_.secure) arguments->insert(arguments->end(), {"--credentials", CredentialsOf(of)});
}

void Runner::StartService() {
  v1::Config config = scene_.config();
  config.set_world(world_);
  config.set_domain(domain_);
  if (options_.real_time) config.mutable_clock()->set_kind(v1::Clock::REAL_TIME);
  std::string text;
  google::protobuf::TextFormat::PrintToString(config, &text);
  WriteFile(Path("collisiond.textproto"), text);
  std::vector<std::string> arguments = {(fs::path(options_.folders.bin) / "collisiond").string(),
                                        "--config",
                                        Path("collisiond.textproto"),
                                        "--world",
                                        world_,
                                        "--domain",
                                        std::to_string(domain_)};
  if (!options_.record.empty()) {
    arguments.insert(arguments.end(), {"--record", fs::absolute(options_.record).string()});
  }
  AddCredentials("service", &arguments);
  service_ = std::make_unique<ChildProcess>("collisiond", arguments, Path("collisiond.log"));
}

void Runner::StartSimulator(const v1::SceneProcess& process) {
  const std::map<std::string, std::string> values = {{"SECONDS", Text(scene_.seconds())},
                                                     {"SCENES", options_.folders.scenes},
                                                     {"DATA", options_.folders.data},
                                                     {"LOG", Path(process.name() + ".motion")}};
  std::vector<std::string> arguments = {
      (fs::path(options_.folders.bin) / process.program()).string()};
  for (const std::string& argument : process.arguments())
    arguments.push_back(Substitute(argument, values));
  for (const std::string& argument :
       {std::string("--world"), world_, std::string("--domain"), std::to_string(domain_),
        std::string("--simulator"), process.name(), std::string("--linger"),
        std::string("--traffic"), Path(process.name() + ".traffic")}) {
    arguments.push_back(argument);
  }
  AddCredentials("simulator-" + process.name(), &arguments);
  std::istringstream more(options_.arguments);
  for (std::string argument; more >> argument;) arguments.push_back(argument);
  if (options_.stream && !HasOption(arguments, "--stream")) arguments.push_back("--stream");
  if (options_.real_time) {
    arguments.insert(arguments.end(), {"--real-time", "--start-ns", std::to_string(start_ns_)});
  } else {
    arguments.push_back("--lock-step");
  }
  const bool person = process.terminal() && HasTerminal();
  if (person) observer_->SetQuiet(true);
  simulators_.push_back(
      std::make_unique<ChildProcess>(process.name(), arguments, Path(process.name() + ".log"),
                                     person ? Streams::kTerminal : Streams::kFile));
  if (person) person_ = simulators_.back().get();
}

bool Runner::AllRunning() {
  std::vector<ChildProcess*> processes = {service_.get()};
  for (const auto& simulator : simulators_) processes.push_back(simulator.get());
  for (ChildProcess* process : processes) {
    if (process->Running()) continue;
    TakeTerminal();
    std::fprintf(stderr, "%s ended before the end of the scene (%s):\n%s", process->name().c_str(),
                 process->Ending().c_str(), process->LastLines(kLinesShown).c_str());
    return false;
  }
  return true;
}

std::int64_t Runner::EndTime() const {
  return left_ns_.value_or(start_ns_ + std::llround(scene_.seconds() * 1e9));
}

bool Runner::PersonLeft() {
  return person_ != nullptr && !person_->Running() && person_->succeeded() && !StopRequested();
}

// Called before printing: text on the person's screen would disappear with it.
void Runner::TakeTerminal() {
  if (person_ == nullptr) return;
  person_->Terminate();
  person_->Finish(steady_clock::now() + kGrace);
}

Runner::Watch Runner::WatchToEnd() {
  auto progress = steady_clock::now();
  std::optional<std::int64_t> reached;
  while (!StopRequested()) {
    observer_->Poll(milliseconds(20));
    if (observer_->now_ns() != reached) progress = steady_clock::now();
    reached = observer_->now_ns();
    if (reached && *reached >= EndTime()) return Watch::kEnded;
    if (PersonLeft()) {
      left_ns_ = reached.value_or(start_ns_);
      return Watch::kLeft;
    }
    if (!AllRunning()) return Watch::kFailed;
    if (steady_clock::now() - progress < kStuck) continue;
    TakeTerminal();
    std::fprintf(stderr, "the service's time has not advanced for %lld s:\n%s",
                 static_cast<long long>(kStuck.count()), service_->LastLines(kLinesShown).c_str());
    return Watch::kFailed;
  }
  return Watch::kInterrupted;
}

void Runner::Drain(milliseconds quiet, milliseconds longest) {
  const auto deadline = steady_clock::now() + longest;
  auto last_event = steady_clock::now();
  std::size_t events = observer_->observations().events.size();
  while (steady_clock::now() < deadline && steady_clock::now() - last_event < quiet) {
    observer_->Poll(milliseconds(20));
    if (observer_->observations().events.size() == events) continue;
    events = observer_->observations().events.size();
    last_event = steady_clock::now();
  }
}

void Runner::StopSimulators() {
  for (const auto& simulator : simulators_) simulator->Terminate();
  const auto deadline = steady_clock::now() + kGrace;
  for (const auto& simulator : simulators_) simulator->Finish(deadline);
}

// A simulator that was killed has written no file.
void Runner::ReadTraffic(Measured* measured) const {
  for (const v1::SceneProcess& process : scene_.processes()) {
    std::ifstream file(Path(process.name() + ".traffic"));
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    v1::SimulatorTraffic traffic;
    if (!text.empty() && google::protobuf::TextFormat::ParseFromString(text, &traffic)) {
      measured->traffic.push_back(traffic);
    }
  }
}

RunResult Runner::Judge(const Measured& measured) {
  std::vector<checker::AgentMotion> motions;
  for (const v1::SceneProcess& process : scene_.processes()) {
    std::ifstream log(Path(process.name() + ".motion"));
    if (!log) throw std::runtime_error(process.name() + " wrote no motion log");
    auto more = checker::ReadMotionLog(log, process.name());
    std::move(more.begin(), more.end(), std::back_inserter(motions));
  }
  const double ahead = scene_.config().clock().has_grant_ahead_max_s()
                           ? scene_.config().clock().grant_ahead_max_s()
                           : kGrantAheadDefault;
  const checker::RunFacts facts{start_ns_, EndTime(), std::llround(ahead * 1e9),
                                options_.real_time ? kTransit : 0, scene_.config()};
  const checker::Evidence evidence(std::move(motions), observer_->observations(), facts);
  checker::Violations violations = checker::Check(evidence, scene_.expectation());
  for (std::string& failure : Failures()) violations.push_back(std::move(failure));
  const v1::RunReport report = MakeReport(options_.scene, evidence, violations, measured);
  std::printf("%s", SummaryTable(report, evidence).c_str());
  std::fflush(stdout);
  if (!options_.json.empty()) {
    std::string json;
    google::protobuf::util::JsonPrintOptions json_options;
    json_options.add_whitespace = true;
    json_options.always_print_primitive_fields = true;
    json_options.preserve_proto_field_names = true;
    if (!google::protobuf::util::MessageToJsonString(report, &json, json_options).ok()) {
      throw std::runtime_error("the report cannot be written as JSON");
    }
    WriteFile(options_.json, json);
  }
  return Conclude(violations, "satisfied");
}

checker::Violations Runner::Failures() const {
  checker::Violations failures;
  for (const auto& simulator : simulators_) {
    if (!simulator->succeeded())
      failures.push_back(simulator->name() + " ended with " + simulator->Ending());
  }
  if (!service_->succeeded()) failures.push_back("collisiond ended with " + service_->Ending());
  for (const std::string& rejection : observer_->rejections()) {
    failures.push_back("the service refused a sample: " + rejection);
  }
  return failures;
}

RunResult Runner::Conclude(const checker::Violations& violations, const char* satisfied) const {
  for (const std::string& violation : violations) std::printf("violation: %s\n", violation.c_str());
  std::printf("checker: %s\n", violations.empty() ? satisfied : "NOT satisfied");
  return violations.empty() ? kSatisfied : kNotSatisfied;
}

RunResult Runner::Run() {
  UseLoopback(options_.folders);
  std::printf("%s: %s\n", options_.scene.c_str(), scene_.title().c_str());
  std::fflush(stdout);
  if (options_.real_time) {
    const auto now = std::chrono::system_clock::now().time_since_epoch() + kRealTimeLead;
    start_ns_ = std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
    std::printf("starting at %s\n", InstantText(start_ns_, 0, 3).c_str());
    std::fflush(stdout);
  }
  const auto started = steady_clock::now();
  if (options_.secure) MakeCredentials();
  observer_ =
      std::make_unique<Observer>(ObserverOptions{.world = world_,
                                                 .domain = domain_,
                                                 .origin_ns = start_ns_,
                                                 .end_ns = EndTime(),
                                                 .real_time = options_.real_time,
                                                 .credentials = CredentialsOf("monitor-observer"),
                                                 .every_event = options_.every_event});
  StartService();
  for (const v1::SceneProcess& process : scene_.processes()) StartSimulator(process);
  const Watch watch = WatchToEnd();
  // The flight ends with the ship.
  if (watch == Watch::kLeft) StopSimulators();
  if (watch == Watch::kInterrupted) {
    TakeTerminal();
    std::printf("\ninterrupted: ending everything\n");
  }
  if (watch == Watch::kEnded) Drain(milliseconds(200), milliseconds(500));
  Measured measured;
  measured.wall_seconds = SecondsSince(started);
  StopSimulators();
  if (watch == Watch::kEnded || watch == Watch::kLeft) Drain(milliseconds(200), milliseconds(500));
  service_->Terminate();
  service_->Finish(steady_clock::now() + kGrace);
  observer_->SetQuiet(false);
  observer_->FinishProgress();
  if (watch == Watch::kInterrupted) return kInterrupted;
  if (watch == Watch::kFailed) return kNotSatisfied;
  measured.simulated_seconds = static_cast<double>(EndTime() - start_ns_) * 1e-9;
  measured.service_cpu_seconds = service_->cpu_seconds();
  measured.latencies = observer_->latencies();
  measured.running_seconds = observer_->running_seconds();
  ReadTraffic(&measured);
  return options_.unjudged ? Conclude(Failures(), "not asked") : Judge(measured);
}

}  // namespace collision::client
