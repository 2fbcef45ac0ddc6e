#include <algorithm>

#include "client/mesh/scan.h"
#include "client/mesh/words.h"

namespace collision::client {
namespace {

/// Vertices, texture coordinates and normals, in the order of a corner v/t/n.
constexpr std::string_view kLists[] = {"v", "vt", "vn"};

class ObjScan {
 public:
  MeshScan Run(std::string_view text) {
    while (!text.empty()) {
      ++line_;
      std::string joined;
      Line(NextLine(&text, &joined));
    }
    for (int list = 0; list < 3; ++list) RequireListed(list);
    if (scan_.faces == 0) throw std::runtime_error("no faces (lines that begin with f)");
    return scan_;
  }

 private:
  [[noreturn]] static void Fail(std::size_t line, const std::string& cause) {
    throw std::runtime_error("line " + std::to_string(line) + ": " + cause);
  }

  /// A backslash at its end continues a line.
  std::string_view NextLine(std::string_view* text, std::string* joined) {
    for (;;) {
      const std::size_t end = std::min(text->find('\n'), text->size());
      std::string_view line = text->substr(0, end);
      text->remove_prefix(std::min(end + 1, text->size()));
      if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
      if (line.empty() || line.back() != '\\') {
        if (joined->empty()) return line;
        *joined += line;
        return *joined;
      }
      line.remove_suffix(1);
      *joined += std::string(line) + " ";
      if (text->empty()) return *joined;
      ++line_;
    }
  }

  void Line(std::string_view line) {
    Words words(line);
    const std::string_view keyword = words.Next();
    if (keyword == "f") return Face(&words);
    for (int list = 0; list < 3; ++list) {
      if (keyword == kLists[list]) ++counts_[list];
    }
    if (keyword == "v") Vertex(&words);
  }

  void Vertex(Words* words) {
    scan_.plain += 'v';
    for (int i = 0; i < 3; ++i) {
      const std::string_view word = words->Next();
      const auto number = NumberOf<double>(word);
      if (!number || !std::isfinite(*number)) {
        Fail(line_, "a vertex's coordinate: " + Quoted(word) + ", allowed: a finite number");
      }
      scan_.plain += ' ';
      scan_.plain += word;
    }
    scan_.plain += '\n';
    const std::string_view weight = words->Next();
    if (weight.empty() || weight[0] == '#' || !words->Next().empty())
      return;  // Without one, or with a colour.
    if (NumberOf<double>(weight) != 1.0) {
      Fail(line_, "a vertex's weight: " + Quoted(weight) + ", allowed: none, or 1");
    }
  }

  void Face(Words* words) {
    std::size_t corners = 0;
    std::string plain = "f";
    for (std::string_view word = words->Next(); !word.empty() && word[0] != '#';
         word = words->Next()) {
      plain += ' ' + std::to_string(Corner(word));
      ++corners;
    }
    ++(corners < 3 ? scan_.thin : scan_.faces);
    if (corners >= 3) scan_.plain += plain + '\n';
  }

  /// Its vertex, counted from 1.
  std::int64_t Corner(std::string_view word) {
    std::string_view rest = word;
    std::int64_t vertex = 0;
    for (int list = 0; list < 3; ++list) {
      const std::size_t end = std::min(rest.find('/'), rest.size());
      const std::string_view part = rest.substr(0, end);
      const bool last = end == rest.size();
      // v//n leaves out the texture coordinate; some write v/ for v.
      if (!part.empty()) {
        const std::int64_t index = Index(list, part, word);
        if (list == 0) vertex = index;
      } else if (list == 0) {
        Fail(line_, "a face's corner: " + Quoted(word) + ", allowed: v, v/t, v//n or v/t/n");
      }
      if (last) return vertex;
      rest.remove_prefix(end + 1);
    }
    Fail(line_, "a face's corner: " + Quoted(word) + ", allowed: v, v/t, v//n or v/t/n");
  }

  std::int64_t Index(int list, std::string_view part, std::string_view word) {
    const auto index = NumberOf<std::int64_t>(part);
    if (!index || *index == 0 || *index < -counts_[list]) {
      Fail(line_, "a face's corner: " + Quoted(word) + ", allowed: indices 1 to the number of " +
                      std::string(kLists[list]) + ", or -" + std::to_string(counts_[list]) +
                      " to -1");
    }
    if (*index < 0) return counts_[list] + 1 + *index;
    if (*index > greatest_[list]) {
      greatest_[list] = *index;
      greatest_line_[list] = line_;
    }
    return *index;
  }

  /// Checked at the end, since an index may come before what it names.
  void RequireListed(int list) const {
    if (greatest_[list] <= counts_[list]) return;
    Fail(greatest_line_[list], "a face names " + std::string(kLists[list]) + " " +
                                   std::to_string(greatest_[list]) + ", the file has " +
                                   std::to_string(counts_[list]));
  }

  MeshScan scan_;
  std::size_t line_ = 0;
  std::int64_t counts_[3] = {};
  std::int64_t greatest_[3] = {};
  std::size_t greatest_line_[3] = {};
};

}  // namespace

MeshScan ScanObj(std::string_view text) { return ObjScan().Run(text); }

}  // namespace collision::client
