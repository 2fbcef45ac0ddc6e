#include "tests/idl/idl_file.h"

#include <fstream>
#include <iterator>
#include <regex>
#include <stdexcept>

namespace collision {
namespace {

std::string Trimmed(const std::string& text) {
  return std::regex_replace(text, std::regex(R"(^\s+|\s+$)"), "");
}

std::string WithoutComments() {
  std::ifstream file(COLLISION_IDL_FILE);
  if (!file) throw std::runtime_error("cannot read " COLLISION_IDL_FILE);
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  return std::regex_replace(text, std::regex("//[^\n]*"), "");
}

std::vector<std::string> Split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

class Reader {
 public:
  IdlFile Read() {
    const std::string text = WithoutComments();
    ForEach(text, R"(const unsigned long (\w+) = (\d+);)",
            [&](const std::smatch& m) { file_.constants[m[1]] = std::stoul(m[2]); });
    ForEach(text, R"(struct (\w+) \{([^}]*)\})", [&](const std::smatch& m) {
      for (const std::string& line : Split(m[2], ';')) {
        if (Trimmed(line).empty()) continue;
        IdlField field = Field(Trimmed(line));
        field.key = Trimmed(line).rfind("@key ", 0) == 0;
        file_.structs[m[1]].push_back(field);
      }
    });
    ForEach(text, R"(enum (\w+) \{([^}]*)\})", [&](const std::smatch& m) {
      for (const std::string& name : Split(m[2], ',')) file_.enums[m[1]].push_back(Trimmed(name));
    });
    return file_;
  }

 private:
  template <class Function>
  static void ForEach(const std::string& text, const char* pattern, const Function& function) {
    const std::regex regex(pattern);
    for (std::sregex_iterator i(text.begin(), text.end(), regex), end; i != end; ++i) function(*i);
  }

  std::size_t Number(const std::string& text) const {
    const auto constant = file_.constants.find(text);
    return constant != file_.constants.end() ? constant->second : std::stoul(text);
  }

  IdlField Field(const std::string& line) const {
    static const std::regex form(
        R"((?:@key )?(?:sequence<(.+), *(\w+)>|(\w[\w ]*?)(?:<(\w+)>)?) +_?(\w+)(?:\[(\w+)\])?)");
    static const std::regex text(R"(string<(\w+)>)");
    std::smatch m;
    if (!std::regex_match(line, m, form)) throw std::runtime_error("unknown form: " + line);
    if (m[1].matched) {
      return {std::regex_replace(m[1].str(), text, "string"), m[5], Number(m[2]), true};
    }
    if (m[4].matched) return {m[3], m[5], Number(m[4]), false};
    if (m[6].matched) return {m[3].str() + "[]", m[5], Number(m[6]), false};
    return {m[3], m[5], 0, false};
  }

  IdlFile file_;
};

}  // namespace

const IdlFile& Idl() {
  static const IdlFile file = Reader().Read();
  return file;
}

}  // namespace collision
