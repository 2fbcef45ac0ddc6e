#include "client/programs/tools/collisionctl/json/json_writer.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>

#include "collision/event_text.h"
#include "collision/types.h"
#include "idl/identity.h"

namespace collision::client {

std::string JsonText(std::string_view text) {
  std::string json = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      json += '\\';
      json += c;
    } else if (static_cast<unsigned char>(c) < ' ') {
      char escaped[8];
      std::snprintf(escaped, sizeof escaped, "\\u%04x", static_cast<unsigned>(c));
      json += escaped;
    } else {
      json += c;
    }
  }
  return json + '"';
}

std::string JsonNumber(double value) {
  if (!std::isfinite(value)) return "null";
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

std::string JsonArray(const std::vector<std::string>& elements) {
  std::string json = "[";
  for (const std::string& element : elements) json += (json.size() > 1 ? "," : "") + element;
  return json + "]";
}

std::string JsonTexts(const std::vector<std::string>& texts) {
  std::vector<std::string> elements;
  for (const std::string& text : texts) elements.push_back(JsonText(text));
  return JsonArray(elements);
}

std::string JsonVector(const std::vector<double>& elements) {
  std::vector<std::string> texts;
  for (const double element : elements) texts.push_back(JsonNumber(element));
  return JsonArray(texts);
}

JsonObject& JsonObject::Add(std::string_view key, std::string_view json) {
  if (!fields_.empty()) fields_ += ',';
  fields_ += JsonText(key);
  fields_ += ':';
  fields_ += json;
  return *this;
}

JsonObject& JsonObject::Id(std::string_view key, std::uint64_t id) { return Text(key, IdText(id)); }

JsonObject& JsonObject::Instant(const std::string& key, std::int64_t instant_ns) {
  if (instant_ns == kNever || instant_ns == std::numeric_limits<std::int64_t>::min()) {
    return Null(key + "_ns").Null(key + "_s");
  }
  constexpr int kDecimals = 9;
  return Text(key + "_ns", std::to_string(instant_ns))
      .Add(key + "_s", SecondsText(instant_ns, 0, kDecimals));
}

JsonObject JsonDocument(std::string_view kind) {
  JsonObject document;
  document.Text("schema", kJsonSchema).Text("kind", kind);
  return document;
}

}  // namespace collision::client
