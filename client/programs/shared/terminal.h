// A terminal as an instrument panel: keys arrive at once, pictures are drawn in place.
#pragma once

#include <string>
#include <vector>

namespace collision::client {

struct TerminalSize {
  std::size_t columns = 80;
  std::size_t rows = 24;
};

/// Whether a person is there: standard input and output are a terminal, and this program is in its
/// foreground.
bool HasTerminal();

/// The first `columns` characters of UTF-8 text.
std::string Cut(const std::string& text, std::size_t columns);

/// From the constructor to the destructor the terminal is in raw mode with a screen of its own;
/// Ctrl-C still interrupts, Ctrl-Z does not stop. A signal that ends the program restores the
/// terminal as well (only SIGKILL cannot be caught). Only one may exist at a time.
class Terminal {
 public:
  /// Throws std::runtime_error if there is no terminal.
  Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  ~Terminal();

  /// What has been typed since the last call; does not wait.
  std::string Read();

  /// The current size: a terminal may be resized at any time.
  TerminalSize size() const;

  /// Draws the lines from the top, each cut to the width, in place of the last picture.
  void Draw(const std::vector<std::string>& lines);
};

}  // namespace collision::client
