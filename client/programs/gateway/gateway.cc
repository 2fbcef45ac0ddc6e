#include "client/programs/gateway/gateway.h"

#include <algorithm>
#include <atomic>
#include <cctype>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>

#include "client/library/identity/library_version.h"
#include "client/library/network/dds_transport.h"
#include "client/library/notices/notices.h"
#include "client/programs/foxglove/foxglove_channels.h"
#include "client/programs/gateway/conversion.h"
#include "client/programs/gateway/foxglove_viewer.h"
#include "client/programs/gateway/metrics/world_metrics.h"
#include "client/programs/gateway/page_viewer.h"
#include "client/programs/gateway/site.h"
#include "client/programs/scene/page_items.h"
#include "client/programs/scene/past.h"
#include "client/programs/scene/scene.h"
#include "client/programs/shared/exit_code.h"
#include "client/programs/tools/collisionctl/agents_watcher.h"
#include "client/programs/tools/collisionctl/status/verdict.h"
#include "idl/limits.h"

namespace collision::gateway {
namespace {

using Time = std::chrono::steady_clock::time_point;

constexpr std::chrono::milliseconds kWaitMax{100};  ///< Longest time to notice the end.
constexpr std::chrono::seconds kStatusMax{11};      ///< A status that is older is none.
constexpr std::chrono::seconds kMetricsPeriod{1};   ///< A status comes twice as often.
constexpr std::chrono::seconds kWatchLonger{10};    ///< After the last viewer has left.
constexpr std::chrono::seconds kWatchAgain{10};     ///< After it could not be begun.

std::chrono::nanoseconds Seconds(double seconds) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
      std::chrono::duration<double>(seconds));
}

/// One line, of 16 to 256 printable characters without blanks.
std::string ReadToken(const std::string& file) {
  std::string token;
  std::getline(std::ifstream(file), token);
  const bool is_clean = std::ranges::all_of(token, [](char c) { return c > ' ' && c < 127; });
  if (token.size() < 16 || token.size() > 256 || !is_clean ||
      token.find_first_of(";,\"&") != std::string::npos) {
    throw client::BadInput("--token-file " + file +
                           ": allowed: one line of 16 to 256 printable characters without blanks "
                           "and ; , \" &");
  }
  return token;
}

bool IsLoopback(const std::string& address) {
  return address == "::1" || address.starts_with("127.");
}

/// As browsers write it.
std::string HostOf(const std::string& address) {
  return address.find(':') == std::string::npos ? address : "[" + address + "]";
}

/// Where the page is: beside the program, as it is installed or was built.
std::string PageFolder(const GatewayOptions& options) {
  if (!options.page.empty()) return options.page;
  std::error_code failed;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", failed);
  return (program.parent_path().parent_path() / "share" / "collision-gateway" / "page").string();
}

/// Null, and a line that says so, where it is not there and nobody has named one.
std::unique_ptr<const PageFiles> ReadPage(const GatewayOptions& options) {
  const std::string folder = PageFolder(options);
  try {
    return std::make_unique<const PageFiles>(folder);
  } catch (const std::runtime_error& error) {
    if (!options.page.empty()) throw client::BadInput("--page " + std::string(error.what()));
    std::cerr << "collision-gateway: without the page: " << error.what() << '\n';
    return nullptr;
  }
}

/// A viewer that is counted.
class CountedViewer final : public WebViewer {
 public:
  CountedViewer(std::unique_ptr<WebViewer> viewer, std::atomic<int>* count)
      : viewer_(std::move(viewer)), count_(*count) {
    ++count_;
  }
  ~CountedViewer() override { --count_; }
  CountedViewer(const CountedViewer&) = delete;
  CountedViewer& operator=(const CountedViewer&) = delete;

  std::optional<WebMessage> Next() override { return viewer_->Next(); }
  std::string Hear(const std::string& message, bool is_text) override {
    return viewer_->Hear(message, is_text);
  }

 private:
  const std::unique_ptr<WebViewer> viewer_;
  std::atomic<int>& count_;
};

/// All of it, in the order in which it is made.
class Gateway {
 public:
  explicit Gateway(const GatewayOptions& options)
      : options_(options),
        page_(ReadPage(options)),
        foxglove_(FoxgloveServerOf(options)),
        site_(page_.get(), &shapes_, &past_),
        scene_(&shapes_),
        items_(&board_),
        monitor_(MonitorOptionsOf(options), scene_.Callbacks()),
        server_(WebOptionsOf(options), Handlers()) {}

  ~Gateway() { conversion_.Stop(); }  // while there is a server to answer
  Gateway(const Gateway&) = delete;
  Gateway& operator=(const Gateway&) = delete;

  std::uint16_t port() const { return server_.port(); }

  void Run(const std::function<bool()>& stopped) {
    const auto period = Seconds(1 / options_.rate_hz);
    Time due = std::chrono::steady_clock::now();
    while (!stopped()) {
      const Time now = std::chrono::steady_clock::now();
      if (now >= due) {
        due = now + period;
        ShowWhatIsNew(now);
      }
      Watch(now);
      monitor_.Poll(std::min<std::chrono::nanoseconds>(kWaitMax, due - now));
    }
  }

 private:
  static client::MonitorOptions MonitorOptionsOf(const GatewayOptions& options) {
    client::MonitorOptions all = options.monitor;
    all.simulators = true;
    return all;
  }

  static WebOptions WebOptionsOf(const GatewayOptions& options) {
    WebOptions web = options.web;
    if (!options.token_file.empty()) web.token = ReadToken(options.token_file);
    if (web.token.empty() && !IsLoopback(web.address)) {
      throw client::BadInput("--address " + web.address +
                             ": whoever reaches it could look: give it a --token-file, or stay on "
                             "127.0.0.1 and let a reverse proxy ask who it is");
    }
    for (std::string& host : web.hosts) {
      std::ranges::transform(host, host.begin(), [](unsigned char c) { return std::tolower(c); });
    }
    // By an address no other page can call it.
    if (web.address != "0.0.0.0" && web.address != "::") web.hosts.push_back(HostOf(web.address));
    return web;
  }

  WebHandlers Handlers() {
    return {.answer = [this](const WebRequest& request) { return site_.Answer(request); },
            .upload_path = "/convert",
            .upload =
                [this](WebRequest request, WebReply reply) {
                  conversion_.Start(std::move(request.body), std::move(reply));
                },
            .protocols = {kPageProtocol, kFoxgloveProtocol, kFoxgloveOldProtocol},
            .connect = [this](const std::string& protocol) -> std::unique_ptr<WebViewer> {
              return std::make_unique<CountedViewer>(ViewerOf(protocol), &viewers_);
            }};
  }

  std::unique_ptr<WebViewer> ViewerOf(const std::string& protocol) {
    if (protocol == kPageProtocol) return std::make_unique<PageViewer>(&board_);
    return std::make_unique<FoxgloveViewer>(&channels_, foxglove_);
  }

  /// Two runs at the same place differ by when they began.
  static FoxgloveServer FoxgloveServerOf(const GatewayOptions& options) {
    const auto begun = std::chrono::system_clock::now().time_since_epoch();
    return {.name = "collision-gateway: " + options.monitor.world,
            .world = options.monitor.world,
            .version = client::LibraryVersion(),
            .session_id = std::to_string(begun / std::chrono::nanoseconds(1))};
  }

  void ShowWhatIsNew(Time now) {
    const bool alive = monitor_.service_alive();
    const auto& status = scene_.view().status();
    if (status && (!alive || status->stamp().sequence() != status_sequence_)) {
      status_sequence_ = status->stamp().sequence();
      if (alive) status_heard_ = now;
    }
    const bool is_fresh = alive && status && now - status_heard_ < kStatusMax;
    site_.SetReadiness({.is_ready = is_fresh,
                        .text = is_fresh ? client::Verdict(scene_.view()).front()
                                : alive  ? "no status of the service has come for a while: it hangs"
                                         : "no service of this world is heard"});
    const client::SceneChanges changes = scene_.TakeChanges();
    const bool is_new = items_.Put(scene_, changes,
                                   {.service_alive = alive,
                                    .contacts_missed = monitor_.contacts_missed(),
                                    .unreadable = monitor_.unreadable()});
    if (channels_.Put(scene_, changes, alive) || is_new) server_.Wake();
    past_.Keep(scene_.states(), scene_.now_ns());
    if (now < metrics_due_ && is_fresh == was_fresh_) return;
    was_fresh_ = is_fresh;
    metrics_due_ = now + kMetricsPeriod;
    items_.Beat();
    server_.Wake();
    site_.SetMetrics(
        MakePayload(WorldMetrics(scene_.view(), {.world = options_.monitor.world,
                                                 .version = client::LibraryVersion(),
                                                 .service_up = is_fresh,
                                                 .viewers = viewers_,
                                                 .contacts_missed = monitor_.contacts_missed()})));
  }

  /// While somebody looks, states are fresh. A page that is loaded anew was away for a moment.
  void Watch(Time now) {
    if (!options_.watch) return;
    if (viewers_ > 0) looked_ = now;
    if (!looked_ || now - *looked_ > kWatchLonger) return watcher_.reset();
    if (!watcher_ && now >= watch_due_) StartWatch(now);
    if (watcher_) watcher_->Repeat(now);
  }

  /// Without it the page shows what simulators send anyway.
  void StartWatch(Time now) {
    const client::Place place{options_.monitor.world, options_.monitor.domain,
                              options_.monitor.credentials};
    const std::int64_t period_ns = std::clamp(Seconds(1 / options_.rate_hz).count(),
                                              wire::kWatchPeriodMin, wire::kWatchPeriodMax);
    try {
      watcher_ = std::make_unique<client::AgentsWatcher>(client::ConnectWatcher(place),
                                                         std::chrono::nanoseconds(period_ns));
    } catch (const std::runtime_error& error) {
      std::cerr << "collision-gateway: simulators are not asked for fresh states: " << error.what()
                << '\n';
      watch_due_ = now + kWatchAgain;
    }
  }

  const GatewayOptions& options_;
  const std::unique_ptr<const PageFiles> page_;
  const FoxgloveServer foxglove_;
  client::Board board_;
  client::ShapeStore shapes_;
  client::Past past_;
  Site site_;
  std::atomic<int> viewers_ = 0;
  client::Scene scene_;
  client::PageItems items_;
  client::FoxgloveChannels channels_;
  client::MessageMonitor monitor_;
  std::unique_ptr<client::AgentsWatcher> watcher_;
  std::uint64_t status_sequence_ = 0;
  bool was_fresh_ = false;  ///< In the metrics.
  Time status_heard_{}, metrics_due_{}, watch_due_{};
  std::optional<Time> looked_;  ///< When a viewer was there last.
  Conversion conversion_;
  WebServer server_;  // last: what it asks is there
};

}  // namespace

int RunGateway(const GatewayOptions& options, const std::function<bool()>& stopped) {
  std::cerr << "collision-gateway: "
            << client::PlaceText(options.monitor.world, options.monitor.domain) << '\n';
  Gateway gateway(options);
  const bool is_any = options.web.address == "0.0.0.0" || options.web.address == "::";
  std::cout << "http://" << (is_any ? "localhost" : HostOf(options.web.address)) << ":"
            << gateway.port() << "/" << std::endl;
  gateway.Run(stopped);
  return client::kExitOk;
}

}  // namespace collision::gateway
