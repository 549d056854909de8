// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <map>

#include "formats/glb.hpp"
#include "formats/glb_colour.hpp"
#include "formats/glb_scene.hpp"
#include "formats/polygons.hpp"
#include "formats/positions.hpp"

namespace velum::formats {
namespace {

using json = nlohmann::json;

constexpr Index kBetweenChecks = Index{1} << 18U;
/// Vertices, or corners, that nodes which share meshes may make of a file. More than a file's own
/// number is possible; this keeps a small file from filling the memory.
constexpr Index kMostRepeated = Index{1} << 27U;

/// The arrays of a primitive, of the kinds that they must have.
struct Primitive {
  GlbArray positions;
  std::optional<GlbArray> normals;
  std::optional<GlbArray> colours;
  std::optional<GlbArray> indices;
  /// Primitives with the same ones have the same vertices.
  std::array<std::size_t, 3> key{};

  [[nodiscard]] Index corners() const { return indices ? indices->count : positions.count; }
};

class PrimitiveReader {
 public:
  explicit PrimitiveReader(const GlbDocument& document) : document_(document) {}

  [[nodiscard]] std::vector<Primitive> mesh(std::size_t index) const {
    const json& mesh = document_.entry("meshes", index);
    const std::string place = place_of("meshes", index);
    const auto list = mesh.find("primitives");
    if (list == mesh.end() || !list->is_array())
      throw document_.bad(place, "there is no list 'primitives'");
    std::vector<Primitive> result;
    for (std::size_t i = 0; i < list->size(); ++i)
      result.push_back(primitive((*list)[i], fmt::format("{}.primitives[{}]", place, i)));
    return result;
  }

 private:
  [[nodiscard]] Primitive primitive(const json& node, const std::string& place) const {
    constexpr std::string_view kModes[] = {"points",       "lines",     "line loops",
                                           "line strips",  "triangles", "triangle strips",
                                           "triangle fans"};
    constexpr std::size_t kTriangles = 4;
    if (!node.is_object()) throw document_.bad(place, "found no object");
    const std::size_t mode = document_.whole(node, "mode", place).value_or(kTriangles);
    if (mode != kTriangles)
      throw document_.bad(place, fmt::format("found {} (mode {}), expected triangles (mode 4)",
                                             mode < std::size(kModes) ? kModes[mode]
                                                                      : "an unknown "
                                                                        "kind",
                                             mode));
    if (node.contains("targets"))
      throw document_.bad(place, "a mesh that changes its shape ('targets'), expected a rigid one");
    const auto attributes = node.find("attributes");
    if (attributes == node.end() || !attributes->is_object())
      throw document_.bad(place, "there are no 'attributes'");
    Primitive result;
    result.positions = vectors(document_.required(*attributes, "POSITION", place));
    const auto normals = document_.whole(*attributes, "NORMAL", place);
    if (normals) result.normals = vectors(*normals);
    const auto colours = document_.whole(*attributes, "COLOR_0", place);
    if (colours) result.colours = colour(*colours);
    if (const auto indices = document_.whole(node, "indices", place))
      result.indices = index_array(*indices);
    constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
    result.key = {*document_.whole(*attributes, "POSITION", place), normals.value_or(kNone),
                  colours.value_or(kNone)};
    for (const auto& other : {result.normals, result.colours})
      if (other && other->count != result.positions.count)
        throw document_.bad(place, fmt::format("{} positions, but {} normals or colours",
                                               result.positions.count, other->count));
    if (result.corners() % 3 != 0)
      throw document_.bad(
          place, fmt::format("{} corners, expected three for each triangle", result.corners()));
    return result;
  }

  [[nodiscard]] GlbArray vectors(std::size_t index) const {
    const GlbArray array = document_.accessor(index);
    if (array.type != FieldType::f32 || array.width != 3)
      throw wrong(index, array, "three f32 an element");
    return array;
  }

  [[nodiscard]] GlbArray colour(std::size_t index) const {
    const GlbArray array = document_.accessor(index);
    const bool share =
        (array.type == FieldType::u8 || array.type == FieldType::u16) && array.normalised;
    if ((array.type != FieldType::f32 && !share) || array.width < 3)
      throw wrong(index, array, "three or four f32, or normalized u8 or u16");
    return array;
  }

  [[nodiscard]] GlbArray index_array(std::size_t index) const {
    const GlbArray array = document_.accessor(index);
    const bool known =
        array.type == FieldType::u8 || array.type == FieldType::u16 || array.type == FieldType::u32;
    if (!known || array.width != 1) throw wrong(index, array, "one u8, u16 or u32 an element");
    return array;
  }

  [[nodiscard]] Error wrong(std::size_t index, const GlbArray& found, const char* expected) const {
    return document_.bad(
        place_of("accessors", index),
        fmt::format("found {} {}{} an element, expected {}", found.width,
                    found.normalised ? "normalized " : "", name_of(found.type), expected));
  }

  const GlbDocument& document_;
};

/// Vertices and triangles of all instances in one frame, in Velum's axes.
class GlbMesh {
 public:
  GlbMesh(const Source& source, const GlbDocument& document, Context& context)
      : source_(source), document_(document), context_(context) {}

  void gather(const std::vector<GlbInstance>& instances) {
    const PrimitiveReader reader(document_);
    std::map<std::size_t, std::vector<Primitive>> meshes;
    for (const GlbInstance& instance : instances)
      if (!meshes.contains(instance.mesh)) meshes[instance.mesh] = reader.mesh(instance.mesh);
    require_reasonable(instances, meshes);
    take_shift(instances);
    for (const GlbInstance& instance : instances) add(instance, meshes.at(instance.mesh));
  }

  Mesh finish(const ReadOptions& options) const {
    Records records;
    records.count = vertices();
    const auto add = [&](const auto& values, FieldType type,
                         std::initializer_list<const char*> names) {
      const auto* data = reinterpret_cast<const std::byte*>(values.data());  // NOLINT
      for (const char* name : names) {
        records.fields.push_back({name, type, 1, data, 3 * size_of(type)});
        data += size_of(type);
      }
    };
    add(places_, FieldType::f64, {"x", "y", "z"});
    if (with_normals_) add(normals_, FieldType::f32, {"nx", "ny", "nz"});
    if (with_colours_) add(colours_, FieldType::u8, {"red", "green", "blue"});
    ReadOptions metres = options;
    metres.unit = 1.0;
    const Cloud cloud = assemble(source_, records, metres, NotFinite::refuse, context_);
    Cloud placed(cloud.position_column(), cloud.origin() + shift_);
    for (const auto& [name, column] : cloud.columns()) placed = placed.with(name, column);
    return make_mesh(source_, std::move(placed), polygons_, metres, context_);
  }

 private:
  [[nodiscard]] Index vertices() const { return static_cast<Index>(places_.size() / 3); }

  static Eigen::Vector3d z_up(const Eigen::Vector3d& p) { return {p.x(), -p.z(), p.y()}; }

  void require_reasonable(const std::vector<GlbInstance>& instances,
                          const std::map<std::size_t, std::vector<Primitive>>& meshes) {
    const Index most = std::max(kMostRepeated, static_cast<Index>(source_.size()));
    Index vertices = 0;
    Index corners = 0;
    for (const GlbInstance& instance : instances) {
      for (const Primitive& primitive : meshes.at(instance.mesh)) {
        vertices += primitive.positions.count;
        corners += primitive.corners();
        with_normals_ = with_normals_ && primitive.normals.has_value();
        with_colours_ = with_colours_ && primitive.colours.has_value();
      }
      if (vertices > most || corners > most)
        throw document_.bad("nodes", fmt::format("they repeat meshes to more than {} vertices or "
                                                 "corners",
                                                 most));
    }
  }

  /// Where all nodes do no more than the same translation, it becomes the origin: nothing is
  /// rounded.
  void take_shift(const std::vector<GlbInstance>& instances) {
    for (const GlbInstance& instance : instances)
      if (instance.pose.linear() != Eigen::Matrix3d::Identity() ||
          instance.pose.translation() != instances.front().pose.translation())
        return;
    const Eigen::Vector3d shift =
        instances.empty() ? Eigen::Vector3d::Zero() : z_up(instances.front().pose.translation());
    if (shift.cwiseAbs().maxCoeff() > kLargestCoordinate)
      throw document_.bad("nodes", "a translation beyond 1e15 m");
    shift_ = shift;
    shifted_ = true;
  }

  void add(const GlbInstance& instance, const std::vector<Primitive>& primitives) {
    const bool mirrored = instance.pose.linear().determinant() < 0.0;
    std::map<std::array<std::size_t, 3>, Index> known;
    for (const Primitive& primitive : primitives) {
      const auto [found, added] = known.emplace(primitive.key, vertices());
      if (added) add_vertices(primitive, instance.pose);
      add_triangles(primitive, found->second, mirrored);
    }
  }

  void add_vertices(const Primitive& primitive, const Eigen::Affine3d& pose) {
    const Eigen::Matrix3d turn = pose.linear().inverse().transpose();
    for (Index i = 0; i < primitive.positions.count; ++i) {
      if (i % kBetweenChecks == 0) context_.check();
      const Eigen::Vector3d local = vector_at(primitive.positions, i);
      push(places_, z_up(shifted_ ? local : pose * local));
      if (with_normals_) {
        const Eigen::Vector3d normal = vector_at(*primitive.normals, i);
        push(normals_, z_up(shifted_ ? normal : (turn * normal).normalized()));
      }
      if (with_colours_) add_colour(*primitive.colours, i);
    }
  }

  template <class T>
  static void push(std::vector<T>& values, const Eigen::Vector3d& vector) {
    for (Index a = 0; a < 3; ++a) values.push_back(static_cast<T>(vector[a]));
  }

  static Eigen::Vector3d vector_at(const GlbArray& array, Index element) {
    const std::byte* from = array.at(element);
    return Eigen::Vector3f(load<float>(from, false), load<float>(from + 4, false),
                           load<float>(from + 8, false))
        .cast<double>();
  }

  void add_colour(const GlbArray& array, Index element) {
    const double full = array.type == FieldType::u8 ? 255.0 : 65535.0;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::byte* from = array.at(element) + c * size_of(array.type);
      const double value = with_type(array.type, [&](auto type) {
        return static_cast<double>(load<decltype(type)>(from, false));
      });
      colours_.push_back(level_of(array.type == FieldType::f32 ? value : value / full));
    }
  }

  void add_triangles(const Primitive& primitive, Index first, bool mirrored) {
    const Index count = primitive.corners();
    for (Index i = 0; i < count; ++i) {
      if (i % kBetweenChecks == 0) context_.check();
      // A mirrored surface would show its back.
      const Index corner = mirrored && i % 3 != 0 ? (i % 3 == 1 ? i + 1 : i - 1) : i;
      polygons_.corners.push_back(static_cast<std::int32_t>(first + vertex_at(primitive, corner)));
    }
  }

  [[nodiscard]] Index vertex_at(const Primitive& primitive, Index corner) const {
    if (!primitive.indices) return corner;
    const std::byte* from = primitive.indices->at(corner);
    const auto vertex = with_type(primitive.indices->type, [&](auto type) {
      return static_cast<Index>(load<decltype(type)>(from, false));
    });
    if (vertex >= primitive.positions.count)
      throw source_.bad_byte(static_cast<std::size_t>(from - source_.bytes().data()),
                             fmt::format("a triangle refers to vertex {}, expected 0 to {}", vertex,
                                         primitive.positions.count - 1));
    return vertex;
  }

  const Source& source_;
  const GlbDocument& document_;
  Context& context_;
  Eigen::Vector3d shift_ = Eigen::Vector3d::Zero();
  bool shifted_ = false;
  bool with_normals_ = true;  ///< all primitives have them
  bool with_colours_ = true;
  std::vector<double> places_;
  std::vector<float> normals_;
  std::vector<std::uint8_t> colours_;
  Polygons polygons_;
};

}  // namespace

Mesh read_glb(const Source& source, const ReadOptions& options, Context& context) {
  if (options.left_handed)
    throw Error(Fault::graph,
                "'handedness' is left, but a GLB file is right-handed by its standard")
        .at(source.name());
  const GlbDocument document(source);
  const std::vector<GlbInstance> instances = instances_of(document);
  if (instances.empty())
    throw document.bad("scene", "no node of the scene has a mesh, expected triangles");
  GlbMesh mesh(source, document, context);
  mesh.gather(instances);
  return mesh.finish(options);
}

}  // namespace velum::formats
