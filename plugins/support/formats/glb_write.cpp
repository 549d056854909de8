// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "formats/glb.hpp"
#include "formats/glb_colour.hpp"
#include "formats/out_fields.hpp"

namespace velum::formats {
namespace {

using json = nlohmann::json;

constexpr Index kGrain = 65536;
/// Numbers of the standard.
constexpr int kFloat = 5126;
constexpr int kU16 = 5123;
constexpr int kU32 = 5125;
constexpr int kPoints = 0;
constexpr int kTriangles = 4;

Eigen::Vector3f y_up(const Eigen::Vector3f& p) {
  return {p.x(), p.z(), -p.y()};
}

std::string raw(std::uint32_t value) {
  char bytes[4];
  std::memcpy(bytes, &value, sizeof(bytes));
  return {bytes, sizeof(bytes)};
}

std::string vectors_of(const ConstPoints& points, Index begin, Index end) {
  std::string bytes;
  bytes.reserve(static_cast<std::size_t>(end - begin) * 12);
  for (Index i = begin; i < end; ++i) {
    const Eigen::Vector3f turned = y_up(points.col(i));
    bytes.append(reinterpret_cast<const char*>(turned.data()), 12);  // NOLINT
  }
  return bytes;
}

std::string colours_of(const Column& column, Index begin, Index end) {
  static const std::array<std::uint16_t, 256> kLinear = [] {
    std::array<std::uint16_t, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i)
      table[i] = linear_of(static_cast<std::uint8_t>(i));
    return table;
  }();
  const auto colours = column.as<std::uint8_t>();
  std::string bytes;
  for (Index i = begin; i < end; ++i) {
    const std::uint16_t rgba[4] = {kLinear[colours(0, i)], kLinear[colours(1, i)],
                                   kLinear[colours(2, i)], 65535};
    bytes.append(reinterpret_cast<const char*>(rgba), sizeof(rgba));  // NOLINT
  }
  return bytes;
}

class GlbWriter {
 public:
  GlbWriter(AtomicFile& file, const Mesh& mesh, Context& context)
      : file_(file), mesh_(mesh), context_(context) {}

  void write() {
    const Index count = mesh_.vertices().size();
    root_["asset"] = json::object({{"version", "2.0"}, {"generator", "Velum"}});
    root_["scene"] = 0;
    root_["scenes"][0]["nodes"] = json::array({0});
    root_["nodes"][0]["name"] = "mesh";
    const Eigen::Vector3d& origin = mesh_.origin();
    if (!origin.isZero(0.0))
      root_["nodes"][0]["translation"] = json::array({origin.x(), origin.z(), -origin.y()});
    if (count > 0) describe(count);
    write_header();
    if (count > 0) write_binary(count);
  }

 private:
  [[nodiscard]] bool has(const char* name) const { return mesh_.vertices().has(name); }

  void describe(Index count) {
    json& primitive = root_["meshes"][0]["primitives"][0];
    primitive["mode"] = mesh_.empty() ? kPoints : kTriangles;
    primitive["material"] = 0;
    json& attributes = primitive["attributes"];
    const Eigen::Vector3f low = mesh_.positions().rowwise().minCoeff();
    const Eigen::Vector3f high = mesh_.positions().rowwise().maxCoeff();
    attributes["POSITION"] = add_array("VEC3", kFloat, count, 12);
    json& positions = root_["accessors"].back();
    positions["min"] = json::array({low.x(), low.z(), -high.y()});
    positions["max"] = json::array({high.x(), high.z(), -low.y()});
    if (has(column::kNormals)) attributes["NORMAL"] = add_array("VEC3", kFloat, count, 12);
    if (has(column::kColour)) {
      attributes["COLOR_0"] = add_array("VEC4", kU16, count, 8);
      root_["accessors"].back()["normalized"] = true;
    }
    if (!mesh_.empty()) primitive["indices"] = add_array("SCALAR", kU32, 3 * mesh_.size(), 4);
    root_["nodes"][0]["mesh"] = 0;
    // Sheets are seen from both sides; the standard's own material is a dark metal.
    json& material = root_["materials"][0];
    material["doubleSided"] = true;
    material["pbrMetallicRoughness"] =
        json::object({{"metallicFactor", 0}, {"roughnessFactor", 1}});
    root_["buffers"][0]["byteLength"] = size_;
  }

  /// Room for an array behind those before; its number.
  std::size_t add_array(const char* type, int component, Index count, std::size_t element) {
    constexpr int kVertices = 34962;
    constexpr int kIndices = 34963;
    const std::size_t bytes = static_cast<std::size_t>(count) * element;
    const std::size_t number = root_["accessors"].size();
    root_["bufferViews"].push_back(
        json::object({{"buffer", 0},
                      {"byteOffset", size_},
                      {"byteLength", bytes},
                      {"target", component == kU32 ? kIndices : kVertices}}));
    root_["accessors"].push_back(json::object(
        {{"bufferView", number}, {"componentType", component}, {"count", count}, {"type", type}}));
    size_ += bytes;  // all elements are whole words of four bytes
    return number;
  }

  void write_header() {
    std::string text = root_.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::size_t total = 20 + text.size() + (size_ > 0 ? 8 + size_ : 0);
    if (total > std::numeric_limits<std::uint32_t>::max())
      throw Error(Fault::output, fmt::format("{} bytes; a GLB file may have 4294967295", total))
          .hint("write it as .ply");
    const auto word = [](std::size_t value) { return raw(static_cast<std::uint32_t>(value)); };
    file_.write("glTF" + raw(2) + word(total) + word(text.size()) + "JSON" + text);
    if (size_ > 0) file_.write(word(size_) + std::string("BIN\0", 4));
  }

  void write_binary(Index count) {
    const Cloud& vertices = mesh_.vertices();
    const auto write = [&](Index elements, const auto& make) {
      write_pieces(file_, elements, kGrain, context_, make);
    };
    write(count,
          [&](Index begin, Index end) { return vectors_of(vertices.positions(), begin, end); });
    if (has(column::kNormals))
      write(count,
            [&](Index begin, Index end) { return vectors_of(vertices.normals(), begin, end); });
    if (has(column::kColour))
      write(count, [&](Index begin, Index end) {
        return colours_of(vertices.column(column::kColour), begin, end);
      });
    const ConstTriangles triangles = mesh_.triangles();
    write(mesh_.size(), [&](Index begin, Index end) {
      const auto* from = reinterpret_cast<const char*>(triangles.data() + 3 * begin);  // NOLINT
      return std::string(from, static_cast<std::size_t>(end - begin) * 12);
    });
  }

  AtomicFile& file_;
  const Mesh& mesh_;
  Context& context_;
  json root_;
  std::size_t size_ = 0;
};

}  // namespace

void write_glb(AtomicFile& file, const Mesh& mesh, Context& context) {
  GlbWriter(file, mesh, context).write();
}

}  // namespace velum::formats
