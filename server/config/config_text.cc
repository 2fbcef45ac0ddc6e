#include "server/config/config_text.h"

#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include "server/config/config_blocks.h"
#include "server/config/config_options.h"
#include "server/config/level_blocks.h"
#include "server/config/limit_blocks.h"
#include "server/config/partner_blocks.h"

namespace collision::server {
namespace {

using google::protobuf::TextFormat;
using google::protobuf::io::Tokenizer;

/// More errors than a hand-written file has; a file of another kind stops here.
constexpr int kErrorsMax = 100;

class Unheard final : public google::protobuf::io::ErrorCollector {
  void AddError(int, google::protobuf::io::ColumnNumber, const std::string&) override {}
};

/// The text as tokens, and which of them are names of fields.
class Tokens {
 public:
  explicit Tokens(const std::string& text);

  /// The field that protobuf complains about at a place: it has read the name before it finds
  /// fault with the field, at its value or at the token after that. nullopt: there is none.
  std::optional<std::size_t> FieldBefore(const TextPlace& place) const;

  /// The path of a field, as in "clock.kind" or "limits[2].name".
  std::string PathOf(std::size_t field) const;

  TextPlace PlaceOf(std::size_t token) const {
    return {tokens_[token].line, tokens_[token].column};
  }

  /// Spaces in place of a field and its value; line breaks stay.
  void Blank(std::size_t field, std::string* text) const;

 private:
  bool Is(std::size_t token, std::string_view text) const {
    return token < tokens_.size() && tokens_[token].text == text;
  }
  bool Opens(std::size_t token) const { return Is(token, "{") || Is(token, "<"); }
  bool Closes(std::size_t token) const { return Is(token, "}") || Is(token, ">"); }
  bool IsName(std::size_t token) const;
  std::size_t EndOf(std::size_t field) const;

  std::vector<Tokenizer::Token> tokens_;
};

Tokens::Tokens(const std::string& text) {
  google::protobuf::io::ArrayInputStream stream(text.data(), static_cast<int>(text.size()));
  Unheard unheard;
  Tokenizer tokenizer(&stream, &unheard);
  tokenizer.set_comment_style(Tokenizer::SH_COMMENT_STYLE);
  tokenizer.set_allow_f_after_float(true);
  tokenizer.set_require_space_after_number(false);
  while (tokenizer.Next()) tokens_.push_back(tokenizer.current());
}

/// A word is a value only right behind a colon or a sign, and without a colon of its own.
bool Tokens::IsName(std::size_t token) const {
  if (tokens_[token].type != Tokenizer::TYPE_IDENTIFIER) return false;
  if (Is(token + 1, ":") || Opens(token + 1)) return true;
  return token == 0 || (!Is(token - 1, ":") && !Is(token - 1, "-"));
}

std::optional<std::size_t> Tokens::FieldBefore(const TextPlace& place) const {
  std::optional<std::size_t> found;
  for (std::size_t token = 0; token < tokens_.size() && PlaceOf(token) < place; ++token) {
    if (IsName(token)) found = token;
  }
  return found;
}

std::string Tokens::PathOf(std::size_t field) const {
  std::vector<std::string> around;
  std::string last;
  std::map<std::string, int> blocks;
  for (std::size_t token = 0; token < field; ++token) {
    if (IsName(token)) last = tokens_[token].text;
    if (IsName(token) && around.empty() && IsBlock(last)) last = BlockPath(last, blocks[last]++);
    if (Opens(token)) around.push_back(last);
    if (Closes(token) && !around.empty()) around.pop_back();
  }
  std::string path;
  for (const std::string& name : around) path += name + ".";
  return path + tokens_[field].text;
}

/// The token behind the value: the next name, or the end of the block that the field stands in.
std::size_t Tokens::EndOf(std::size_t field) const {
  int depth = 0;
  for (std::size_t token = field + 1; token < tokens_.size(); ++token) {
    if (depth == 0 && (IsName(token) || Closes(token))) return token;
    depth += Opens(token) ? 1 : 0;
    depth -= Closes(token) ? 1 : 0;
  }
  return tokens_.size();
}

void Tokens::Blank(std::size_t field, std::string* text) const {
  const TextPlace first = PlaceOf(field);
  const std::size_t end = EndOf(field);
  TextPlace place{0, 0};
  for (char& c : *text) {
    if (end < tokens_.size() && place >= PlaceOf(end)) return;
    if (c == '\n') {
      place = {place.first + 1, 0};
      continue;
    }
    const int width = c == '\t' ? 8 - place.second % 8 : 1;  // As protobuf counts columns.
    if (place >= first && c != '\t') c = ' ';
    place.second += width;
  }
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

/// What the words of earlier versions are called now; empty: it is none of them.
std::string NewWord(const std::string& message) {
  if (message.find("\"SIMULATED\"") != message.npos) return "SIMULATED is called LOCK_STEP now";
  if (message.find("\"WALL\"") != message.npos) return "WALL is called REAL_TIME now";
  return "";
}

std::string AllowedInBlock(const BlockOfPath& block, const std::string& field) {
  if (block.field->name() == "limits") return AllowedInLimitBlock(field);
  if (block.field->name() == "levels") return AllowedInLevelBlock(field);
  return AllowedInPartnerBlock(block, field);
}

/// What is wrong with the field of this path, and what is allowed there.
std::string Explain(const std::string& path, const std::string& message) {
  const auto options = ConfigOptions();
  const auto option = std::ranges::find(options, path, &ConfigOption::path);
  if (option != options.end()) {
    const std::string renamed = path == "clock.kind" ? NewWord(message) : "";
    return path + ": " + (renamed.empty() ? Legible(message) : renamed) +
           "; allowed: " + AllowedRange(*option);
  }
  const std::string leaf = path.substr(path.rfind('.') + 1);
  const std::string error = path + ": " + Legible(message);
  if (const auto block = FindBlock(path); block && leaf != path) {
    return error + "; allowed: " + AllowedInBlock(*block, leaf);
  }
  const ConfigOption* meant = FindConfigOption(leaf);
  return error + (meant == nullptr ? "" : "; meant is " + std::string(meant->path) + "?");
}

/// Collects the errors of protobuf, each at the field that it is about.
class Collector final : public google::protobuf::io::ErrorCollector {
 public:
  Collector(const Tokens& tokens, ErrorsByPlace* errors) : tokens_(tokens), errors_(errors) {}

  void AddError(int line, google::protobuf::io::ColumnNumber column,
                const std::string& message) override;

  /// Unknown fields arrive as warnings: parsing goes on after them.
  void AddWarning(int line, int column, const std::string& message) override {
    Add({line, column}, tokens_.FieldBefore({line, column}), message);
  }

  /// The field that ended the parsing if it can be left out and the rest read; nullopt: what
  /// follows would be noise.
  std::optional<std::size_t> bad_field() const { return bad_field_; }

 private:
  void Add(const TextPlace& place, std::optional<std::size_t> field, const std::string& message);

  const Tokens& tokens_;
  ErrorsByPlace* errors_;
  std::optional<std::size_t> bad_field_;
  bool stopped_ = false;
};

void Collector::AddError(int line, google::protobuf::io::ColumnNumber column,
                         const std::string& message) {
  const bool about_name = message.starts_with("Expected identifier");
  const auto field = about_name ? std::nullopt : tokens_.FieldBefore({line, column});
  Add({line, column}, field, message);
  if (!stopped_) bad_field_ = field;
  stopped_ = true;
}

void Collector::Add(const TextPlace& place, std::optional<std::size_t> field,
                    const std::string& message) {
  if (!field) {
    errors_->try_emplace(place, Legible(message));
    return;
  }
  errors_->try_emplace(tokens_.PlaceOf(*field), Explain(tokens_.PathOf(*field), message));
}

}  // namespace

std::unique_ptr<TextFormat::ParseInfoTree> ReadConfigText(const std::string& text,
                                                          v1::Config* config,
                                                          ErrorsByPlace* errors) {
  std::string rest = text;
  for (int attempt = 0;; ++attempt) {
    auto locations = std::make_unique<TextFormat::ParseInfoTree>();
    const Tokens tokens(rest);
    Collector collector(tokens, errors);
    TextFormat::Parser parser;
    parser.RecordErrorsTo(&collector);
    parser.WriteLocationsTo(locations.get());
    parser.AllowUnknownField(true);
    const bool whole = parser.ParseFromString(rest, config);
    if (whole || !collector.bad_field() || attempt == kErrorsMax) return locations;
    tokens.Blank(*collector.bad_field(), &rest);
  }
}

}  // namespace collision::server
