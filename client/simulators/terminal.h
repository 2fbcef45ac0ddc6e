// A terminal as an instrument panel: keys come at once, pictures are drawn in place.
#pragma once

#include <string>
#include <vector>

namespace collision::client {

struct TerminalSize {
  std::size_t columns = 80;
  std::size_t rows = 24;
};

/// Is there a person: standard input and output are the terminal that this program is in the
/// foreground of?
bool HasTerminal();

/// From the constructor to the destructor the terminal is in raw mode with a screen of its own;
/// Ctrl-C still interrupts, Ctrl-Z does not stop. A signal that ends the program restores it as
/// well (only SIGKILL cannot be caught). One at a time.
class Terminal {
 public:
  /// Throws std::runtime_error if there is no terminal.
  Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  ~Terminal();

  /// What has been typed since the last call; does not wait.
  std::string Read();

  /// As it is now: it may be resized at any time.
  TerminalSize size() const;

  /// Draws the lines from the top, each cut to the width; what was there before goes.
  void Draw(const std::vector<std::string>& lines);
};

}  // namespace collision::client
