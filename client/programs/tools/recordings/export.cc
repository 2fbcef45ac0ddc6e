#include "client/programs/tools/recordings/export.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "client/library/network/conversion.h"
#include "client/programs/recordings/heard_first.h"
#include "client/programs/recordings/page_stream.h"
#include "client/programs/recordings/replayed_world.h"
#include "client/programs/recordings/single_page.h"
#include "client/programs/shared/command_line.h"
#include "client/programs/shared/exit_code.h"
#include "client/programs/shared/forecast_slots.h"
#include "client/programs/tools/recordings/event_search.h"
#include "client/programs/tools/recordings/replay_options.h"

namespace collision::client {
namespace {

constexpr double kAroundSecondsMax = 86400;

constexpr const char* kExportFooter = R"(
The page needs no server and nothing from the network: it shows the event in 3D with its timeline,
the agents around it and their past, in any browser.

Examples:
  collisionctl export run.rec --html contact.html                    the first contact
  collisionctl export run.rec --html contact.html --around 7         that of number 7
  collisionctl export run.rec --html near.html --around ada,bob --before 120
)";

/// The world's time from `from` to `until` [ns].
struct Window {
  std::int64_t from_ns = 0, until_ns = 0;
};

std::int64_t Ns(double seconds) { return static_cast<std::int64_t>(1e9 * seconds); }

/// Of times that may be open ends.
std::int64_t Later(std::int64_t time_ns, double seconds) {
  std::int64_t sum = 0;
  if (!__builtin_add_overflow(time_ns, Ns(seconds), &sum)) return sum;
  return seconds > 0 ? std::numeric_limits<std::int64_t>::max()
                     : std::numeric_limits<std::int64_t>::min();
}

std::string ReadTemplate(const std::string& given) {
  std::string path = given;
  if (path.empty()) {
    std::error_code failed;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", failed);
    const auto share = program.parent_path().parent_path() / "share" / "collision-gateway";
    path = (share / "single.html").string();
  }
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (file && text) return std::move(text).str();
  throw std::runtime_error(path +
                           ": the page's template cannot be read; it comes with the package "
                           "collision-gateway, or name it by --template");
}

/// From the first pass.
struct Found {
  v1::CollisionEvent event;
  double radius_m = 0;  ///< Of the smallest agent; 0: it is not known.
  Window window;
};

double SmallestRadius(const WorldView& view) {
  double least = 0;
  for (const AgentView& agent : view.Agents()) {
    const double radius = agent.description.radius_m();
    if (radius > 0 && (least == 0 || radius < least)) least = radius;
  }
  return least;
}

/// What is rounded to it looks the same: a power of two below a part of the smallest agent.
double StepFor(double radius_m) {
  constexpr double kParts = 500;
  return radius_m > 0 ? std::exp2(std::floor(std::log2(radius_m / kParts))) : 0;
}

Found Find(const ExportOptions& options, const ReplayRequest& request) {
  EventSearch search(options.around);
  auto replayed = std::make_unique<ReplayedWorld>(request);
  ReplayedWorld& world = *replayed;
  WorldView view;
  MessageMonitor::Callbacks callbacks = view.Callbacks();
  callbacks.event = [&search, &view, keep = callbacks.event](const v1::CollisionEvent& event) {
    keep(event);
    search.Take(event, view);
  };
  MessageMonitor monitor(std::move(replayed), callbacks);
  while (!world.is_over() && !search.is_settled()) {
    monitor.Poll({});
    static_cast<void>(view.TakeEvents());
  }
  if (!search.found()) {
    if (world.Finish() != 0) {
      throw std::runtime_error("--around: no such event up to where the recording can be replayed");
    }
    const std::string contacts = search.Contacts();
    throw BadInput("--around: no such event in the recording" +
                   (contacts.empty() ? std::string("; there is no contact in it")
                                     : "; contacts in it, by their numbers:\n" + contacts));
  }
  const v1::CollisionEvent& event = *search.found();
  const std::int64_t begin = event.begin().earliest_ns();
  std::int64_t end = event.end().latest_ns();
  if (end == std::numeric_limits<std::int64_t>::max()) end = event.begin().latest_ns();
  if (end == std::numeric_limits<std::int64_t>::max()) end = std::max(begin, event.now_ns());
  return {.event = event,
          .radius_m = SmallestRadius(view),
          .window = {.from_ns = Later(begin, -options.before_s),
                     .until_ns = Later(end, options.after_s)}};
}

/// What the page is told of events: the newest of each, without those that came to nothing, and
/// those that were over before the window.
class EventItems {
 public:
  explicit EventItems(const Found& found) : wanted_(found.event), window_(found.window) {}

  /// Whether the item is about an event.
  bool Take(const Board::Item& item, const EventBook& book) {
    if (item.name.starts_with("gone/")) return true;
    if (!item.name.starts_with("event/")) return false;
    const EventBook::Entry& entry = book.At(std::stoull(item.name.substr(item.name.find('/') + 1)));
    if (IsWanted(entry.newest)) wanted_item_ = item.name;
    const bool is_shown = !entry.CameToNothing() && !WasOver(entry.newest);
    !is_shown ? static_cast<void>(newest_.erase(item.name))
              : static_cast<void>(newest_[item.name] = item.payload);
    return true;
  }

  std::string All() const {
    std::string all;
    for (const auto& [name, payload] : newest_) all += *payload;
    return all;
  }

  /// The name of the item of the wanted event; empty: there is none.
  const std::string& wanted_item() const { return wanted_item_; }

 private:
  bool WasOver(const v1::CollisionEvent& event) const {
    const bool is_open =
        event.status() == v1::EVENT_POSSIBLE || event.status() == v1::EVENT_CONFIRMED;
    return !is_open && event.now_ns() < window_.from_ns;
  }

  /// In another epoch the same two may meet as well.
  bool IsWanted(const v1::CollisionEvent& event) const {
    return KeyOf(event) == KeyOf(wanted_) &&
           event.stamp().service_id() == wanted_.stamp().service_id() &&
           event.stamp().epoch() == wanted_.stamp().epoch();
  }

  const v1::CollisionEvent wanted_;
  const Window window_;
  std::string wanted_item_;
  std::map<std::string, Payload> newest_;
};

/// The second pass: what the page is told from the begin of the window on.
class Collection {
 public:
  Collection(const ExportOptions& options, const Found& found)
      : step_(StepFor(found.radius_m)),
        window_(found.window),
        events_(found),
        times_(PeriodNs(options.rate_hz)) {}

  /// Requires that it outlives the stream.
  HeardFirst::HearFunction Hear(PageStream* const& stream) {
    return [this, &stream](const Arrivals& arrivals) {
      if (times_.AreStatesDue(arrivals)) Take(stream);
    };
  }

  /// What came since the last call. False: that was all.
  bool Follow(PageStream* stream) {
    const std::int64_t now_ns = stream->scene().now_ns();
    if (has_begun_ && (now_ns > window_.until_ns || stream->IsOver())) {
      if (!events_.wanted_item().empty()) return false;
      has_begun_ = false;  // these times were those of a former epoch
      messages_.clear();
    }
    if (now_ns < std::exchange(former_ns_, now_ns)) times_.BeginAnew();
    if (times_.IsDue(now_ns)) Take(stream);
    return true;
  }

  std::vector<std::string> Messages() && {
    messages_.insert(messages_.begin(), events_.All());
    return std::move(messages_);
  }

  /// Of the page.
  const std::string& event_key() const { return events_.wanted_item(); }

 private:
  void Take(PageStream* stream) {
    const std::int64_t now_ns = stream->scene().now_ns();
    times_.Taken(now_ns);
    if (!has_begun_ && now_ns >= window_.from_ns && now_ns <= window_.until_ns) {
      has_begun_ = true;
      stream->BeginAnew();
    }
    std::string message;
    for (const Board::Item& item : stream->TakeNew(step_)) {
      const bool is_of_event = events_.Take(item, stream->scene().events());
      if (has_begun_ && !is_of_event) message += *item.payload;
    }
    if (!message.empty()) messages_.push_back(std::move(message));
  }

  const double step_;
  const Window window_;
  EventItems events_;
  TakingTimes times_;
  std::vector<std::string> messages_;
  bool has_begun_ = false;
  std::int64_t former_ns_ = std::numeric_limits<std::int64_t>::min();
};

Collection Collect(const ExportOptions& options, const ReplayRequest& request, const Found& found) {
  Collection collection(options, found);
  auto replayed = std::make_unique<ReplayedWorld>(request);
  const ReplayedWorld& world = *replayed;
  PageStream* heard = nullptr;
  PageStream stream(std::make_unique<HeardFirst>(std::move(replayed), collection.Hear(heard)));
  heard = &stream;
  Progress progress("export");
  while (!world.is_over()) {
    stream.Poll({});
    progress.Tell(stream.scene().now_ns());
    if (!collection.Follow(&stream)) break;
  }
  return collection;
}

}  // namespace

CLI::App* AddExportCommand(CLI::App* app, ExportOptions* options) {
  CLI::App* command =
      app->add_subcommand("export", "An event of a recording as a page of one file, to send");
  AddReplayOptions(command, &options->input, &options->from, &options->until);
  command->add_option("--html", options->html, "The page; a former one is replaced")->required();
  command->add_option("--around", options->around,
                      "Of which event: the number of a contact, or two agents: ada,bob; default: "
                      "the first contact");
  for (const auto& [name, value, what] :
       {std::tuple("--before", &options->before_s, "Seconds before it begins, 0 to 86400"),
        std::tuple("--after", &options->after_s, "Seconds after it has ended, 0 to 86400")}) {
    command->add_option(name, *value, what)
        ->check(Between(0.0, kAroundSecondsMax))
        ->capture_default_str();
  }
  AddRateOption(command, "States of an agent, at most", &options->rate_hz);
  command->add_option("--template", options->page_template,
                      "The page without a world; default: that of collision-gateway");
  command->footer(kExportFooter);
  return command;
}

int RunExport(const ExportOptions& options) {
  try {
    CheckOutput(options.html, options.input);
    const std::string page_template = ReadTemplate(options.page_template);
    const ReplayRequest request = ReplayOf(options.input, options.from, options.until);
    const Found found = Find(options, request);
    Collection collected = Collect(options, request, found);
    const SinglePageTitle title{.name = std::filesystem::path(options.input).filename().string(),
                                .event_key = collected.event_key()};
    const std::string page = SinglePage(page_template, title, std::move(collected).Messages());
    std::ofstream file(options.html, std::ios::binary | std::ios::trunc);
    if (!(file << page).flush())
      return FailWith(options.html + ": cannot be written", kExitOutputFailed);
    std::cout << options.html << ": " << page.size() << " bytes\n";
    return kExitOk;
  } catch (const BadInput& error) {
    return FailWith(error.what(), kExitUsage);
  } catch (const std::runtime_error& error) {
    return FailWith(error.what(), kExitNoInput);
  }
}

}  // namespace collision::client
