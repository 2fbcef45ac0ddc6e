// Goal:   the terminal is restored in whatever way the program ends.
// Method: children with a pseudo-terminal of their own, ended in every possible way.
#include "client/programs/shared/terminal.h"

#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>
#include <utmp.h>

#include <csignal>
#include <cstdlib>
#include <functional>

#include "client/programs/shared/stop_signal.h"

namespace collision::client {
namespace {

constexpr char kReady[] = "ready";
constexpr char kScreenLeft[] = "\033[?1049l";

// What the child does once it has drawn.
enum class Ending { kReturn, kThrow, kAbort, kWait };

[[noreturn]] void Child(Ending ending) {
  CatchStopSignals();
  try {
    Terminal terminal;
    terminal.Draw({kReady});
    if (ending == Ending::kThrow) throw std::runtime_error("on purpose");
    if (ending == Ending::kAbort) std::abort();
    while (ending == Ending::kWait) pause();
    std::string typed;
    while (ending == Ending::kReturn && typed.find('q') == std::string::npos) {
      typed += terminal.Read();
    }
  } catch (const std::runtime_error&) {
    _exit(3);
  }
  _exit(0);
}

struct Seen {
  std::string output;
  termios before{};
  termios during{};
  termios after{};
  int status = 0;
};

// Runs a child to its end; `when_ready` may type or kill.
Seen RunChild(Ending ending, const std::function<void(pid_t, int)>& when_ready) {
  Seen seen;
  int master = -1, slave = -1;
  EXPECT_EQ(openpty(&master, &slave, nullptr, nullptr, nullptr), 0);
  tcgetattr(slave, &seen.before);
  const pid_t child = fork();
  if (child == 0) {
    close(master);
    login_tty(dup(slave));
    Child(ending);
  }
  char bytes[512];
  while (seen.output.find(kReady) == std::string::npos) {
    const ssize_t count = read(master, bytes, sizeof bytes);
    if (count <= 0) break;
    seen.output.append(bytes, static_cast<std::size_t>(count));
  }
  tcgetattr(slave, &seen.during);
  when_ready(child, master);
  waitpid(child, &seen.status, 0);
  tcgetattr(slave, &seen.after);
  while (seen.output.find(kScreenLeft) == std::string::npos) {
    const ssize_t count = read(master, bytes, sizeof bytes);
    if (count <= 0) break;
    seen.output.append(bytes, static_cast<std::size_t>(count));
  }
  close(slave);
  close(master);
  return seen;
}

void ExpectRestored(const Seen& seen) {
  EXPECT_EQ(seen.after.c_lflag, seen.before.c_lflag);
  EXPECT_EQ(seen.after.c_cc[VSUSP], seen.before.c_cc[VSUSP]);
  EXPECT_EQ(seen.after.c_cc[VMIN], seen.before.c_cc[VMIN]);
  EXPECT_NE(seen.output.find(kScreenLeft), std::string::npos);
  EXPECT_NE(seen.output.find("\033[?25h"), std::string::npos) << "the cursor is back";
}

const auto kNothing = [](pid_t, int) {};

TEST(Terminal, KeysArriveAtOnceAndWithoutEcho) {
  const Seen seen =
      RunChild(Ending::kReturn, [](pid_t, int master) { EXPECT_EQ(write(master, "xq", 2), 2); });
  EXPECT_EQ(seen.during.c_lflag & (ICANON | ECHO), 0u);
  EXPECT_NE(seen.during.c_lflag & ISIG, 0u) << "Ctrl-C interrupts";
  EXPECT_EQ(seen.output.find('x'), std::string::npos);
  EXPECT_TRUE(WIFEXITED(seen.status) && WEXITSTATUS(seen.status) == 0);
  ExpectRestored(seen);
}

TEST(Terminal, IsRestoredByExceptions) {
  const Seen seen = RunChild(Ending::kThrow, kNothing);
  EXPECT_TRUE(WIFEXITED(seen.status) && WEXITSTATUS(seen.status) == 3);
  ExpectRestored(seen);
}

TEST(Terminal, IsRestoredByAbort) {
  const Seen seen = RunChild(Ending::kAbort, kNothing);
  EXPECT_TRUE(WIFSIGNALED(seen.status) && WTERMSIG(seen.status) == SIGABRT);
  ExpectRestored(seen);
}

TEST(Terminal, IsRestoredBySignalsThatStopInOrder) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const Seen seen = RunChild(Ending::kReturn, [signal](pid_t child, int master) {
      kill(child, signal);
      EXPECT_EQ(write(master, "q", 1), 1);
    });
    EXPECT_TRUE(WIFEXITED(seen.status)) << signal;
    ExpectRestored(seen);
  }
}

TEST(Terminal, IsRestoredBySignalsThatEndAtOnce) {
  for (const int signal : {SIGHUP, SIGQUIT, SIGSEGV, SIGBUS, SIGFPE, SIGILL}) {
    const Seen seen = RunChild(Ending::kWait, [signal](pid_t child, int) { kill(child, signal); });
    EXPECT_TRUE(WIFSIGNALED(seen.status) && WTERMSIG(seen.status) == signal) << signal;
    ExpectRestored(seen);
  }
}

TEST(Terminal, CutCountsCharacters) {
  EXPECT_EQ(Cut("a→bc", 2), "a→");
  EXPECT_EQ(Cut("a→bc", 9), "a→bc");
  EXPECT_EQ(Cut("→", 0), "");
}

}  // namespace
}  // namespace collision::client
