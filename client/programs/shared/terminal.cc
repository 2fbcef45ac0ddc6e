#include "client/programs/shared/terminal.h"

#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <stdexcept>

namespace collision::client {
namespace {

constexpr char kEnter[] = "\033[?1049h\033[?25l\033[2J";  // other screen, no cursor, empty
constexpr char kLeave[] = "\033[?25h\033[?1049l";

// Signals that end the program at once. The simulator handles SIGINT and SIGTERM itself and ends in
// order.
constexpr int kEnding[] = {SIGHUP, SIGQUIT, SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL};

// Outside the class, because a signal handler has no object.
termios original;
volatile std::sig_atomic_t raw = 0;

void Write(const char* text, std::size_t length) {
  while (length > 0) {
    const ssize_t written = write(STDOUT_FILENO, text, length);
    if (written <= 0) return;
    text += written;
    length -= static_cast<std::size_t>(written);
  }
}

// Only calls that are safe in a signal handler.
void Restore() {
  if (raw == 0) return;
  raw = 0;
  Write(kLeave, sizeof kLeave - 1);
  tcsetattr(STDIN_FILENO, TCSANOW, &original);
}

void RestoreAndEnd(int signal) {
  Restore();
  std::signal(signal, SIG_DFL);
  raise(signal);
}

}  // namespace

bool HasTerminal() {
  return isatty(STDIN_FILENO) != 0 && isatty(STDOUT_FILENO) != 0 &&
         tcgetpgrp(STDIN_FILENO) == getpgrp();
}

std::string Cut(const std::string& text, std::size_t columns) {
  std::size_t at = 0;
  for (std::size_t shown = 0; at < text.size(); ++at) {
    const bool begins = (static_cast<unsigned char>(text[at]) & 0xc0) != 0x80;
    if (begins && shown++ == columns) break;
  }
  return text.substr(0, at);
}

Terminal::Terminal() {
  if (!HasTerminal() || tcgetattr(STDIN_FILENO, &original) != 0) {
    throw std::runtime_error("standard input and output are not a terminal");
  }
  termios settings = original;
  settings.c_lflag &= static_cast<tcflag_t>(~(ICANON | ECHO));
  settings.c_cc[VMIN] = 0;
  settings.c_cc[VTIME] = 0;
  settings.c_cc[VSUSP] = _POSIX_VDISABLE;
  raw = 1;
  for (const int signal : kEnding) std::signal(signal, RestoreAndEnd);
  tcsetattr(STDIN_FILENO, TCSANOW, &settings);
  Write(kEnter, sizeof kEnter - 1);
}

Terminal::~Terminal() {
  Restore();
  for (const int signal : kEnding) std::signal(signal, SIG_DFL);
}

std::string Terminal::Read() {
  char typed[256];
  const ssize_t count = read(STDIN_FILENO, typed, sizeof typed);
  return count > 0 ? std::string(typed, static_cast<std::size_t>(count)) : std::string();
}

TerminalSize Terminal::size() const {
  winsize window{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) != 0 || window.ws_col == 0 || window.ws_row == 0) {
    return {};
  }
  return {window.ws_col, window.ws_row};
}

void Terminal::Draw(const std::vector<std::string>& lines) {
  const TerminalSize now = size();
  std::string picture = "\033[H";
  for (std::size_t i = 0; i < lines.size() && i < now.rows; ++i) {
    if (i > 0) picture += "\r\n";
    // Clear before writing: after the last column, clearing would erase that column.
    picture += "\033[K" + Cut(lines[i], now.columns);
  }
  if (lines.size() < now.rows) picture += "\r\n\033[J";
  Write(picture.data(), picture.size());
}

}  // namespace collision::client
