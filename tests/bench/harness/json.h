// Pieces of text for tables and for JSON.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace collision::bench {

/// One number of the JSON, or a text, or nothing.
struct Field {
  std::string name;
  std::string json;  ///< The value as it stands in the file.
};

/// Null: not measured, or no number.
Field Number(const std::string& name, std::optional<double> value);
Field Text(const std::string& name, const std::string& value);
Field List(const std::string& name, const std::vector<double>& values);

/// {"name": value, ...}
/// Throws std::logic_error where two have one name: no reader takes that.
std::string Object(const std::vector<Field>& fields);

/// One number in a format of printf.
std::string Format(const char* format, double value);
/// At least one space behind it.
std::string Padded(const std::string& text, std::size_t width);

/// "12.3 ms"
std::string SecondsText(double seconds);

/// The summary: names in a fixed order, each with a number or not measured.
class Figures {
 public:
  explicit Figures(const std::vector<std::string>& names);

  /// Names that are not known are left out; nullopt: not measured.
  void Set(const std::string& name, std::optional<double> value);

  std::optional<double> Get(const std::string& name) const;

  std::string Table() const;
  /// The file of all: {"figures": {...}, "measurements": [...]}, each measurement an object.
  std::string Json(const std::vector<std::string>& measurements) const;

 private:
  std::vector<std::pair<std::string, std::optional<double>>> figures_;
};

/// Writes the file of --json; without a path none. Exit status: 0, or 74 where it cannot be
/// written, which is said.
int WriteJson(const std::string& path, const std::string& json);

}  // namespace collision::bench
