// JSON (RFC 8259) as text, in the order in which it is written.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace collision::client {

/// The name and version of all documents that collisionctl prints (schema.json beside this file).
inline constexpr std::string_view kJsonSchema = "collision/1";

/// A text with its quotes and escapes. `text` is UTF-8.
std::string JsonText(std::string_view text);

/// The shortest number that reads back as this one; null if it is not finite.
std::string JsonNumber(double value);

/// An array of documents.
std::string JsonArray(const std::vector<std::string>& elements);

/// An array of texts.
std::string JsonTexts(const std::vector<std::string>& texts);

/// An array of numbers.
std::string JsonVector(const std::vector<double>& elements);

/// An object, made key by key.
class JsonObject {
 public:
  /// A value that is JSON already.
  JsonObject& Add(std::string_view key, std::string_view json);
  JsonObject& Null(std::string_view key) { return Add(key, "null"); }
  JsonObject& Text(std::string_view key, std::string_view value) {
    return Add(key, JsonText(value));
  }
  /// Null if it is empty.
  JsonObject& TextOrNull(std::string_view key, std::string_view value) {
    return value.empty() ? Null(key) : Text(key, value);
  }
  JsonObject& Number(std::string_view key, double value) { return Add(key, JsonNumber(value)); }
  JsonObject& Count(std::string_view key, std::uint64_t value) {
    return Add(key, std::to_string(value));
  }
  JsonObject& Flag(std::string_view key, bool value) { return Add(key, value ? "true" : "false"); }

  /// An id of 64 bits: 16 hexadecimal digits, since JavaScript's numbers do not hold it.
  JsonObject& Id(std::string_view key, std::uint64_t id);

  /// KEY_ns, in decimal digits as a text for the same reason, and KEY_s, a number with nine
  /// decimals that is as exact. Both are null for the least instant, which was never given, and for
  /// the greatest, which is never.
  JsonObject& Instant(const std::string& key, std::int64_t instant_ns);

  /// "{...}"
  std::string Json() const { return "{" + fields_ + "}"; }

 private:
  std::string fields_;
};

/// A document of this kind, which has said so: {"schema": "collision/1", "kind": KIND, ...
JsonObject JsonDocument(std::string_view kind);

}  // namespace collision::client
