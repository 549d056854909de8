// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/out_fields.hpp"
#include "formats/stl.hpp"

namespace velum::formats {
namespace {

constexpr Index kGrain = 16384;

struct Facet {
  Eigen::Vector3f normal;
  Eigen::Matrix3f corners;
};

Facet facet_of(const Mesh& mesh, Index triangle, double unit) {
  const ConstPoints positions = mesh.positions();
  Eigen::Matrix3d corners;
  for (Index c = 0; c < 3; ++c)
    corners.col(c) = positions.col(mesh.triangles()(c, triangle)).cast<double>();
  const Eigen::Vector3d normal =
      (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)).normalized();
  corners.colwise() += mesh.origin();
  return {normal.cast<float>(), (corners / unit).cast<float>()};
}

std::string binary_facets(const Mesh& mesh, double unit, Index begin, Index end) {
  std::string bytes;
  for (Index i = begin; i < end; ++i) {
    const Facet facet = facet_of(mesh, i, unit);
    char raw[50] = {};
    std::memcpy(raw, facet.normal.data(), 12);
    std::memcpy(raw + 12, facet.corners.data(), 36);
    bytes.append(raw, sizeof(raw));
  }
  return bytes;
}

void append_place(std::string& text, const char* word, const Eigen::Vector3f& place) {
  text += word;
  for (Index a = 0; a < 3; ++a) {
    text += ' ';
    append_number(text, place[a]);
  }
  text += '\n';
}

std::string text_facets(const Mesh& mesh, double unit, Index begin, Index end) {
  std::string text;
  for (Index i = begin; i < end; ++i) {
    const Facet facet = facet_of(mesh, i, unit);
    append_place(text, "  facet normal", facet.normal);
    text += "    outer loop\n";
    for (Index c = 0; c < 3; ++c) append_place(text, "      vertex", facet.corners.col(c));
    text += "    endloop\n  endfacet\n";
  }
  return text;
}

}  // namespace

void write_stl(AtomicFile& file, const Mesh& mesh, bool ascii, double unit, Context& context) {
  if (!mesh.origin().isZero(0.0))
    context.warn("STL keeps single precision only: the mesh's large coordinates lose digits");
  if (ascii) {
    file.write(std::string_view("solid velum\n"));
  } else {
    std::string header = "binary STL written by Velum";
    header.resize(80, ' ');
    const auto count = static_cast<std::uint32_t>(mesh.size());
    char raw[4];
    std::memcpy(raw, &count, 4);
    file.write(header.append(raw, 4));
  }
  write_pieces(file, mesh.size(), kGrain, context, [&](Index begin, Index end) {
    return ascii ? text_facets(mesh, unit, begin, end) : binary_facets(mesh, unit, begin, end);
  });
  if (ascii) file.write(std::string_view("endsolid velum\n"));
}

}  // namespace velum::formats
