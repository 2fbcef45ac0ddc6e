#include "client/programs/simulators/player/csv_rows.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>
#include <string_view>

#include "idl/limits.h"

namespace collision::client {
namespace {

// Below this a time in nanoseconds fits its type, also after a start instant is added.
constexpr long double kTimeMax = 4e18L;

struct Column {
  std::size_t index = 0;
  double scale = 1;  // to SI
  std::string name = {};
};

struct Columns {
  std::size_t count = 0;
  std::size_t agent = 0;
  Column time;
  long double nanoseconds = 1e9L;  // per unit of the time column
  std::optional<Column> position[3];
  std::optional<Column> velocity[3];
  std::optional<std::size_t> jump;
};

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
constexpr const char* kBlanks = " \t";

std::string_view Trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  return text.substr(0, text.find_last_not_of(kBlanks) + 1);
}

/// Removes the first field from the line. A quoted field may contain commas, and doubled quotes for
/// quotes. Nullopt: a quote does not end, or is followed by text. `more`: a comma follows the
/// field.
std::optional<std::string> TakeField(std::string_view* line, bool* more) {
  std::string field;
  const std::size_t start = line->find_first_not_of(kBlanks);
  const bool quoted = start != std::string_view::npos && (*line)[start] == '"';
  if (quoted) {
    std::size_t quote = start;
    do {
      const std::size_t next = line->find('"', quote + 1);
      if (next == std::string_view::npos) return std::nullopt;
      field += line->substr(quote + 1, next - quote - 1);
      line->remove_prefix(next + 1);
      quote = 0;
      if (!line->empty() && line->front() == '"') field += '"';
    } while (!line->empty() && line->front() == '"');
  }
  const std::size_t comma = line->find(',');
  const std::string_view rest = Trimmed(line->substr(0, comma));
  *more = comma != std::string_view::npos;
  line->remove_prefix(*more ? comma + 1 : line->size());
  if (!quoted) return std::string(rest);
  return rest.empty() ? std::optional(field) : std::nullopt;
}

// "x_km" -> 1000 with quantity "x" and suffix ""; nullopt for another quantity.
std::optional<double> LengthScale(std::string_view name, const std::string& quantity,
                                  const std::string& suffix) {
  if (name == quantity + "_m" + suffix) return 1;
  if (name == quantity + "_km" + suffix) return 1e3;
  if (name == quantity + "_mm" + suffix) return 1e-3;
  return std::nullopt;
}

class Reader {
 public:
  Reader(std::istream& text, const std::string& name) : text_(text), name_(name) {}

  CsvRows Read() {
    ReadHeader();
    for (std::string line; NextLine(&line);) {
      if (!line.empty()) ReadRow(line);
    }
    if (text_.bad()) Fail("the file cannot be read further");
    if (result_.rows.empty()) Fail("no rows after the header");
    return std::move(result_);
  }

 private:
  [[noreturn]] void Fail(const std::string& what) const {
    throw CsvError(name_ + ":" + std::to_string(line_) + ": " + what);
  }

  bool NextLine(std::string* line) {
    if (!std::getline(text_, *line)) return false;
    ++line_;
    if (!line->empty() && line->back() == '\r') line->pop_back();
    return true;
  }

  std::vector<std::string> Split(std::string_view line) const {
    std::vector<std::string> fields;
    for (bool more = true; more;) {
      const auto field = TakeField(&line, &more);
      if (!field) Fail("a quote is not closed, or is followed by something else than a comma");
      fields.push_back(*field);
    }
    return fields;
  }

  void ReadHeader() {
    std::string line;
    if (!NextLine(&line)) {
      line_ = 1;
      Fail("the file is empty; its first line names the columns");
    }
    if (line.starts_with(kByteOrderMark)) line.erase(0, kByteOrderMark.size());
    const auto names = Split(line);
    columns_.count = names.size();
    std::optional<std::size_t> agent, time;
    for (std::size_t i = 0; i < names.size(); ++i) ReadName(names[i], i, &agent, &time);
    if (!time) Fail("no column time_s, time_ms or time_ns in the header");
    if (!agent) Fail("no column agent_id in the header");
    columns_.agent = *agent;
    columns_.time.index = *time;
    columns_.time.name = names[*time];
    if (!columns_.position[0]) Fail("no column x_m (or x_km, x_mm) in the header");
    if (!columns_.position[1]) Fail("no column y_m (or y_km, y_mm) in the header");
    CheckVelocities();
  }

  void CheckVelocities() {
    const auto& v = columns_.velocity;
    result_.velocities = v[0] || v[1] || v[2];
    for (int axis = 0; result_.velocities && axis < 3; ++axis) {
      if (v[axis].has_value() == columns_.position[axis].has_value()) continue;
      Fail(std::string(
               "the header has velocities, but not the same axes as positions: see column v") +
           "xyz"[axis] + "_m_s");
    }
  }

  void ReadName(std::string_view name, std::size_t index, std::optional<std::size_t>* agent,
                std::optional<std::size_t>* time) {
    const auto once = [&](bool present) {
      if (present) Fail("column " + std::string(name) + " is the second of its kind");
    };
    if (name == "agent_id") {
      once(agent->has_value());
      *agent = index;
    } else if (name == "time_s" || name == "time_ms" || name == "time_ns") {
      once(time->has_value());
      *time = index;
      columns_.nanoseconds = name == "time_s" ? 1e9L : name == "time_ms" ? 1e6L : 1;
    }
    if (name == "jump") {
      once(columns_.jump.has_value());
      columns_.jump = index;
    }
    for (int axis = 0; axis < 3; ++axis) {
      const std::string letter(1, "xyz"[axis]);
      if (const auto scale = LengthScale(name, letter, "")) {
        once(columns_.position[axis].has_value());
        columns_.position[axis] = {index, *scale, std::string(name)};
      }
      if (const auto scale = LengthScale(name, "v" + letter, "_s")) {
        once(columns_.velocity[axis].has_value());
        columns_.velocity[axis] = {index, *scale, std::string(name)};
      }
    }
  }

  template <typename Number>
  Number Finite(std::string_view field, const std::string& column) const {
    Number value = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value)) {
      Fail(column + " \"" + std::string(field.substr(0, 40)) + "\" is not a finite number");
    }
    return value;
  }

  bool Flag(const std::string& field, const std::string& column) const {
    if (field != "0" && field != "1") {
      Fail(column + ": \"" + field.substr(0, 40) + "\", allowed: 0 or 1");
    }
    return field == "1";
  }

  void ReadRow(const std::string& line) {
    const auto fields = Split(line);
    if (fields.size() != columns_.count) {
      Fail(std::to_string(fields.size()) + " columns, the header has " +
           std::to_string(columns_.count));
    }
    const std::string& agent = fields[columns_.agent];
    if (agent.empty()) Fail("agent_id is empty");
    if (agent.find_first_of(" \t") != std::string::npos) Fail("agent_id has a space in it");
    CsvRow row;
    row.line = line_;
    const long double time =
        Finite<long double>(fields[columns_.time.index], columns_.time.name) * columns_.nanoseconds;
    if (!(std::fabs(time) < kTimeMax)) Fail("time is beyond a century from 0");
    row.time_ns = std::llround(time);
    for (int axis = 0; axis < 3; ++axis) {
      row.position_m[axis] = Value(columns_.position[axis], wire::kCoordinateMax, "m", fields);
      row.velocity_m_s[axis] = Value(columns_.velocity[axis], wire::kSpeedMax, "m/s", fields);
    }
    if (columns_.jump) row.jump = Flag(fields[*columns_.jump], "jump");
    auto& rows = result_.rows[agent];
    if (!rows.empty() && row.time_ns <= rows.back().time_ns) {
      Fail("time " + fields[columns_.time.index] + " of agent " + agent +
           " is not later than its row before");
    }
    rows.push_back(row);
  }

  // In SI units; `most` and `unit` of those. Without the column 0.
  double Value(const std::optional<Column>& column, double most, const char* unit,
               const std::vector<std::string>& fields) const {
    if (!column) return 0;
    const std::string& field = fields[column->index];
    const double value = Finite<double>(field, column->name) * column->scale;
    if (std::fabs(value) <= most) return value;
    std::ostringstream text;
    text << column->name << ": " << field.substr(0, 40) << ", allowed: -" << most << " to " << most
         << ' ' << unit;
    Fail(text.str());
  }

  std::istream& text_;
  const std::string& name_;
  std::size_t line_ = 0;
  Columns columns_;
  CsvRows result_;
};

}  // namespace

CsvRows ReadCsv(std::istream& text, const std::string& name) { return Reader(text, name).Read(); }

}  // namespace collision::client
