#include <google/protobuf/struct.pb.h>
#include <google/protobuf/util/json_util.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <vector>

#include "client/mesh/scan.h"

namespace collision::client {
namespace {

using google::protobuf::Struct;
using google::protobuf::Value;

constexpr std::uint64_t kGltfDepthMax = 256;    ///< Assimp recurses once per level.
constexpr double kCountMax = 9007199254740992;  ///< 2^53: JSON's numbers are doubles.
constexpr std::string_view kBase64 = ";base64,";

[[noreturn]] void Fail(const std::string& cause) { throw std::runtime_error(cause); }

const Value* Find(const Struct& object, const std::string& name) {
  const auto field = object.fields().find(name);
  return field == object.fields().end() ? nullptr : &field->second;
}

/// A list in the document, with its place for messages.
std::vector<const Value*> List(const Struct& object, const std::string& name) {
  std::vector<const Value*> list;
  const Value* const value = Find(object, name);
  if (value == nullptr) return list;
  if (!value->has_list_value()) Fail(name + " is not a list");
  for (const Value& item : value->list_value().values()) list.push_back(&item);
  return list;
}

const Struct& ObjectOf(const Value& value, const std::string& what) {
  if (!value.has_struct_value()) Fail(what + " is not an object");
  return value.struct_value();
}

std::uint64_t CountOf(const Value& value, const std::string& what) {
  const double number = value.number_value();
  if (value.kind_case() == Value::kNumberValue && number >= 0 && number < kCountMax &&
      number == std::floor(number)) {
    return static_cast<std::uint64_t>(number);
  }
  Fail(what + " is not a whole number from 0 on");
}

std::uint64_t Count(const Struct& object, const std::string& name, std::uint64_t absent) {
  const Value* const value = Find(object, name);
  return value == nullptr ? absent : CountOf(*value, name);
}

std::string Text(const Struct& object, const std::string& name) {
  const Value* const value = Find(object, name);
  return value != nullptr ? value->string_value() : "";
}

std::string Named(const std::string& what, std::size_t index) {
  return what + " " + std::to_string(index);
}

class GltfScan {
 public:
  /// `chunk`: bytes of a GLB file's binary chunk; 0 without.
  GltfScan(const Struct& document, std::uint64_t chunk, const std::string& path)
      : document_(document), chunk_(chunk), path_(path) {}

  MeshScan Run() {
    RequireVersion();
    RequireKnownExtensions();
    Buffers();
    Views();
    Accessors();
    Nodes();
    const auto meshes = List(document_, "meshes");
    for (const std::uint64_t i : MeshesShown()) {
      const Struct& mesh = ObjectOf(*meshes[i], Named("mesh", i));
      for (const Value* primitive : List(mesh, "primitives")) {
        Primitive(ObjectOf(*primitive, "a primitive of " + Named("mesh", i)), Named("mesh", i));
      }
    }
    if (scan_.faces == 0) Fail("no faces (primitives of mode 4, 5 or 6) in its scene");
    return scan_;
  }

 private:
  struct Accessor {
    std::uint64_t count = 0;
    std::uint64_t component = 0;
    std::string type;
    bool has_data = false;
  };

  void RequireVersion() const {
    const Value* const asset = Find(document_, "asset");
    const std::string version =
        asset != nullptr ? Text(ObjectOf(*asset, "asset"), "version") : std::string();
    if (version.rfind("2.", 0) != 0) Fail("glTF version \"" + version + "\", allowed: 2.x");
  }

  /// Refuses required extensions, except those that change only the looks.
  void RequireKnownExtensions() const {
    for (const Value* extension : List(document_, "extensionsRequired")) {
      const std::string& name = extension->string_value();
      if (name.rfind("KHR_materials_", 0) == 0 || name.rfind("KHR_texture_", 0) == 0) continue;
      Fail("it requires the extension \"" + name + "\", which is not read");
    }
  }

  std::uint64_t BytesBehind(const std::string& uri, std::size_t index) const {
    if (uri.empty()) return index == 0 ? chunk_ : 0;
    if (uri.rfind("data:", 0) == 0) {
      const std::size_t start = uri.find(kBase64);
      if (start == uri.npos) Fail(Named("buffer", index) + ": data that is not base64");
      const std::string_view code = std::string_view(uri).substr(start + kBase64.size());
      const std::size_t end = code.find_last_not_of('=');
      return end == code.npos ? 0 : (end + 1) * 3 / 4;
    }
    std::error_code error;
    const auto size =
        std::filesystem::file_size(std::filesystem::path(path_).parent_path() / uri, error);
    if (error) Fail(Named("buffer", index) + ": file \"" + uri + "\" beside it cannot be read");
    return size;
  }

  void Buffers() {
    const auto buffers = List(document_, "buffers");
    for (std::size_t i = 0; i < buffers.size(); ++i) {
      const Struct& buffer = ObjectOf(*buffers[i], Named("buffer", i));
      const std::uint64_t bytes = Count(buffer, "byteLength", 0);
      const std::uint64_t there = BytesBehind(Text(buffer, "uri"), i);
      if (there < bytes) {
        Fail(Named("buffer", i) + " has " + std::to_string(there) + " of its " +
             std::to_string(bytes) + " bytes: it is missing or cut off");
      }
      buffers_.push_back(bytes);
    }
  }

  void Views() {
    const auto views = List(document_, "bufferViews");
    for (std::size_t i = 0; i < views.size(); ++i) {
      const Struct& view = ObjectOf(*views[i], Named("bufferView", i));
      const std::uint64_t buffer = Count(view, "buffer", buffers_.size());
      const std::uint64_t bytes = Count(view, "byteLength", 0);
      if (buffer >= buffers_.size() || Count(view, "byteOffset", 0) + bytes > buffers_[buffer]) {
        Fail(Named("bufferView", i) + " reaches beyond its buffer");
      }
      views_.push_back({bytes, Count(view, "byteStride", 0)});
    }
  }

  static std::uint64_t ElementBytes(const Accessor& accessor, std::size_t index) {
    const std::pair<const char*, std::uint64_t> types[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3},
                                                           {"VEC4", 4},   {"MAT2", 4}, {"MAT3", 9},
                                                           {"MAT4", 16}};
    for (const auto& [type, components] : types) {
      if (accessor.type != type) continue;
      switch (accessor.component) {
        case 5120:
        case 5121:
          return components;
        case 5122:
        case 5123:
          return 2 * components;
        case 5125:
        case 5126:
          return 4 * components;
      }
    }
    Fail(Named("accessor", index) + " has an unknown type");
  }

  void Accessors() {
    const auto accessors = List(document_, "accessors");
    for (std::size_t i = 0; i < accessors.size(); ++i) {
      const Struct& object = ObjectOf(*accessors[i], Named("accessor", i));
      Accessor& accessor = accessors_.emplace_back();
      accessor.count = Count(object, "count", 0);
      accessor.component = Count(object, "componentType", 0);
      accessor.type = Text(object, "type");
      const std::uint64_t size = ElementBytes(accessor, i);
      if (Find(object, "sparse") != nullptr) Fail(Named("accessor", i) + " is sparse: not read");
      if (Find(object, "bufferView") == nullptr) continue;
      const std::uint64_t view = Count(object, "bufferView", 0);
      accessor.has_data = true;
      if (view >= views_.size()) Fail(Named("accessor", i) + " has no bufferView");
      const auto [bytes, view_stride] = views_[view];
      const std::uint64_t stride = view_stride == 0 ? size : view_stride;
      const std::uint64_t offset = Count(object, "byteOffset", 0);
      const std::uint64_t steps = accessor.count == 0 ? 0 : accessor.count - 1;
      if (stride < size || offset > bytes || bytes - offset < size ||
          (bytes - offset - size) / stride < steps || accessor.count == 0) {
        Fail(Named("accessor", i) + " reaches beyond its bufferView");
      }
    }
  }

  /// Requires that each node has at most one parent, so that the scene is a tree.
  void Nodes() const {
    const auto nodes = List(document_, "nodes");
    std::vector<std::size_t> parents(nodes.size(), nodes.size());
    const std::size_t meshes = List(document_, "meshes").size();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Struct& node = ObjectOf(*nodes[i], Named("node", i));
      if (Find(node, "mesh") != nullptr && Count(node, "mesh", 0) >= meshes) {
        Fail(Named("node", i) + " names a mesh that is not there");
      }
      for (const Value* value : List(node, "children")) {
        const std::uint64_t child = CountOf(*value, "a child of " + Named("node", i));
        if (child >= nodes.size()) Fail(Named("node", i) + " names a child that is not there");
        if (parents[child] != nodes.size()) Fail(Named("node", child) + " has two parents");
        parents[child] = i;
      }
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) RequireShallow(parents, i);
    const auto scenes = List(document_, "scenes");
    if (Count(document_, "scene", 0) >= scenes.size()) Fail("it has no scene to show");
    for (const Value* scene : scenes) {
      for (const Value* value : List(ObjectOf(*scene, "a scene"), "nodes")) {
        if (CountOf(*value, "a scene's node") >= nodes.size())
          Fail("a scene names a node that is not there");
      }
    }
  }

  static void RequireShallow(const std::vector<std::size_t>& parents, std::size_t node) {
    std::uint64_t depth = 0;
    for (std::size_t at = node; parents[at] != parents.size(); at = parents[at]) {
      if (++depth > kGltfDepthMax) {
        Fail(Named("node", node) + " is deeper than " + std::to_string(kGltfDepthMax) +
             " nodes, or its own parent");
      }
    }
  }

  /// The meshes that the scene's nodes name: assimp reads no others.
  std::set<std::uint64_t> MeshesShown() const {
    const auto nodes = List(document_, "nodes");
    const Value& scene = *List(document_, "scenes")[Count(document_, "scene", 0)];
    std::vector<const Value*> waiting = List(ObjectOf(scene, "a scene"), "nodes");
    std::set<std::uint64_t> meshes, seen;
    while (!waiting.empty()) {
      const std::uint64_t index = CountOf(*waiting.back(), "a node");
      waiting.pop_back();
      if (!seen.insert(index).second) continue;
      const Struct& node = ObjectOf(*nodes[index], Named("node", index));
      for (const Value* child : List(node, "children")) waiting.push_back(child);
      if (Find(node, "mesh") != nullptr) meshes.insert(Count(node, "mesh", 0));
    }
    return meshes;
  }

  const Accessor& AccessorOf(const Value& value, const std::string& what) const {
    const std::uint64_t index = CountOf(value, what);
    if (index >= accessors_.size() || !accessors_[index].has_data) Fail(what + " has no data");
    return accessors_[index];
  }

  void Primitive(const Struct& primitive, const std::string& mesh) {
    const std::uint64_t mode = Count(primitive, "mode", 4);
    if (mode > 6) Fail("a primitive of " + mesh + " has mode " + std::to_string(mode));
    const Value* const attributes = Find(primitive, "attributes");
    const Value* const position =
        attributes != nullptr ? Find(ObjectOf(*attributes, "attributes"), "POSITION") : nullptr;
    if (position == nullptr) Fail("a primitive of " + mesh + " has no POSITION");
    const Accessor& positions = AccessorOf(*position, "POSITION of " + mesh);
    if (positions.type != "VEC3" || positions.component != 5126) {
      Fail("POSITION of " + mesh + " is not of three floats");
    }
    std::uint64_t corners = positions.count;
    if (const Value* const indices = Find(primitive, "indices")) {
      const Accessor& accessor = AccessorOf(*indices, "indices of " + mesh);
      if (accessor.type != "SCALAR" || accessor.component % 2 == 0) {
        Fail("indices of " + mesh + " are not unsigned whole numbers");
      }
      corners = accessor.count;
    }
    if (mode < 4) return;
    if (mode == 4 && corners % 3 != 0) {
      Fail("triangles of " + mesh + " have " + std::to_string(corners) +
           " corners, not a multiple of three");
    }
    scan_.faces += mode == 4 ? corners / 3 : corners - std::min<std::uint64_t>(corners, 2);
  }

  const Struct& document_;
  std::uint64_t chunk_;
  const std::string& path_;
  std::vector<std::uint64_t> buffers_;                          ///< Bytes.
  std::vector<std::pair<std::uint64_t, std::uint64_t>> views_;  ///< Bytes and stride.
  std::vector<Accessor> accessors_;
  MeshScan scan_;
};

MeshScan ScanDocument(std::string_view json, std::uint64_t chunk, const std::string& path) {
  Struct document;
  const auto status = google::protobuf::util::JsonStringToMessage(
      google::protobuf::StringPiece(json.data(), json.size()), &document);
  if (!status.ok()) Fail("not JSON, or cut off");
  return GltfScan(document, chunk, path).Run();
}

std::uint64_t Word(std::string_view text, std::size_t at) {
  std::uint64_t word = 0;
  for (int i = 3; i >= 0; --i) word = word << 8 | static_cast<unsigned char>(text[at + i]);
  return word;
}

constexpr std::size_t kGlbHeader = 12;  ///< Magic, version, length.
constexpr std::size_t kChunkHeader = 8;
constexpr std::uint64_t kJsonChunk = 0x4e4f534a;
constexpr std::uint64_t kBinaryChunk = 0x004e4942;

}  // namespace

MeshScan ScanGltf(std::string_view text, const std::string& path) {
  return ScanDocument(text, 0, path);
}

MeshScan ScanGlb(std::string_view text, const std::string& path) {
  if (text.size() < kGlbHeader + kChunkHeader || text.substr(0, 4) != "glTF") {
    Fail("not a GLB file, or cut off");
  }
  if (Word(text, 4) != 2) Fail("GLB version " + std::to_string(Word(text, 4)) + ", allowed: 2");
  if (Word(text, 8) != text.size()) {
    Fail("a GLB file of " + std::to_string(text.size()) + " bytes whose header says " +
         std::to_string(Word(text, 8)));
  }
  const std::uint64_t json = Word(text, 12);
  const std::size_t start = kGlbHeader + kChunkHeader;
  if (Word(text, 16) != kJsonChunk || json > text.size() - start) {
    Fail("the first chunk of the GLB file is not whole JSON");
  }
  std::uint64_t chunk = 0;
  const std::size_t next = start + json;
  if (text.size() - next >= kChunkHeader && Word(text, next + 4) == kBinaryChunk) {
    chunk = Word(text, next);
    if (chunk > text.size() - next - kChunkHeader) Fail("the binary chunk is cut off");
  }
  return ScanDocument(text.substr(start, json), chunk, path);
}

}  // namespace collision::client
