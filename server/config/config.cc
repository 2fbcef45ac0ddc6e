#include "server/config/config.h"

#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/text_format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <system_error>

#include "server/config/config_options.h"

namespace collision::server {
namespace {

using google::protobuf::TextFormat;

/// More errors than a hand-written file has; a file of another kind stops here.
constexpr int kErrorsMax = 100;

/// By line, from 0; the first per line is the one that matters. Line -1: not from the text.
using ErrorsByLine = std::map<int, std::string>;

constexpr std::string_view kNameLetters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_";

/// The field name that a line begins with; empty if it begins with something else.
std::string FieldNameIn(const std::string& line) {
  const std::size_t begin = std::min(line.find_first_not_of(" \t"), line.size());
  const std::size_t end = std::min(line.find_first_not_of(kNameLetters, begin), line.size());
  return line.substr(begin, end - begin);
}

/// Protobuf quotes the token that it met, which may be anything, or the end of the text.
std::string Legible(std::string message) {
  if (message.ends_with("got: ")) message += "the end of the text";
  if (message.ends_with(".")) message.pop_back();
  for (char& c : message) {
    if (c < ' ' || c > '~') c = '?';
  }
  return message;
}

/// Where the first token of a line stands, as protobuf counts columns.
int FirstColumn(const std::string& line) {
  int column = 0;
  for (const char c : line) {
    if (c != ' ' && c != '\t') break;
    column += c == ' ' ? 1 : 8 - column % 8;
  }
  return column;
}

/// Collects the errors of protobuf, each at the line that it is about, with the option there.
class Collector final : public google::protobuf::io::ErrorCollector {
 public:
  Collector(const std::vector<std::string>& lines, ErrorsByLine* errors)
      : lines_(lines), errors_(errors) {}

  void AddError(int line, google::protobuf::io::ColumnNumber column,
                const std::string& message) override;

  /// Unknown fields arrive as warnings: parsing goes on after them.
  void AddWarning(int line, int, const std::string& message) override { Add(line, message); }

  /// The line that ended the parsing if it can be left out and the rest read; -1: what follows
  /// would be noise.
  int bad_line() const { return bad_line_; }

 private:
  std::string At(int line) const {
    return line >= 0 && line < static_cast<int>(lines_.size()) ? lines_[line] : std::string();
  }
  int LineOfValue(int line, int column) const;
  bool HoldsOneField(int line) const;
  void Add(int line, const std::string& message);

  const std::vector<std::string>& lines_;
  ErrorsByLine* errors_;
  int bad_line_ = -1;
  bool stopped_ = false;
};

void Collector::AddError(int line, google::protobuf::io::ColumnNumber column,
                         const std::string& message) {
  const bool about_name = message.starts_with("Expected identifier");
  const int place = about_name ? line : LineOfValue(line, column);
  Add(place, message);
  if (!stopped_ && !about_name && HoldsOneField(place)) bad_line_ = place;
  stopped_ = true;
}

/// Protobuf complains of a missing value, or an unknown name of one, at the token that follows.
/// Where that begins a line, the value belongs to the field before it.
int Collector::LineOfValue(int line, int column) const {
  if (column > FirstColumn(At(line)) && !At(line).empty()) return line;
  for (int before = line - 1; before >= 0; --before) {
    if (HoldsOneField(before)) return before;
    if (!FieldNameIn(At(before)).empty()) return line;
  }
  return line;
}

bool Collector::HoldsOneField(int line) const {
  const std::string text = At(line).substr(0, At(line).find('#'));
  return text.find(':') != text.npos && text.find_first_of("{}<>[]") == text.npos;
}

void Collector::Add(int line, const std::string& message) {
  const std::string name = FieldNameIn(At(line));
  const ConfigOption* option = FindConfigOption(name);
  std::string text = option ? std::string(option->path) : name;
  text += (text.empty() ? "" : ": ") + Legible(message);
  if (option) text += "; allowed: " + AllowedRange(*option);
  errors_->try_emplace(line, text);
}

std::vector<std::string> SplitLines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string JoinLines(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

/// Reads as much as can be read: a line with a bad value is left out, and the rest read again.
std::unique_ptr<TextFormat::ParseInfoTree> Parse(std::vector<std::string> lines, v1::Config* config,
                                                 ErrorsByLine* errors) {
  for (int attempt = 0;; ++attempt) {
    auto locations = std::make_unique<TextFormat::ParseInfoTree>();
    Collector collector(lines, errors);
    TextFormat::Parser parser;
    parser.RecordErrorsTo(&collector);
    parser.WriteLocationsTo(locations.get());
    parser.AllowUnknownField(true);
    const bool whole = parser.ParseFromString(JoinLines(lines), config);
    if (whole || collector.bad_line() < 0 || attempt == kErrorsMax) return locations;
    lines[collector.bad_line()].clear();
  }
}

/// The line of a field in the text; -1 if it is not there.
int LineOf(TextFormat::ParseInfoTree* tree, const std::string& path) {
  const google::protobuf::Descriptor* type = v1::Config::descriptor();
  const std::size_t dot = path.find('.');
  if (dot != path.npos) {
    const auto* nested = type->FindFieldByName(path.substr(0, dot));
    tree = tree->GetTreeForNested(nested, -1);
    type = nested->message_type();
  }
  return tree ? tree->GetLocation(type->FindFieldByName(path.substr(dot + 1)), -1).line : -1;
}

void CheckAgainst(const v1::Config& config, std::vector<ConfigError>* errors) {
  const v1::Clock& clock = config.clock();
  const double resolution = config.temporal_resolution_s();
  const std::string not_below = "must not be less than temporal_resolution_s (both in seconds)";
  if (config.announce_within_s() < resolution) errors->push_back({"announce_within_s", not_below});
  if (clock.grant_ahead_max_s() < resolution) {
    errors->push_back({"clock.grant_ahead_max_s", not_below});
  }
  if (config.simulators_max() < clock.simulators_awaited()) {
    errors->push_back({"clock.simulators_awaited", "must not be more than simulators_max"});
  }
  if (clock.kind() == v1::Clock::WALL && clock.skew_max_s() == 0) {
    errors->push_back(
        {"clock.skew_max_s", "with kind WALL it must be greater than 0, up to 60 [s]"});
  }
  const double release_default = CompleteConfig({}).clock().release_after_s();
  if (clock.on_silent_simulator() == v1::Clock::WAIT &&
      clock.release_after_s() != release_default) {
    errors->push_back({"clock.release_after_s", "allowed only with on_silent_simulator RELEASE"});
  }
}

/// Where fields disagree, the error stands at the one that the text sets.
int LineOfEither(TextFormat::ParseInfoTree* tree, const ConfigError& error) {
  const int line = LineOf(tree, error.field);
  if (line >= 0) return line;
  const bool awaited = error.field == "clock.simulators_awaited";
  return LineOf(tree, awaited ? "simulators_max" : "temporal_resolution_s");
}

}  // namespace

ConfigResult ParseConfig(const std::string& text, const std::string& name) {
  ConfigResult result;
  ErrorsByLine errors;
  const auto locations = Parse(SplitLines(text), &result.config, &errors);
  result.config = CompleteConfig(result.config);
  for (const ConfigError& error : CheckConfig(result.config)) {
    errors.try_emplace(LineOfEither(locations.get(), error), error.field + ": " + error.what);
  }
  for (const auto& [line, what] : errors) {
    result.errors.push_back(name + ":" + std::to_string(line + 1) + ": " + what);
  }
  return result;
}

ConfigResult LoadConfig(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file && file.peek() != std::ifstream::traits_type::eof()) text << file.rdbuf();
  if (file.is_open() && !file.bad()) return ParseConfig(text.str(), path);
  return {{}, {path + ": cannot be read: " + std::generic_category().message(errno)}};
}

v1::Config CompleteConfig(v1::Config config) {
  for (const ConfigOption& option : ConfigOptions()) {
    if (!IsSet(config, option)) SetValue(&config, option, DefaultOf(option, config));
  }
  return config;
}

std::uint64_t WorkUnitsPerEvaluation(const v1::Config& complete) {
  return static_cast<std::uint64_t>(
      std::llround(complete.time_budget_us() * complete.work_units_per_us()));
}

std::uint64_t WorkUnitsPerStep(const v1::Config& complete) {
  const double units = complete.step_budget_us() * complete.work_units_per_us();
  return units > 0 ? std::max<std::uint64_t>(1, std::llround(units)) : 0;
}

std::vector<ConfigError> CheckConfig(const v1::Config& complete) {
  std::vector<ConfigError> errors;
  for (const ConfigOption& option : ConfigOptions()) {
    std::string what = CheckValue(complete, option);
    if (!what.empty()) errors.push_back({std::string(option.path), std::move(what)});
  }
  CheckAgainst(complete, &errors);
  return errors;
}

}  // namespace collision::server
