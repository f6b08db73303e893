#include "io/surface/gltf.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/base64.hpp"
#include "io/surface_text.hpp"

namespace thinwall::io {

namespace {

using nlohmann::json;

static_assert(std::endian::native == std::endian::little, "glTF's numbers are read as they lie");

constexpr int deepest_node = 32;
constexpr std::size_t most_gltf_triangles = 20'000'000, most_gltf_nodes = 100'000;

/// The file's name for messages.
struct GltfName {
  const std::string& name;

  [[noreturn]] void fail(const std::string& what) const { throw core::DataError(name + ": " + what); }
};

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

/// The JSON of a file, and the bytes of the binary chunk behind it; none in a text.
struct GltfChunks {
  std::string_view text;
  std::optional<std::string_view> binary;
};

GltfChunks chunks_of(std::string_view bytes, const GltfName& place) {
  constexpr std::uint32_t json_type = 0x4E4F534A, binary_type = 0x004E4942;
  if (!bytes.starts_with("glTF")) return {bytes, {}};
  if (bytes.size() < 20) place.fail("the binary glTF ends in its heading: it is not whole");
  if (const auto version = word_at(bytes, 4); version != 2)
    place.fail("binary glTF of version " + std::to_string(version) + "; version 2 is read");
  if (word_at(bytes, 8) > bytes.size())
    place.fail("the binary glTF holds " + std::to_string(bytes.size()) + " of " + std::to_string(word_at(bytes, 8)) +
               " bytes: it is not whole");
  GltfChunks found;
  for (std::size_t at = 12; at + 8 <= bytes.size();) {
    const std::size_t size = word_at(bytes, at), type = word_at(bytes, at + 4);
    if (size > bytes.size() - at - 8) place.fail("a chunk of the binary glTF ends beyond the file: it is not whole");
    const std::string_view content = bytes.substr(at + 8, size);
    if (at == 12 && type != json_type) place.fail("the binary glTF does not begin with its JSON");
    if (at == 12) found.text = content;
    else if (type == binary_type && !found.binary) found.binary = content;
    at += 8 + size;
  }
  return found;
}

/// The item of an array at the top of the document: "accessors" 3.
const json& gltf_item(const json& document, const char* list, std::size_t index, const GltfName& place) {
  const auto found = document.find(list);
  const std::size_t count = found != document.end() && found->is_array() ? found->size() : 0;
  if (index >= count || !(*found)[index].is_object())
    place.fail(std::string(list) + " has no item " + std::to_string(index) + " of " + std::to_string(count));
  return (*found)[index];
}

/// A whole number ≥ 0; `otherwise` if the key is absent.
std::size_t whole_number(const json& object, const char* key, std::optional<std::size_t> otherwise,
                         const GltfName& place) {
  const auto found = object.find(key);
  if (found == object.end() && otherwise) return *otherwise;
  if (found == object.end() || !found->is_number_unsigned() || found->get<std::uint64_t>() > UINT32_MAX)
    place.fail(std::string("\"") + key + "\" is missing or no whole number below 2^32");
  return found->get<std::size_t>();
}

/// `count` numbers of a key; `otherwise` if it is absent.
template <std::size_t count>
std::array<double, count> numbers_of(const json& object, const char* key, std::array<double, count> otherwise,
                                     const GltfName& place) {
  const auto found = object.find(key);
  if (found == object.end()) return otherwise;
  const auto is_number = [](const json& value) { return value.is_number(); };
  if (!found->is_array() || found->size() != count || !std::ranges::all_of(*found, is_number))
    place.fail(std::string("\"") + key + "\" is not of " + std::to_string(count) + " numbers");
  std::array<double, count> values{};
  for (std::size_t i = 0; i < count; ++i) values[i] = (*found)[i].get<double>();
  return values;
}

Eigen::Affine3d transform_of(const json& node, const GltfName& place) {
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  if (node.contains("matrix")) {
    const auto m = numbers_of<16>(node, "matrix", {}, place);  // column by column
    transform.matrix() = Eigen::Map<const Eigen::Matrix4d>(m.data());
    if (transform.matrix().row(3) != Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0))
      place.fail("a node's matrix has another last row than 0, 0, 0, 1");
    return transform;
  }
  const auto t = numbers_of<3>(node, "translation", {0.0, 0.0, 0.0}, place);
  const auto q = numbers_of<4>(node, "rotation", {0.0, 0.0, 0.0, 1.0}, place);
  const auto s = numbers_of<3>(node, "scale", {1.0, 1.0, 1.0}, place);
  const Eigen::Quaterniond turn(q[3], q[0], q[1], q[2]);
  if (!(std::abs(turn.norm() - 1.0) < 1e-3)) place.fail("a node's rotation is no unit quaternion");
  return Eigen::Translation3d(t[0], t[1], t[2]) * turn.normalized() * Eigen::Scaling(s[0], s[1], s[2]);
}

/// Bytes of an accessor: `count` values of `size` bytes, `stride` apart.
struct GltfValues {
  std::string_view bytes;
  std::size_t count = 0, stride = 0;
};

class GltfScene {
 public:
  GltfScene(const json& document, std::optional<std::string_view> binary, const GltfName& place)
      : document_(document), place_(place) {
    const auto buffers = document.find("buffers");
    const std::size_t count = buffers != document.end() && buffers->is_array() ? buffers->size() : 0;
    for (std::size_t i = 0; i < count; ++i) buffers_.push_back(buffer(i, binary));
    const std::size_t scene = whole_number(document, "scene", 0, place);
    for (const std::size_t root : list(gltf_item(document, "scenes", scene, place), "nodes"))
      show(root, Eigen::Affine3d::Identity(), 0);
  }

  mesh::TriangleSoup take() { return std::move(soup_); }

 private:
  struct Buffer {
    std::string owned;
    std::optional<std::string_view> chunk;
    [[nodiscard]] std::string_view bytes() const { return chunk ? *chunk : std::string_view(owned); }
  };

  [[nodiscard]] Buffer buffer(std::size_t index, std::optional<std::string_view> binary) const {
    const json& object = gltf_item(document_, "buffers", index, place_);
    Buffer result;
    const auto uri = object.find("uri");
    if (uri == object.end()) {
      if (index > 0 || !binary) place_.fail("buffer " + std::to_string(index) + " has no bytes");
      result.chunk = binary;
    } else {
      const std::string text = uri->is_string() ? uri->get<std::string>() : "";
      const std::size_t comma = text.find(";base64,");
      if (!text.starts_with("data:") || comma == std::string::npos)
        place_.fail("its numbers lie in another file, " + io::quoted(text) +
                    ", which is not read; export as .glb, or with embedded buffers");
      result.owned = decoded(std::string_view(text).substr(comma + 8), index);
    }
    const std::size_t size = whole_number(object, "byteLength", {}, place_);
    if (size > result.bytes().size())
      place_.fail("buffer " + std::to_string(index) + " holds " + std::to_string(result.bytes().size()) + " of " +
                  std::to_string(size) + " bytes");
    return result;
  }

  [[nodiscard]] std::string decoded(std::string_view text, std::size_t index) const {
    try {
      return from_base64(text);
    } catch (const core::DataError& error) {
      place_.fail("buffer " + std::to_string(index) + ": " + error.what());
    }
  }

  /// Indices in a list; empty where it is absent.
  [[nodiscard]] std::vector<std::size_t> list(const json& object, const char* key) const {
    std::vector<std::size_t> indices;
    const auto found = object.find(key);
    if (found == object.end()) return indices;
    for (const json& index : *found) {
      if (!index.is_number_unsigned()) place_.fail(std::string("\"") + key + "\" holds what is no index");
      indices.push_back(index.get<std::size_t>());
    }
    return indices;
  }

  void show(std::size_t index, const Eigen::Affine3d& parent, int depth) {
    if (++shown_ > most_gltf_nodes) place_.fail("more than " + std::to_string(most_gltf_nodes) + " nodes are shown");
    if (depth > deepest_node)
      place_.fail("node " + std::to_string(index) + " holds itself, or nodes are nested deeper than " +
                  std::to_string(deepest_node));
    const json& node = gltf_item(document_, "nodes", index, place_);
    const Eigen::Affine3d frame = parent * transform_of(node, place_);
    if (!frame.matrix().allFinite()) place_.fail("the transform of node " + std::to_string(index) + " is not finite");
    if (node.contains("mesh")) {
      if (node.contains("skin"))
        place_.fail("node " + std::to_string(index) + " bends its mesh by a skin, which is not read; export it rigid");
      const json& mesh = gltf_item(document_, "meshes", whole_number(node, "mesh", {}, place_), place_);
      const auto primitives = mesh.find("primitives");
      if (primitives == mesh.end() || !primitives->is_array()) place_.fail("a mesh has no primitives");
      for (const json& primitive : *primitives) add(primitive, frame);
    }
    for (const std::size_t child : list(node, "children")) show(child, frame, depth + 1);
  }

  [[nodiscard]] GltfValues values(std::size_t index, const std::string& type, std::size_t size) const {
    const json& accessor = gltf_item(document_, "accessors", index, place_);
    const std::string which = "accessor " + std::to_string(index);
    if (accessor.contains("sparse")) place_.fail(which + " is sparse, which is not read; export without");
    if (accessor.value("type", std::string()) != type) place_.fail(which + " is not of the type " + type);
    const json& view = gltf_item(document_, "bufferViews", whole_number(accessor, "bufferView", {}, place_), place_);
    const std::size_t buffer = whole_number(view, "buffer", {}, place_);
    if (buffer >= buffers_.size()) place_.fail(which + " lies in a buffer that is not there");
    const std::string_view all = buffers_[buffer].bytes();
    const std::size_t begin = whole_number(view, "byteOffset", 0, place_),
                      length = whole_number(view, "byteLength", {}, place_);
    const std::size_t offset = whole_number(accessor, "byteOffset", 0, place_);
    GltfValues found{{}, whole_number(accessor, "count", {}, place_), whole_number(view, "byteStride", size, place_)};
    const std::size_t needed = found.count == 0 ? 0 : (found.count - 1) * found.stride + size;
    if (begin > all.size() || length > all.size() - begin || offset > length || needed > length - offset ||
        found.stride < size)
      place_.fail(which + " reaches beyond its bytes");
    found.bytes = all.substr(begin + offset, needed);
    return found;
  }

  /// The corners of the triangles: those of the index accessor, else all points one after the other.
  [[nodiscard]] std::vector<std::size_t> corners(const json& primitive, std::size_t points) const {
    std::vector<std::size_t> result;
    if (!primitive.contains("indices")) {
      result.resize(points);
      for (std::size_t i = 0; i < points; ++i) result[i] = i;
      return result;
    }
    const std::size_t index = whole_number(primitive, "indices", {}, place_);
    const std::size_t kind =
        whole_number(gltf_item(document_, "accessors", index, place_), "componentType", {}, place_);
    const std::size_t size = kind == 5121 ? 1 : kind == 5123 ? 2 : kind == 5125 ? 4 : 0;
    if (size == 0) place_.fail("indices of the component type " + std::to_string(kind) + ", which is no index");
    const GltfValues found = values(index, "SCALAR", size);
    result.reserve(found.count);
    for (std::size_t i = 0; i < found.count; ++i) {
      std::uint32_t corner = 0;
      std::memcpy(&corner, found.bytes.data() + i * found.stride, size);
      if (corner >= points)
        place_.fail("a triangle names point " + std::to_string(corner) + " of " + std::to_string(points));
      result.push_back(corner);
    }
    return result;
  }

  void add(const json& primitive, const Eigen::Affine3d& frame) {
    const std::size_t mode = whole_number(primitive, "mode", 4, place_);
    if (mode < 4) return;  // points and lines
    if (mode > 4) place_.fail("triangles as strips or fans (mode " + std::to_string(mode) + ") are not read");
    if (primitive.contains("targets")) place_.fail("a mesh has morph targets, which are not read; export it rigid");
    const auto attributes = primitive.find("attributes");
    if (attributes == primitive.end() || !attributes->contains("POSITION")) return;
    const std::size_t position = whole_number(*attributes, "POSITION", {}, place_);
    if (const auto kind =
            whole_number(gltf_item(document_, "accessors", position, place_), "componentType", {}, place_);
        kind != 5126)
      place_.fail("positions of the component type " + std::to_string(kind) + "; 5126 (float) is read");
    const GltfValues points = values(position, "VEC3", 12);
    const std::vector<std::size_t> at = corners(primitive, points.count);
    if (at.size() % 3 != 0) place_.fail(std::to_string(at.size()) + " corners are no whole number of triangles");
    if (soup_.points.size() + points.count > most_gltf_triangles ||
        soup_.triangles.size() + at.size() / 3 > most_gltf_triangles)
      place_.fail("more than " + std::to_string(most_gltf_triangles) + " triangles or points");
    const std::size_t first = soup_.points.size();
    for (std::size_t i = 0; i < points.count; ++i) {
      Eigen::Vector3f x;
      std::memcpy(x.data(), points.bytes.data() + i * points.stride, 12);
      soup_.points.emplace_back(frame * x.cast<double>());
      if (!soup_.points.back().allFinite()) place_.fail("point " + std::to_string(i) + " of a mesh is not finite");
    }
    const bool mirrored = frame.linear().determinant() < 0.0;
    const auto corner = [&](std::size_t k) { return static_cast<int>(first + at[k]); };
    for (std::size_t k = 0; k < at.size(); k += 3)
      soup_.triangles.push_back({corner(k), corner(mirrored ? k + 2 : k + 1), corner(mirrored ? k + 1 : k + 2)});
  }

  const json& document_;
  const GltfName& place_;
  std::vector<Buffer> buffers_;
  mesh::TriangleSoup soup_;
  std::size_t shown_ = 0;
};

/// Throws for another version, and for a required extension that may change shapes.
void check_what_is_needed(const json& document, const GltfName& place) {
  const auto asset = document.find("asset");
  const std::string version = asset != document.end() && asset->is_object() ? asset->value("version", "") : "";
  if (!version.starts_with("2.")) place.fail("glTF of version " + io::quoted(version) + "; version 2.0 is read");
  const auto required = document.find("extensionsRequired");
  if (required == document.end()) return;
  for (const json& extension : *required) {
    const std::string word = extension.is_string() ? extension.get<std::string>() : "";
    const auto begins = [&](const char* with) { return word.starts_with(with); };
    if (!begins("KHR_materials_") && !begins("KHR_texture_") && !begins("KHR_lights_"))
      place.fail("it needs the extension " + io::quoted(word) + ", which is not read; export without compression");
  }
}

}  // namespace

GltfSurface gltf_surface(std::string_view bytes, const std::string& name) {
  const GltfName place{name};
  const GltfChunks chunks = chunks_of(bytes, place);
  GltfSurface result;
  try {
    const json document = json::parse(chunks.text);
    if (!document.is_object()) place.fail("the glTF is no JSON object");
    check_what_is_needed(document, place);
    result.soup = GltfScene(document, chunks.binary, place).take();
  } catch (const json::exception& error) {
    std::string why = error.what();
    std::ranges::replace(why, '\n', ' ');
    place.fail("is no glTF: " + why);
  }
  if (result.soup.triangles.empty()) place.fail("the scene shows no triangles");
  return result;
}

GltfSurface read_gltf(const std::filesystem::path& path) {
  return gltf_surface(core::read_file(path), path.string());
}

}  // namespace thinwall::io
