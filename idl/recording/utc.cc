#include "idl/recording/utc.h"

#include <chrono>
#include <cstdio>
#include <regex>

namespace collision::wire {
namespace {

struct Fields {
  std::chrono::year_month_day day;
  std::chrono::hh_mm_ss<std::chrono::milliseconds> time;
};

Fields FieldsOf(std::int64_t wall_ns) {
  const auto time = std::chrono::floor<std::chrono::milliseconds>(
      std::chrono::sys_time<std::chrono::nanoseconds>(std::chrono::nanoseconds(wall_ns)));
  const auto day = std::chrono::floor<std::chrono::days>(time);
  return {std::chrono::year_month_day(day), std::chrono::hh_mm_ss(time - day)};
}

std::string Print(const char* format, std::int64_t wall_ns) {
  const Fields of = FieldsOf(wall_ns);
  char text[64];
  std::snprintf(
      text, sizeof text, format, static_cast<int>(of.day.year()),
      static_cast<unsigned>(of.day.month()), static_cast<unsigned>(of.day.day()),
      static_cast<int>(of.time.hours().count()), static_cast<int>(of.time.minutes().count()),
      static_cast<int>(of.time.seconds().count()), static_cast<int>(of.time.subseconds().count()));
  return text;
}

/// Of a match: year, month, day, hour, minute, second, digits behind the point.
std::optional<std::int64_t> FromMatch(const std::smatch& match) {
  const auto number = [&](std::size_t i) {
    return match[i].matched && match[i].length() > 0 ? std::stoi(match[i].str()) : 0;
  };
  const std::chrono::year_month_day day{std::chrono::year(number(1)),
                                        std::chrono::month(static_cast<unsigned>(number(2))),
                                        std::chrono::day(static_cast<unsigned>(number(3)))};
  if (!day.ok() || number(4) > 23 || number(5) > 59 || number(6) > 59) return std::nullopt;
  const std::string digits = (match[7].str() + "000000000").substr(0, 9);
  const auto time = std::chrono::sys_days(day) + std::chrono::hours(number(4)) +
                    std::chrono::minutes(number(5)) + std::chrono::seconds(number(6)) +
                    std::chrono::nanoseconds(std::stoll(digits));
  return std::chrono::nanoseconds(time.time_since_epoch()).count();
}

std::optional<std::int64_t> Match(const std::string& text, const char* pattern) {
  std::smatch match;
  if (!std::regex_match(text, match, std::regex(pattern))) return std::nullopt;
  return FromMatch(match);
}

}  // namespace

std::string UtcText(std::int64_t wall_ns) {
  return Print("%04d-%02u-%02uT%02d:%02d:%02d.%03dZ", wall_ns);
}

std::string UtcOfFile(std::int64_t wall_ns) {
  return Print("%04d%02u%02uT%02d%02d%02d.%03dZ", wall_ns);
}

std::optional<std::int64_t> FromUtcOfFile(const std::string& text) {
  return Match(text, R"((\d{4})(\d\d)(\d\d)T(\d\d)(\d\d)(\d\d)\.(\d{3})Z)");
}

// Years of 1970 to 2199, which fit the nanoseconds of 64 bits.
std::optional<std::int64_t> FromUtc(const std::string& text) {
  return Match(text, R"((19[7-9]\d|2[01]\d\d)-(\d\d)-(\d\d))"
                     R"((?:T(\d\d):(\d\d)(?::(\d\d)(?:\.(\d{1,9}))?)?Z?)?)");
}

}  // namespace collision::wire
