#include <algorithm>

#include "client/mesh/scan.h"
#include "client/mesh/words.h"

namespace collision::client {
namespace {

constexpr std::size_t kHeaderBytes = 84;  ///< Of a binary file, the count of triangles included.
constexpr std::size_t kTriangleBytes = 50;
constexpr std::size_t kLookedAt = 512;  ///< Text has only printable characters at its beginning.

std::uint64_t BinaryTriangles(std::string_view text) {
  std::uint64_t count = 0;
  for (int i = 3; i >= 0; --i) count = count << 8 | static_cast<unsigned char>(text[80 + i]);
  return count;
}

bool IsText(std::string_view text) {
  const std::string_view start = text.substr(0, kLookedAt);
  return Words(text).Next().substr(0, 5) == "solid" &&
         std::none_of(start.begin(), start.end(),
                      [](unsigned char c) { return c == 0 || c > 127; });
}

void Require(Words* words, std::string_view expected) {
  const std::string_view word = words->Next();
  if (word == expected) return;
  words->Fail(word.empty() ? "the file ends where " + Quoted(expected) + " should be"
                           : Quoted(word) + " where " + Quoted(expected) + " should be");
}

void ScanFacet(Words* words) {
  Require(words, "normal");
  for (int i = 0; i < 3; ++i) words->Next();  // Unused: the order of the corners gives the outside.
  Require(words, "outer");
  Require(words, "loop");
  for (int corner = 0; corner < 3; ++corner) {
    Require(words, "vertex");
    for (int i = 0; i < 3; ++i) RequireFinite(*words, words->Next());
  }
  Require(words, "endloop");
  Require(words, "endfacet");
}

/// Reads one solid after the other; requires that the last one ends.
MeshScan ScanText(std::string_view text) {
  MeshScan scan;
  Words words(text);
  while (words.Next() == "solid") {
    words.SkipLine();  // Its name.
    for (std::string_view word = words.Next(); word != "endsolid"; word = words.Next()) {
      if (word != "facet") {
        words.Fail(word.empty() ? "the file ends within a solid, it is cut off"
                                : Quoted(word) + " where \"facet\" or \"endsolid\" should be");
      }
      ScanFacet(&words);
      ++scan.faces;
    }
    words.SkipLine();
  }
  return scan;
}

}  // namespace

MeshScan ScanStl(std::string_view text) {
  MeshScan scan;
  if (text.size() >= kHeaderBytes &&
      text.size() == kHeaderBytes + kTriangleBytes * BinaryTriangles(text)) {
    scan.faces = BinaryTriangles(text);
  } else if (IsText(text)) {
    scan = ScanText(text);
  } else if (text.size() < kHeaderBytes) {
    throw std::runtime_error(std::to_string(text.size()) +
                             " bytes: too short for an STL file, it is cut off");
  } else {
    const std::uint64_t count = BinaryTriangles(text);
    throw std::runtime_error("a binary STL file of " + std::to_string(text.size()) +
                             " bytes whose header says " + std::to_string(count) +
                             " triangles, which take " +
                             std::to_string(kHeaderBytes + kTriangleBytes * count) + " bytes");
  }
  if (scan.faces == 0) throw std::runtime_error("no faces");
  return scan;
}

}  // namespace collision::client
