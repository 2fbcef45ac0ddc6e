// Goal:   a mesh file becomes exactly the mesh it holds, in the unit and axes that were stated;
//         a damaged, truncated or empty file is refused with its name and the cause, never read in
//         part.
// Method: one cube written in every format, then damaged, and truncated everywhere.
#include "client/mesh/mesh_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>

#include "tests/client/mesh/mesh_fixtures.h"

namespace collision::client {
namespace {

class MeshFileTest : public testing::Test {
 protected:
  MeshFileTest() {
    folder_ =
        std::filesystem::temp_directory_path() / ("mesh_file_test." + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  ~MeshFileTest() override { std::filesystem::remove_all(folder_); }

  std::string Write(const std::string& name, const std::string& bytes) const {
    const std::string path = folder_ / name;
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }

  std::shared_ptr<const Shape> Load(const std::string& name, const std::string& bytes,
                                    MeshFileOptions options = {.unit_m = 1, .up = UpAxis::kZ}) {
    return LoadShape(Write(name, bytes), options, &report_);
  }

  /// Why the file is refused, without its name; empty: it is not.
  std::string Refusal(const std::string& name, const std::string& bytes) {
    const std::string path = Write(name, bytes);
    try {
      LoadShape(path, {.unit_m = 1, .up = UpAxis::kZ}, nullptr);
    } catch (const std::runtime_error& error) {
      const std::string cause = error.what();
      EXPECT_EQ(cause.rfind(path + ": ", 0), 0u) << cause;
      return cause.substr(std::min(cause.size(), path.size() + 2));
    }
    return "";
  }

  void ExpectRefusal(const std::string& name, const std::string& bytes, const std::string& cause) {
    const std::string refusal = Refusal(name, bytes);
    EXPECT_NE(refusal.find(cause), std::string::npos) << name << ": \"" << refusal << "\"";
  }

  std::filesystem::path folder_;
  MeshFileReport report_;
};

/// Every format; the tests that use glTF write its buffer.
std::map<std::string, std::string> Cubes() {
  return {{"text.stl", CubeStlText()},      {"binary.stl", CubeStlBinary()},
          {"text.ply", CubePlyText()},      {"little.ply", CubePlyBinary(false)},
          {"big.ply", CubePlyBinary(true)}, {"cube.obj", CubeObj()},
          {"cube.glb", CubeGlb()},          {"cube.gltf", CubeGltf(R"(,"uri":"cube.bin")")}};
}

double VolumeOf(const Triangles& mesh) {
  double volume = 0;
  for (const auto& [i, j, k] : mesh.indices) {
    const Vector3 &a = mesh.vertices_m[i], &b = mesh.vertices_m[j], &c = mesh.vertices_m[k];
    volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
               a[2] * (b[0] * c[1] - b[1] * c[0])) /
              6;
  }
  return volume;
}

TEST_F(MeshFileTest, EveryFormatHoldsTheSameCube) {
  Write("cube.bin", CubeBuffer());
  for (const auto& [name, bytes] : Cubes()) {
    const auto shape = Load(name, bytes);
    EXPECT_EQ(shape->triangles().indices.size(), 12u) << name;
    EXPECT_EQ(shape->triangles().vertices_m.size(), 8u) << name;
    EXPECT_TRUE(shape->closed()) << name;
    EXPECT_NEAR(VolumeOf(shape->triangles()), 1, 1e-12) << name << " turned inside out";
    EXPECT_NEAR(report_.radius_m, std::sqrt(3), 1e-12) << name;
    EXPECT_TRUE(report_.closed);
    const bool squares = name.find("ply") != name.npos || name.find("obj") != name.npos;
    EXPECT_EQ(report_.split, squares ? 6u : 0u) << name;
    EXPECT_EQ(report_.faces, squares ? 6u : 12u) << name;
    EXPECT_EQ(report_.dropped, 0u) << name;
  }
}

TEST_F(MeshFileTest, TheReportIsALine) {
  Load("cube.obj", CubeObj());
  EXPECT_EQ(report_.Text("cube.obj"),
            "cube.obj: 12 triangles (6 faces split, 0 degenerate faces dropped), closed, radius "
            "1.733 m");
  const std::string open = With(CubeObj(), "f 1/1/1 4/1/1 3/1/1 2/1/1", "f 1 1 2\nf 1 2");
  Load("open.obj", open);
  EXPECT_EQ(report_.faces, 7u);
  EXPECT_EQ(report_.Text("open.obj"),
            "open.obj: 10 triangles (5 faces split, 2 degenerate faces dropped), open: a surface "
            "without inside, radius 1.733 m");
}

// Stated, never guessed: glTF too, although it is y up by definition.
TEST_F(MeshFileTest, UnitAxisAndReferencePointAreThoseStated) {
  const std::string wedge =
      "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 4\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  const auto sides = [&](MeshFileOptions options) {
    const auto shape = Load("wedge.obj", wedge, options);
    EXPECT_GT(VolumeOf(shape->triangles()), 0) << "mirrored";
    Vector3 lower = shape->triangles().vertices_m[0], upper = lower;
    for (const Vector3& p : shape->triangles().vertices_m) {
      for (int i = 0; i < 3; ++i) {
        lower[i] = std::min(lower[i], p[i]);
        upper[i] = std::max(upper[i], p[i]);
      }
    }
    return std::array<Vector3, 2>{lower, upper};
  };
  using Sides = std::array<Vector3, 2>;
  EXPECT_EQ(sides({.unit_m = 1, .up = UpAxis::kZ}), (Sides{{{0, 0, 0}, {1, 2, 4}}}));
  EXPECT_EQ(sides({.unit_m = 0.5, .up = UpAxis::kZ}), (Sides{{{0, 0, 0}, {0.5, 1, 2}}}));
  EXPECT_EQ(sides({.unit_m = 1, .up = UpAxis::kY}), (Sides{{{0, 0, 0}, {4, 1, 2}}}));
  EXPECT_EQ(sides({.unit_m = 1, .up = UpAxis::kX}), (Sides{{{0, 0, 0}, {2, 4, 1}}}));
  EXPECT_EQ(sides({.unit_m = 1, .up = UpAxis::kZ, .reference_m = {1, 2, 3}}),
            (Sides{{{-1, -2, -3}, {0, 0, 1}}}));
  EXPECT_EQ(sides({.unit_m = 2, .up = UpAxis::kY, .centre = true}),
            (Sides{{{-4, -1, -2}, {4, 1, 2}}}));
  Write("cube.bin", CubeBuffer());
  const std::string tall =
      With(CubeGltf(R"(,"uri":"cube.bin")"), "{\"mesh\":0}", R"({"mesh":0,"scale":[1,3,1]})");
  const auto z_of_top = [&](UpAxis up) {
    const auto shape = Load("tall.gltf", tall, {.unit_m = 1, .up = up});
    double z = 0;
    for (const Vector3& p : shape->triangles().vertices_m) z = std::max(z, p[2]);
    return z;
  };
  EXPECT_EQ(z_of_top(UpAxis::kZ), 1);
  EXPECT_EQ(z_of_top(UpAxis::kY), 3);
}

TEST_F(MeshFileTest, OptionsOutOfRangeAreNamed) {
  const std::string path = Write("cube.obj", CubeObj());
  for (const double unit : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(LoadShape(path, {.unit_m = unit, .up = UpAxis::kZ}, nullptr),
                 std::invalid_argument);
  }
  EXPECT_THROW(LoadShape(path, {.unit_m = 1}, nullptr), std::invalid_argument);
  EXPECT_THROW(LoadShape(path, {.unit_m = 1, .up = UpAxis::kZ, .reference_m = {std::nan(""), 0, 0}},
                         nullptr),
               std::invalid_argument);
}

TEST_F(MeshFileTest, AWrongUnitMakesAPointOrAPlanet) {
  const std::string path = Write("cube.obj", CubeObj());
  for (const double unit : {1e-300, 1e-9, 1e9, 1e300}) {
    EXPECT_THROW(LoadShape(path, {.unit_m = unit, .up = UpAxis::kZ}, nullptr), std::runtime_error)
        << unit;
  }
}

// Nodes place a mesh several times, also mirrored: then its outside is on the other side.
TEST_F(MeshFileTest, NodesPlaceTheirMeshes) {
  const std::string nodes =
      R"("nodes":[{"mesh":0,"children":[1]},{"mesh":0,"scale":[-2,1,1],"translation":[-1,0,0]}])";
  const auto shape =
      Load("two.glb", GlbOf(With(CubeGltf(""), R"("nodes":[{"mesh":0}])", nodes), CubeBuffer()));
  EXPECT_EQ(report_.faces, 24u);
  EXPECT_TRUE(shape->closed());
  EXPECT_NEAR(VolumeOf(shape->triangles()), 3, 1e-12);
}

// Files often keep meshes that no node shows.
TEST_F(MeshFileTest, OnlyMeshesOfTheSceneAreRead) {
  const std::string hidden =
      With(With(CubeGltf(""), R"("meshes":[)",
                R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]},)"),
           R"({"mesh":0})", R"({"mesh":1},{"mesh":0})");
  EXPECT_TRUE(Load("hidden.glb", GlbOf(hidden, CubeBuffer()))->closed());
  EXPECT_EQ(report_.faces, 12u);
}

TEST_F(MeshFileTest, MissingUnknownAndEmptyFilesAreRefused) {
  EXPECT_THROW(LoadShape(folder_ / "none.obj", {.unit_m = 1, .up = UpAxis::kZ}, nullptr),
               std::runtime_error);
  EXPECT_THROW(LoadShape(folder_, {.unit_m = 1, .up = UpAxis::kZ}, nullptr), std::runtime_error);
  ExpectRefusal("cube.fbx", CubeObj(), "format \".fbx\" is unknown, allowed: .obj");
  ExpectRefusal("cube", CubeObj(), "is unknown");
  EXPECT_EQ(Load("CUBE.OBJ", CubeObj())->triangles().indices.size(), 12u);
  for (const auto& [name, bytes] : Cubes()) {
    ExpectRefusal(name, "", "the file is empty");
    EXPECT_NE(Refusal(name, std::string(1000, '\0')), "") << name;
    EXPECT_NE(Refusal(name, "not a mesh at all\n"), "") << name;
  }
}

// OBJ has no end mark: a file cut between two faces is a smaller mesh, and an open one.
TEST_F(MeshFileTest, CutOffAnywhereIsRefused) {
  Write("cube.bin", CubeBuffer());
  for (const auto& [name, bytes] : Cubes()) {
    if (name == "cube.obj") continue;
    const bool text = name.find("text") != name.npos;
    const std::size_t spare = text ? 6 : 0;  // A last newline, or the name after endsolid.
    const std::size_t whole = bytes.size() - spare;
    for (std::size_t length = 1; length < whole; length += length + 12 < whole ? 11 : 1) {
      EXPECT_NE(Refusal(name, bytes.substr(0, length)), "") << name << " at " << length;
    }
  }
  const std::string obj = CubeObj();
  for (std::size_t length = 1; length + 8 < obj.size(); length += 3) {
    const std::string path = Write("cube.obj", obj.substr(0, length));
    try {
      EXPECT_FALSE(LoadShape(path, {.unit_m = 1, .up = UpAxis::kZ}, nullptr)->closed()) << length;
    } catch (const std::runtime_error&) {
    }
  }
}

TEST_F(MeshFileTest, MalformedObjIsRefused) {
  ExpectRefusal("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n",
                "line 4: a face names v 4, the file has 3");
  ExpectRefusal("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n", "line 4: a face's corner: \"0\"");
  ExpectRefusal("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4\n", "\"-4\"");
  ExpectRefusal("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/2 2 3\n", "names vt 2, the file has 0");
  ExpectRefusal("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1//-1 2 3\n", "\"1//-1\"");
  ExpectRefusal("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 three\n", "\"three\"");
  ExpectRefusal("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99999999999999999999\n", "line 4");
  ExpectRefusal("a.obj", "v 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
                "line 1: a vertex's coordinate: \"\"");
  ExpectRefusal("a.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "\"nan\"");
  ExpectRefusal("a.obj", "v 0 0 1e999\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "\"1e999\"");
  ExpectRefusal("a.obj", "v 0 0 1e39\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "not a finite number");
  ExpectRefusal("a.obj", "v 0 0 0 2\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "weight");
  ExpectRefusal("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\np 3\n", "no faces");
  ExpectRefusal("a.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 2\n",
                "all 2 faces are degenerate");
}

TEST_F(MeshFileTest, OddButSoundObjIsRead) {
  const std::string odd =
      "f 1 2 3\r\nv 0 0 0 1 # origin\r\n\r\nv 1 0 0 0.5 0.5 0.5\r\nv 0 1e-400 0\r\nv 0 1 0\r\n"
      "vt 0 0\nf -4/1 \\\n -3/ -1 # after a turn\nusemtl x\nf 1//\nl 1 2\nf\n";
  EXPECT_EQ(Load("odd.obj", odd)->triangles().indices.size(), 1u);
  EXPECT_EQ(report_.faces, 4u);
  EXPECT_EQ(report_.dropped, 3u);
}

TEST_F(MeshFileTest, MalformedStlIsRefused) {
  const std::string binary = CubeStlBinary();
  ExpectRefusal("a.stl", binary + " ", "whose header says 12 triangles, which take 684 bytes");
  std::string wrong = binary;
  wrong.replace(80, 4, "\xff\xff\xff\xff");
  ExpectRefusal("a.stl", wrong, "header says 4294967295 triangles");
  wrong = binary;
  wrong.replace(84 + 12, 4, FloatBytes(std::nanf("")));
  ExpectRefusal("a.stl", wrong, "not a finite number");
  ExpectRefusal("a.stl", binary.substr(0, 80) + Bytes(0, 4), "no faces");
  const std::string text = CubeStlText();
  ExpectRefusal("a.stl", "solid empty\nendsolid empty\n", "no faces");
  ExpectRefusal("a.stl", With(text, "vertex 0 0 0", "vertex 0 0 nan"), "line 4: a vertex's");
  ExpectRefusal("a.stl", With(text, "vertex 0 0 0", "vertex 0 0"), "line 5");
  ExpectRefusal("a.stl", With(text, " endloop", "vertex 0 0 0\n endloop"), "\"endloop\" should be");
  ExpectRefusal("a.stl", With(text, "endfacet\n", ""), "\"endfacet\" should be");
  EXPECT_EQ(Load("two.stl", text + text)->triangles().indices.size(), 24u);
}

TEST_F(MeshFileTest, MalformedPlyIsRefused) {
  const std::string text = CubePlyText();
  ExpectRefusal("a.ply", With(text, "4 0 3 2 1", "4 0 3 2 8"), "names vertex 8");
  ExpectRefusal("a.ply", With(text, "4 0 3 2 1", "4 0 3 2 -1"), "names vertex -1");
  ExpectRefusal("a.ply", With(text, "4 0 3 2 1", "4 0 3 2 x"), "\"x\" is not a number");
  ExpectRefusal("a.ply", With(text, "4 0 3 2 1", "-4 0 3 2 1"), "of negative length");
  ExpectRefusal("a.ply", With(text, "1 1 1\n", "1 nan 1\n"), "not a finite number");
  ExpectRefusal("a.ply", With(text, "vertex 8", "vertex 4294967295"), "cut off");
  ExpectRefusal("a.ply", With(text, "face 6", "face 99999999999"), "cut off");
  ExpectRefusal("a.ply", With(text, "float x", "quad x"), "\"quad\" of a property is unknown");
  ExpectRefusal("a.ply", With(text, "list uchar int", "list uchar float"), "floating-point");
  ExpectRefusal("a.ply", With(text, "format ascii", "format roman"), "unknown format");
  ExpectRefusal("a.ply", With(text, "vertex_indices", "none"), "no faces");
  ExpectRefusal("a.ply", With(text, "property float y", "propyter float y"),
                "line 6: \"propyter\", allowed: comment, element, format, obj_info or property");
  ExpectRefusal("a.ply", With(text, "float x", "float"), "line 5: a property without a name");
  ExpectRefusal("a.ply", With(text, "ply\n", "ply element vertex 8\n"),
                "line 1: not \"ply\" alone");
  ExpectRefusal("a.ply", With(text, "end_header", "end_header x\nend_header"),
                "\"end_header\", all");
  ExpectRefusal("a.ply", With(text, "format", "format ascii 1.0\nformat"), "format is there twice");
  ExpectRefusal("a.ply", With(text, "format", "comment x\relement vertex 9\nformat"),
                "line 2: a con");
  ExpectRefusal("a.ply", With(text, "float x", "float x z"), "line 5: \"z\" after the end");
  ExpectRefusal("a.ply", With(text, "float y", "float x"), "property \"x\" of \"vertex\" is there");
  ExpectRefusal("a.ply", With(text, "element face 6", "element vertex 6"), "\"vertex\" is there");
  const std::string list = "property list uchar int vertex_ind";
  ExpectRefusal("a.ply", With(text, list + "ices", list + "ices\n" + list + "ex"),
                "line 10: property \"vertex_index\" of \"face\" is there twice");
  const std::string cloud =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty "
      "float y\nproperty float z\nend_header\n0 0 0\n1 0 0\n0 1 0\n";
  ExpectRefusal("a.ply", cloud, "no faces");
  for (const bool big : {false, true}) {
    std::string wrong = CubePlyBinary(big);
    wrong.replace(wrong.size() - 4, 4, Bytes(8, 4, big));
    ExpectRefusal("a.ply", wrong, "names vertex 8");
    wrong.replace(wrong.size() - 4, 4, Bytes(0xffffffff, 4, big));
    ExpectRefusal("a.ply", wrong, "names vertex -1");
    ExpectRefusal("a.ply", With(CubePlyBinary(big), "vertex 8", "vertex 18446744073709551615"),
                  "cut off");
  }
}

TEST_F(MeshFileTest, MalformedGltfIsRefused) {
  const std::string json = CubeGltf("");
  const auto glb = [&](const std::string& what, const std::string& by) {
    return GlbOf(With(json, what, by), CubeBuffer());
  };
  ExpectRefusal("a.gltf", CubeGltf(R"(,"uri":"none.bin")"), "file \"none.bin\" beside it");
  Write("short.bin", CubeBuffer().substr(0, 167));
  ExpectRefusal("a.gltf", CubeGltf(R"(,"uri":"short.bin")"), "167 of its 168 bytes");
  ExpectRefusal("a.gltf", json, "0 of its 168 bytes");
  ExpectRefusal("a.gltf", CubeGltf(R"(,"uri":"data:;base64,AAAA")"), "3 of its 168 bytes");
  ExpectRefusal("a.glb", glb("\"2.0\"", "\"1.0\""), "version \"1.0\"");
  ExpectRefusal("a.glb",
                glb("\"scene\":0", R"("extensionsRequired":["KHR_draco_mesh_compression"])"),
                "KHR_draco_mesh_compression");
  ExpectRefusal("a.glb", glb("\"count\":8", "\"count\":9"), "accessor 0 reaches beyond");
  ExpectRefusal("a.glb", glb("\"count\":36", "\"count\":1e15"), "accessor 1 reaches beyond");
  ExpectRefusal("a.glb", glb("\"count\":36", "\"count\":35"), "35 corners");
  ExpectRefusal("a.glb", glb("\"count\":8", "\"count\":-8"), "count is not a whole number");
  ExpectRefusal("a.glb", glb("\"byteLength\":72", "\"byteLength\":73"),
                "bufferView 1 reaches beyond");
  ExpectRefusal("a.glb", glb("\"indices\":1", "\"indices\":2"), "indices of mesh 0 has no data");
  ExpectRefusal("a.glb", glb("\"indices\":1", "\"indices\":1,\"mode\":1"), "no faces");
  ExpectRefusal("a.glb", glb("{\"mesh\":0}", "{\"mesh\":1}"), "a mesh that is not there");
  ExpectRefusal("a.glb", glb("{\"mesh\":0}", "{\"mesh\":0,\"children\":[0]}"), "its own parent");
  ExpectRefusal("a.glb", glb("{\"mesh\":0}", "{}"), "no faces (primitives of mode 4, 5 or 6) in");
  std::string buffer = CubeBuffer();
  buffer.replace(96, 2, Bytes(8, 2));
  ExpectRefusal("a.glb", GlbOf(json, buffer), "11 of its 12 faces");
  buffer = CubeBuffer();
  buffer.replace(0, 4, FloatBytes(std::nanf("")));
  ExpectRefusal("a.glb", GlbOf(json, buffer), "not a finite number");
  ExpectRefusal("a.glb", With(CubeGlb(), "glTF", "glTX"), "not a GLB file");
  ExpectRefusal("a.glb", CubeGlb() + " ", "whose header says");
}

}  // namespace
}  // namespace collision::client
