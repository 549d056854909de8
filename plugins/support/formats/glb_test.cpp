// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/glb.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "formats/glb_colour.hpp"
#include "formats/test_tools.hpp"
#include "velum/files.hpp"

using namespace velum;
using namespace velum::formats;
using Catch::Matchers::Contains;
using nlohmann::json;
using test::bytes_of;
using test::mesh_error_of;
using test::read_mesh_text;

namespace {

std::string written(const Mesh& mesh, double unit = 1.0) {
  const test::Folder folder;
  run::LocalContext context(2, 1);
  write_mesh(folder / "m.glb", mesh, MeshFormat::automatic, unit, context);
  return std::string(FileContent(folder / "m.glb").text());
}

std::string word(std::size_t value) {
  return bytes_of<std::uint32_t>({static_cast<std::uint32_t>(value)});
}

std::string glb_of(std::string text, const std::string& binary) {
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::string chunks =
      word(text.size()) + "JSON" + text + word(binary.size()) + std::string("BIN\0", 4) + binary;
  return "glTF" + word(2) + word(12 + chunks.size()) + chunks;
}
std::string glb_of(const json& root, const std::string& binary) {
  return glb_of(root.dump(), binary);
}

json json_of(const std::string& file) {
  const auto length =
      load<std::uint32_t>(reinterpret_cast<const std::byte*>(file.data() + 12), false);
  return json::parse(file.substr(20, length));
}

/// Three corners (0 0 0), (1 0 0), (0 2 0) and their numbers as u8, u16 and u32: bytes 0, 36,
/// 40, 48.
const std::string kBinary =
    bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 2, 0}) + bytes_of<std::uint8_t>({0, 1, 2, 0}) +
    bytes_of<std::uint16_t>({0, 1, 2, 0}) + bytes_of<std::uint32_t>({0, 1, 2});

json triangle() {
  return json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
      {"bufferView": 1, "componentType": 5121, "count": 3, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36},
                    {"buffer": 0, "byteOffset": 36, "byteLength": 24}],
    "buffers": [{"byteLength": 60}]})");
}

/// The triangle with one value of its JSON changed, "" when it is read.
std::string error_with(const std::string& pointer, const json& value) {
  json root = triangle();
  root[json::json_pointer(pointer)] = value;
  return mesh_error_of(glb_of(root, kBinary), "m.glb");
}

Eigen::Vector3f corner(const Mesh& mesh, Index i) {
  return mesh.positions().col(mesh.triangles()(i, 0));
}

}  // namespace

TEST_CASE("a mesh comes back from GLB bit by bit: positions, origin, normals, colours") {
  const Mesh mesh = test::full_mesh(3000, Eigen::Vector3d(512345.5, 5413211.0, -7.25));
  const Mesh back = read_mesh_text(written(mesh), "m.glb");
  CHECK(back.positions() == mesh.positions());
  CHECK(back.origin() == mesh.origin());
  CHECK(back.triangles() == mesh.triangles());
  CHECK(back.vertices().normals() == mesh.vertices().normals());
  CHECK(back.vertices().column(column::kColour).as<std::uint8_t>() ==
        mesh.vertices().column(column::kColour).as<std::uint8_t>());
  CHECK(written(back) == written(mesh));
}

TEST_CASE("all levels of a colour survive sixteen linear bits") {
  for (int level = 0; level < 256; ++level)
    CHECK(level_of(linear_of(static_cast<std::uint8_t>(level)) / 65535.0) == level);
  CHECK(level_of(-1.0) == 0);
  CHECK(level_of(std::nan("")) == 0);
  CHECK(level_of(7.0) == 255);
}

TEST_CASE("the bytes of a GLB file are those of the standard") {
  Points points(3, 3);
  points.col(0) << 1, 2, 3;
  points.col(1) << 4, 5, 6;
  points.col(2) << -1, 0, 2;
  Triangles triangles(3, 1);
  triangles.col(0) << 0, 1, 2;
  const std::string file = written(Mesh(Cloud(points, {10, 20, 30}), triangles), 0.001);
  CHECK(file.substr(0, 12) == "glTF" + word(2) + word(file.size()));
  CHECK(file.substr(16, 4) == "JSON");
  const json root = json_of(file);
  CHECK(root["asset"]["version"] == "2.0");
  CHECK(root["nodes"][0]["translation"] == json({10.0, 30.0, -20.0}));
  const json& positions = root["accessors"][0];
  CHECK(positions["min"] == json({-1.0, 2.0, -5.0}));
  CHECK(positions["max"] == json({4.0, 6.0, 0.0}));
  CHECK(positions["componentType"] == 5126);
  CHECK(root["accessors"][1]["componentType"] == 5125);
  // y up and in metres, whatever the unit; then the indices.
  const std::string binary =
      bytes_of<float>({1, 3, -2, 4, 6, -5, -1, 2, -0.0F}) + bytes_of<std::uint32_t>({0, 1, 2});
  CHECK(file.substr(file.size() - 56) == word(48) + std::string("BIN\0", 4) + binary);
}

TEST_CASE("indices of every size, and none, make the triangle; y becomes z") {
  const struct {
    int type;
    std::size_t offset;
  } kinds[] = {{5121, 36}, {5123, 40}, {5125, 48}};
  for (const auto& kind : kinds) {
    json root = triangle();
    root["accessors"][1]["componentType"] = kind.type;
    root["bufferViews"][1] = {{"buffer", 0}, {"byteOffset", kind.offset}, {"byteLength", 12}};
    if (kind.type != 5125) root["bufferViews"][1]["byteLength"] = 6;
    const Mesh mesh = read_mesh_text(glb_of(root, kBinary), "m.glb");
    REQUIRE(mesh.size() == 1);
    CHECK(corner(mesh, 1) == Eigen::Vector3f(1, 0, 0));
    CHECK(corner(mesh, 2) == Eigen::Vector3f(0, 0, 2));
  }
  json bare = triangle();
  bare["meshes"][0]["primitives"][0].erase("indices");
  CHECK(corner(read_mesh_text(glb_of(bare, kBinary), "m.glb"), 2) == Eigen::Vector3f(0, 0, 2));
}

TEST_CASE("nodes place their meshes: turned, scaled, mirrored, by matrix, one in another") {
  json root = triangle();
  root["nodes"] = json::parse(R"([
    {"children": [1, 2], "translation": [10, 0, 0]},
    {"mesh": 0, "rotation": [0, 0, 0.7071067811865476, 0.7071067811865476], "scale": [2, 1, 1]},
    {"mesh": 0, "matrix": [-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,5,0,1]}])");
  const Mesh mesh = read_mesh_text(glb_of(root, kBinary), "m.glb");
  REQUIRE(mesh.size() == 2);
  const auto at = [&](Index triangle, Index c) {
    return Eigen::Vector3f(mesh.positions().col(mesh.triangles()(c, triangle)));
  };
  // x of the file, twice as long, is turned to its y, which is z here.
  CHECK(at(0, 1).isApprox(Eigen::Vector3f(10, 0, 2)));
  CHECK(at(0, 2).isApprox(Eigen::Vector3f(8, 0, 0)));
  // Mirrored: its last two corners are exchanged, so that its front stays in front.
  CHECK(at(1, 2).isApprox(Eigen::Vector3f(9, 0, 5)));
  const auto facing = [&](Index i) { return (at(i, 1) - at(i, 0)).cross(at(i, 2) - at(i, 0)).y(); };
  CHECK(facing(0) < 0.0F);
  CHECK(facing(1) < 0.0F);
}

TEST_CASE("primitives that share their vertices do so in the mesh") {
  json root = triangle();
  auto& primitives = root["meshes"][0]["primitives"];
  primitives.push_back(primitives[0]);
  const Mesh mesh = read_mesh_text(glb_of(root, kBinary), "m.glb");
  CHECK(mesh.size() == 2);
  CHECK(mesh.vertices().size() == 3);
}

TEST_CASE("what GLB files may hold and is not read is named") {
  const std::string primitive = "/meshes/0/primitives/0";
  CHECK_THAT(error_with(primitive + "/mode", 1),
             Contains("m.glb: meshes[0].primitives[0]: found lines (mode 1), expected triangles"));
  CHECK_THAT(error_with(primitive + "/mode", 99), Contains("an unknown kind (mode 99)"));
  CHECK_THAT(error_with(primitive + "/targets", json::array()), Contains("changes its shape"));
  CHECK_THAT(error_with("/nodes/0/skin", 0), Contains("skeleton"));
  CHECK_THAT(error_with("/accessors/0/sparse", json::object()), Contains("sparse"));
  CHECK_THAT(error_with("/extensionsRequired", {"KHR_draco_mesh_compression"}),
             Contains("'KHR_draco_mesh_compression'"));
  CHECK(error_with("/extensionsRequired", {"KHR_materials_unlit"}).empty());
  CHECK_THAT(error_with("/buffers/0/uri", "far.bin"), Contains("not within the file"));
  CHECK_THAT(error_with("/nodes/0", json::object()), Contains("no node of the scene has a mesh"));
}

TEST_CASE("offsets, lengths, counts and types that lie are refused with their place") {
  constexpr auto kHuge = std::numeric_limits<std::uint64_t>::max();
  for (const json& value :
       {json(4), json(1000), json(kHuge), json(-1), json(0), json("3"), json(1.5), json(nullptr)})
    CHECK_THAT(error_with("/accessors/0/count", value), Contains("m.glb: "));
  for (const json& value : {json(1), json(36), json(kHuge), json(-1)})
    CHECK_THAT(error_with("/accessors/0/byteOffset", value), Contains("m.glb: accessors[0]"));
  for (const json& value : {json(61), json(kHuge), json("x")}) {
    CHECK_THAT(error_with("/bufferViews/0/byteLength", value), Contains("bufferViews[0]"));
    CHECK_THAT(error_with("/bufferViews/1/byteOffset", value), Contains("bufferViews[1]"));
    CHECK_THAT(error_with("/buffers/0/byteLength", value), Contains("buffers[0]"));
  }
  CHECK_THAT(error_with("/bufferViews/0/byteStride", 11), Contains("a step of 11 bytes"));
  CHECK_THAT(error_with("/bufferViews/0/byteStride", kHuge), Contains("a step of"));
  CHECK_THAT(error_with("/accessors/0/componentType", 5124), Contains("component type 5124"));
  CHECK_THAT(error_with("/accessors/0/componentType", 5123), Contains("expected three f32"));
  CHECK_THAT(error_with("/accessors/0/type", "MAT4"), Contains("type 'MAT4'"));
  CHECK_THAT(error_with("/accessors/1/componentType", 5126), Contains("expected one u8"));
  CHECK_THAT(error_with("/accessors/1/count", 2), Contains("2 corners"));
  CHECK_THAT(error_with("/accessors/1/bufferView", 2), Contains("bufferViews[2]: there is none"));
  CHECK(error_with("/accessors/1/byteOffset", 1).find("accessors[1]") == std::string::npos);
}

TEST_CASE("scenes and nodes that are no tree are refused") {
  CHECK_THAT(error_with("/scene", 1), Contains("scenes[1]: there is none"));
  CHECK_THAT(error_with("/scenes/0/nodes", {0, 0}), Contains("reached twice"));
  CHECK_THAT(error_with("/nodes/0/children", {0}), Contains("nodes[0]: the node is reached twice"));
  CHECK_THAT(error_with("/nodes/0/children", {5}), Contains("nodes[5]: there is none"));
  CHECK_THAT(error_with("/nodes/0/children", "x"), Contains("no list"));
  CHECK_THAT(error_with("/nodes/0/mesh", 7), Contains("meshes[7]"));
  CHECK_THAT(error_with("/nodes/0/matrix", {1, 2}), Contains("no list of 16 numbers"));
  CHECK_THAT(error_with("/nodes/0/rotation", {0, 0, 0, 0}), Contains("unit quaternion"));
  CHECK_THAT(error_with("/nodes/0/translation", {1e300, 0, 0}), Contains("translation"));
  CHECK_THAT(error_with("/nodes/0/scale", {1e300, 1e300, 1e300}), Contains("finite"));
}

TEST_CASE("headers and chunks that lie are refused with their byte") {
  const std::string good = glb_of(triangle(), kBinary);
  const auto with = [&](std::size_t at, const std::string& bytes) {
    std::string file = good;
    file.replace(at, bytes.size(), bytes);
    return mesh_error_of(file, "m.glb");
  };
  CHECK_THAT(with(4, word(1)), Contains("m.glb: byte 4: glTF version 1, expected 2"));
  CHECK_THAT(with(8, word(good.size() + 4)), Contains("byte 8: the header says"));
  CHECK_THAT(with(8, word(good.size() - 4)), Contains("bytes follow"));
  CHECK_THAT(with(12, word(0xFFFFFFFF)), Contains("byte 12: a chunk of 4294967295 bytes"));
  CHECK_THAT(with(16, "BIN "), Contains("the first chunk is not the JSON one"));
  CHECK_THAT(with(20, "["), Contains("cannot be read"));
  CHECK_THAT(mesh_error_of(glb_of(std::string("[]"), ""), "m.glb"), Contains("no object"));
  CHECK_THAT(mesh_error_of("glTF", "m.glb"), Contains("ends within its header"));
  for (std::size_t size = 4; size < good.size(); size += 7)
    CHECK_THAT(mesh_error_of(good.substr(0, size), "m.glb"), Contains("m.glb"));
}

TEST_CASE("few bytes cannot ask for much memory") {
  json root = triangle();
  root["nodes"] = json::array();
  root["scenes"][0]["nodes"] = json::array();
  // 2,000 nodes of one mesh with 100 primitives of 1,365 triangles over the same bytes.
  std::string binary(12 * 4096, '\0');
  for (int i = 0; i < 2000; ++i) {
    root["nodes"].push_back({{"mesh", 0}});
    root["scenes"][0]["nodes"].push_back(i);
  }
  root["accessors"][0]["count"] = 4095;
  root["bufferViews"][0]["byteLength"] = binary.size();
  root["buffers"][0]["byteLength"] = binary.size();
  auto& primitives = root["meshes"][0]["primitives"];
  primitives[0].erase("indices");
  for (int i = 0; i < 100; ++i) primitives.push_back(primitives[0]);
  CHECK_THAT(mesh_error_of(glb_of(root, binary), "m.glb"), Contains("they repeat meshes"));
}

TEST_CASE("every byte of a GLB file may be wrong: it is read or refused") {
  const std::string good = written(test::full_mesh(6, {1e6, 0, 0}));
  for (std::size_t at = 4; at < good.size(); ++at) {
    for (const int flip : {0x01, 0x10, 0x80, 0xFF}) {
      std::string bad = good;
      bad[at] = static_cast<char>(bad[at] ^ flip);
      const std::string error = mesh_error_of(bad, "m.glb");
      INFO(at << ' ' << flip << ": " << error);
      CHECK((error.empty() || error.starts_with("m.glb")));
    }
  }
}

TEST_CASE("a mesh without triangles or vertices is written, and refused as a mesh") {
  CHECK_THAT(mesh_error_of(written(Mesh(test::plain_cloud(3), Triangles(3, 0))), "m.glb"),
             Contains("found points (mode 0)"));
  CHECK_THAT(mesh_error_of(written(Mesh()), "m.glb"), Contains("no node of the scene has a mesh"));
}
