// Words and numbers of text formats.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

namespace collision::client {

/// Cuts a text into words between blanks, counting lines.
class Words {
 public:
  /// `line`: the number of its first line, for messages.
  explicit Words(std::string_view text, std::size_t line = 1) : text_(text), line_(line) {}

  /// Empty at the end.
  std::string_view Next() {
    while (at_ < text_.size() && IsBlank(text_[at_])) Step();
    const std::size_t first = at_;
    while (at_ < text_.size() && !IsBlank(text_[at_])) ++at_;
    return text_.substr(first, at_ - first);
  }

  /// Goes to the end of the line.
  void SkipLine() {
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  }

  std::size_t line() const { return line_; }

  /// Throws with the line of the last word.
  [[noreturn]] void Fail(const std::string& cause) const {
    throw std::runtime_error("line " + std::to_string(line_) + ": " + cause);
  }

 private:
  static bool IsBlank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v';
  }
  void Step() { line_ += text_[at_++] == '\n' ? 1 : 0; }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_;
};

/// The whole word as a number, also "inf" and "nan"; nullopt if it is not a number. A number beyond
/// the range of a double is infinite, one below it 0.
template <typename Number>
std::optional<Number> NumberOf(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  Number number{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (end != word.data() + word.size() || word.empty()) return std::nullopt;
  if (error == std::errc()) return number;
  if constexpr (std::is_floating_point_v<Number>) {
    return std::strtod(std::string(word).c_str(), nullptr);
  }
  return std::nullopt;
}

/// A word for a message: short and printable.
inline std::string Quoted(std::string_view word) {
  std::string text = "\"";
  for (const char c : word.substr(0, 40)) text += c < 0x20 || c == 0x7f ? '?' : c;
  return text + (word.size() > 40 ? "..." : "") + "\"";
}

/// Throws unless the word is a finite number.
inline void RequireFinite(const Words& words, std::string_view word) {
  const auto number = NumberOf<double>(word);
  if (number && std::isfinite(*number)) return;
  words.Fail("a vertex's coordinate: " + Quoted(word) + ", allowed: a finite number");
}

}  // namespace collision::client
