#include "idl/credentials/validity.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>

namespace collision::credentials {
namespace {

// Tags of DER (ITU-T X.690).
constexpr unsigned char kInteger = 0x02, kUtcTime = 0x17, kGeneralizedTime = 0x18, kSequence = 0x30,
                        kVersion = 0xa0;

int ValueOf(char digit) {
  if (digit >= 'A' && digit <= 'Z') return digit - 'A';
  if (digit >= 'a' && digit <= 'z') return digit - 'a' + 26;
  if (digit >= '0' && digit <= '9') return digit - '0' + 52;
  if (digit == '+') return 62;
  return digit == '/' ? 63 : -1;
}

/// Leaves out what is no digit of base 64, such as line ends.
std::string FromBase64(std::string_view text) {
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char digit : text) {
    const int value = ValueOf(digit);
    if (value < 0) continue;
    bits = (bits << 6 | static_cast<unsigned>(value)) & 0xffffff;
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<char>(bits >> count & 0xff));
  }
  return bytes;
}

struct Element {
  unsigned char tag = 0;
  std::string_view content;
};

/// Takes the first element off `bytes`; nullopt: they are none.
std::optional<Element> Take(std::string_view* bytes) {
  if (bytes->size() < 2) return std::nullopt;
  const auto tag = static_cast<unsigned char>((*bytes)[0]);
  std::size_t length = static_cast<unsigned char>((*bytes)[1]);
  std::size_t at = 2;
  if (length >= 0x80) {
    std::size_t digits = length & 0x7f;
    if (digits == 0 || digits > 4 || bytes->size() < 2 + digits) return std::nullopt;
    for (length = 0; digits > 0; --digits) {
      length = length << 8 | static_cast<unsigned char>((*bytes)[at++]);
    }
  }
  if (length > bytes->size() - at) return std::nullopt;
  const Element element{tag, bytes->substr(at, length)};
  bytes->remove_prefix(at + length);
  return element;
}

/// The content of the first element; nullopt: it has another tag.
std::optional<std::string_view> Take(unsigned char tag, std::string_view* bytes) {
  const std::optional<Element> element = Take(bytes);
  if (!element || element->tag != tag) return std::nullopt;
  return element->content;
}

/// The number that `digits` digits make, taken off `text`; nullopt: there are not so many.
std::optional<int> TakeNumber(std::size_t digits, std::string_view* text) {
  if (text->size() < digits) return std::nullopt;
  int number = 0;
  for (const char digit : text->substr(0, digits)) {
    if (digit < '0' || digit > '9') return std::nullopt;
    number = 10 * number + (digit - '0');
  }
  text->remove_prefix(digits);
  return number;
}

/// Year, month, day, hour, minute and second in UTC [s since 1970].
std::int64_t SecondsOf(const std::array<int, 6>& parts) {
  using namespace std::chrono;
  const sys_days day =
      year(parts[0]) / static_cast<unsigned>(parts[1]) / static_cast<unsigned>(parts[2]);
  return duration_cast<seconds>(day.time_since_epoch()).count() + 3600 * parts[3] + 60 * parts[4] +
         parts[5];
}

/// Digits of a date from year to second, with `separators` between them, one before each part but
/// the first; '\0': none.
std::optional<std::int64_t> DateOf(std::string_view text, std::size_t year_digits,
                                   const std::array<char, 5>& separators) {
  std::array<int, 6> parts{};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const char separator = i == 0 ? '\0' : separators[i - 1];
    if (separator != '\0') {
      if (text.empty() || text[0] != separator) return std::nullopt;
      text.remove_prefix(1);
    }
    const std::optional<int> part = TakeNumber(i == 0 ? year_digits : 2, &text);
    if (!part) return std::nullopt;
    parts[i] = *part;
  }
  // RFC 5280: of two digits, 50 to 99 belong to the last century.
  if (year_digits == 2) parts[0] += parts[0] < 50 ? 2000 : 1900;
  if (parts[1] < 1 || parts[1] > 12 || parts[2] < 1 || parts[2] > 31) return std::nullopt;
  return SecondsOf(parts);
}

std::optional<std::int64_t> TimeOf(const Element& time) {
  if (time.tag == kUtcTime) return DateOf(time.content, 2, {});
  if (time.tag == kGeneralizedTime) return DateOf(time.content, 4, {});
  return std::nullopt;
}

/// Of a certificate in DER (RFC 5280, 4.1): version, serial number, algorithm, issuer, validity.
std::optional<std::int64_t> EndOf(std::string_view der) {
  std::optional<std::string_view> certificate = Take(kSequence, &der);
  if (!certificate) return std::nullopt;
  std::optional<std::string_view> body = Take(kSequence, &*certificate);
  if (!body) return std::nullopt;
  if (!body->empty() && static_cast<unsigned char>(body->front()) == kVersion) Take(&*body);
  if (!Take(kInteger, &*body) || !Take(kSequence, &*body) || !Take(kSequence, &*body)) {
    return std::nullopt;
  }
  std::optional<std::string_view> validity = Take(kSequence, &*body);
  if (!validity || !Take(&*validity)) return std::nullopt;
  const std::optional<Element> end = Take(&*validity);
  return end ? TimeOf(*end) : std::nullopt;
}

std::string Text(std::int64_t seconds, const char* format) {
  using namespace std::chrono;
  const sys_seconds time{std::chrono::seconds(seconds)};
  const auto day = floor<days>(time);
  const year_month_day date(day);
  const hh_mm_ss<std::chrono::seconds> of_day(time - day);
  char text[64];
  std::snprintf(
      text, sizeof text, format, static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
      static_cast<unsigned>(date.day()), static_cast<int>(of_day.hours().count()),
      static_cast<int>(of_day.minutes().count()), static_cast<int>(of_day.seconds().count()));
  return text;
}

}  // namespace

std::optional<std::int64_t> EndOfCertificate(std::string_view pem) {
  constexpr std::string_view kBegin = "-----BEGIN CERTIFICATE-----", kEnd = "-----END";
  const std::size_t begin = pem.find(kBegin);
  if (begin == std::string_view::npos) return std::nullopt;
  pem.remove_prefix(begin + kBegin.size());
  return EndOf(FromBase64(pem.substr(0, pem.find(kEnd))));
}

std::optional<std::int64_t> EndOfPermissions(std::string_view document) {
  constexpr std::string_view kBegin = "<not_after>";
  std::optional<std::int64_t> least;
  for (std::size_t at = document.find(kBegin); at != std::string_view::npos;
       at = document.find(kBegin, at)) {
    at += kBegin.size();
    const auto end = DateOf(document.substr(at), 4, {'-', '-', 'T', ':', ':'});
    if (end) least = least ? std::min(*least, *end) : *end;
  }
  return least;
}

std::string DateText(std::int64_t seconds) {
  return Text(seconds, "%04d-%02u-%02u %02d:%02d:%02d UTC");
}

std::string XmlDateText(std::int64_t seconds) {
  return Text(seconds, "%04d-%02u-%02uT%02d:%02d:%02dZ");
}

}  // namespace collision::credentials
