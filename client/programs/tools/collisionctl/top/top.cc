#include "client/programs/tools/collisionctl/top/top.h"

#include <algorithm>
#include <iostream>
#include <optional>

#include "client/programs/shared/terminal.h"
#include "client/programs/tools/collisionctl/top/top_page.h"

namespace collision::client {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLookEvery{100};  // For a key, and Ctrl-C.
constexpr std::size_t kHeadLines = 3;                 // Verdict, world, heading of the table.

void Print(const TopOptions& options, const WorldView& view, const OpenEvents& events, bool alive) {
  if (options.json) {
    std::cout << TopJson(view, events, alive, options.rows) << std::endl;
    return;
  }
  for (const std::string& line : TopLines(view, events, alive, options.rows)) {
    std::cout << line << '\n';
  }
  if (!options.once) std::cout << '\n';
  std::cout.flush();
}

void Draw(const TopOptions& options, const WorldView& view, const OpenEvents& events, bool alive,
          Terminal* terminal) {
  const std::size_t height = terminal->size().rows;
  const std::size_t room = height > kHeadLines ? height - kHeadLines : 1;
  terminal->Draw(TopLines(view, events, alive, std::min(options.rows, room)));
}

}  // namespace

void RunTop(const TopOptions& options, MessageMonitor* monitor, WorldView* view,
            const std::function<bool()>& is_stopped) {
  std::optional<Terminal> terminal;
  if (HasTerminal() && !options.once && !options.json) terminal.emplace();
  OpenEvents events;
  events.Add(view->TakeEvents());
  Clock::time_point due = Clock::now();
  while (!is_stopped() && std::cout) {
    const auto now = Clock::now();
    if (now >= due) {
      due = now + options.period;
      const bool alive = monitor->service_alive();
      terminal ? Draw(options, *view, events, alive, &*terminal)
               : Print(options, *view, events, alive);
      if (options.once) return;
    }
    if (terminal && terminal->Read().find('q') != std::string::npos) return;
    monitor->Poll(std::min<std::chrono::nanoseconds>(kLookEvery, due - now));
    events.Add(view->TakeEvents());
  }
}

}  // namespace collision::client
