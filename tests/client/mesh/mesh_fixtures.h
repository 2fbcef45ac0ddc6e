// A cube, side 1, from the origin, as a file of every format, to be damaged by the tests.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <sstream>
#include <string>

namespace collision::client {

inline constexpr int kCube[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                    {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
inline constexpr int kSquares[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                       {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

/// The squares' triangles.
inline std::array<std::array<int, 3>, 12> CubeTriangles() {
  std::array<std::array<int, 3>, 12> triangles{};
  for (int i = 0; i < 6; ++i) {
    triangles[2 * i] = {kSquares[i][0], kSquares[i][1], kSquares[i][2]};
    triangles[2 * i + 1] = {kSquares[i][0], kSquares[i][2], kSquares[i][3]};
  }
  return triangles;
}

/// Replaces the first occurrence.
inline std::string With(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

/// The lowest bytes of a number, the least first or last.
inline std::string Bytes(std::uint64_t bits, int count, bool big = false) {
  std::string bytes;
  for (int i = 0; i < count; ++i) {
    bytes += static_cast<char>(bits >> (8 * (big ? count - 1 - i : i)) & 0xff);
  }
  return bytes;
}

inline std::string FloatBytes(float value, bool big = false) {
  return Bytes(std::bit_cast<std::uint32_t>(value), 4, big);
}

inline std::string CubeObj() {
  std::ostringstream text;
  text << "# a cube of squares\nmtllib none.mtl\no cube\n";
  for (const auto& p : kCube) text << "v " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  text << "vt 0 0\nvn 0 0 1\nusemtl paint\ns off\n";
  for (const auto& square : kSquares) {
    text << 'f';
    for (const int i : square) text << ' ' << i + 1 << "/1/1";
    text << '\n';
  }
  return text.str();
}

inline std::string CubeStlText() {
  std::ostringstream text;
  text << "solid cube\n";
  for (const auto& triangle : CubeTriangles()) {
    text << "facet normal 0 0 0\n outer loop\n";
    for (const int i : triangle) {
      text << "  vertex " << kCube[i][0] << ' ' << kCube[i][1] << ' ' << kCube[i][2] << '\n';
    }
    text << " endloop\nendfacet\n";
  }
  text << "endsolid cube\n";
  return text.str();
}

/// Many programs begin their binary files as a text begins.
inline std::string CubeStlBinary() {
  std::string bytes = "solid but binary";
  bytes.resize(80);
  bytes += Bytes(12, 4);
  for (const auto& triangle : CubeTriangles()) {
    bytes += std::string(12, '\0');
    for (const int i : triangle) {
      for (const int x : kCube[i]) bytes += FloatBytes(static_cast<float>(x));
    }
    bytes += Bytes(0, 2);
  }
  return bytes;
}

inline std::string PlyHeader(const std::string& format) {
  return "ply\nformat " + format +
         " 1.0\ncomment a cube\nelement vertex 8\nproperty float x\nproperty float y\n"
         "property float z\nelement face 6\nproperty list uchar int vertex_indices\nend_header\n";
}

inline std::string CubePlyText() {
  std::ostringstream text;
  text << PlyHeader("ascii");
  for (const auto& p : kCube) text << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  for (const auto& s : kSquares) {
    text << "4 " << s[0] << ' ' << s[1] << ' ' << s[2] << ' ' << s[3] << '\n';
  }
  return text.str();
}

inline std::string CubePlyBinary(bool big) {
  std::string bytes = PlyHeader(big ? "binary_big_endian" : "binary_little_endian");
  for (const auto& p : kCube) {
    for (const int x : p) bytes += FloatBytes(static_cast<float>(x), big);
  }
  for (const auto& square : kSquares) {
    bytes += '\4';
    for (const int i : square) bytes += Bytes(static_cast<std::uint64_t>(i), 4, big);
  }
  return bytes;
}

/// Positions, then indices of two bytes.
inline std::string CubeBuffer() {
  std::string bytes;
  for (const auto& p : kCube) {
    for (const int x : p) bytes += FloatBytes(static_cast<float>(x));
  }
  for (const auto& triangle : CubeTriangles()) {
    for (const int i : triangle) bytes += Bytes(static_cast<std::uint64_t>(i), 2);
  }
  return bytes;
}

/// `uri`: where the buffer is, ,"uri":"..." or nothing.
inline std::string CubeGltf(const std::string& uri) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
         R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
         R"("buffers":[{"byteLength":168)" +
         uri +
         R"(}],"bufferViews":[{"buffer":0,"byteLength":96},)"
         R"({"buffer":0,"byteOffset":96,"byteLength":72}],"accessors":[)"
         R"({"bufferView":0,"componentType":5126,"count":8,"type":"VEC3","min":[0,0,0],)"
         R"("max":[1,1,1]},{"bufferView":1,"componentType":5123,"count":36,"type":"SCALAR"}]})";
}

inline std::string GlbOf(std::string json, const std::string& buffer) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  return "glTF" + Bytes(2, 4) + Bytes(28 + json.size() + buffer.size(), 4) + Bytes(json.size(), 4) +
         "JSON" + json + Bytes(buffer.size(), 4) + std::string("BIN\0", 4) + buffer;
}

inline std::string CubeGlb() { return GlbOf(CubeGltf(""), CubeBuffer()); }

}  // namespace collision::client
