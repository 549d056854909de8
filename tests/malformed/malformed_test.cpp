// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <set>

#include "formats/test_tools.hpp"
#include "formats/transform_io.hpp"

// Small files that are wrong, each in one way. All must be refused as bad input, with the place,
// and with a message that says what was found; none may crash, hang or allocate what its header
// claims.

using namespace velum;
using namespace velum::formats;
using std::string;
using test::bytes_of;

namespace {

enum class As { cloud, mesh, transform };

struct Malformed {
  string name;  ///< of the file
  string content;
  string message;  ///< part of what must be said
  As as = As::cloud;
};

string pcd(const string& changed_key, const string& value,
           const string& data = "DATA ascii\n1 2 3\n") {
  string header = "# .PCD v0.7\n";
  const std::pair<string, string> lines[] = {
      {"VERSION", "0.7"}, {"FIELDS", "x y z"}, {"SIZE", "4 4 4"}, {"TYPE", "F F F"},
      {"COUNT", "1 1 1"}, {"WIDTH", "1"},      {"HEIGHT", "1"},   {"POINTS", "1"}};
  for (const auto& [key, usual] : lines) {
    if (key == changed_key && value.empty()) continue;
    header += key + " " + (key == changed_key ? value : usual) + "\n";
  }
  return header + data;
}

string ply(const string& format, const string& count, const string& body) {
  return "ply\nformat " + format + " 1.0\nelement vertex " + count +
         "\nproperty float x\nproperty float y\nproperty float z\nend_header\n" + body;
}

string ply_mesh(const string& faces, const string& body, const string& format = "ascii") {
  return "ply\nformat " + format +
         " 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement "
         "face " +
         faces + "\nproperty list uchar int vertex_indices\nend_header\n" + body;
}

const string kThree = "0 0 0\n1 0 0\n0 1 0\n";

string garbage(std::size_t size) {
  string bytes;
  std::uint32_t state = 12345;
  for (std::size_t i = 0; i < size; ++i) {
    state = state * 1664525U + 1013904223U;
    bytes += static_cast<char>(state >> 24U);
  }
  return bytes;
}

string las(std::size_t at, const string& bytes, std::size_t points = 1) {
  string content(227 + 20 * points, '\0');
  const auto put = [&](std::size_t place, const string& what) {
    content.replace(place, what.size(), what);
  };
  put(0, "LASF");
  put(24, string("\1\2"));
  put(94, bytes_of<std::uint16_t>({227}));
  put(96, bytes_of<std::uint32_t>({227}));
  put(105, bytes_of<std::uint16_t>({20}));
  put(107, bytes_of<std::uint32_t>({1}));
  put(131, bytes_of<double>({0.01, 0.01, 0.01, 0.0, 0.0, 0.0}));
  put(at, bytes);
  return content;
}

string vtk(const string& rest, const string& kind = "ASCII") {
  return "# vtk DataFile Version 3.0\ntitle\n" + kind + "\nDATASET POLYDATA\n" + rest;
}

std::vector<Malformed> pcd_files() {
  const string three = bytes_of<float>({1, 2, 3});
  return {
      {"empty.pcd", "", "empty"},
      {"garbage.pcd", garbage(2000), "does not begin"},
      {"no_header.pcd", "1 2 3\n", "does not begin"},
      {"no_data.pcd", pcd("", "", ""), "no DATA"},
      {"no_fields.pcd", pcd("FIELDS", ""), "no FIELDS"},
      {"no_size.pcd", pcd("SIZE", ""), "no SIZE"},
      {"no_type.pcd", pcd("TYPE", ""), "no TYPE"},
      {"no_z.pcd", pcd("FIELDS", "x y w"), "no column 'z'"},
      {"second_x.pcd", pcd("FIELDS", "x y X"), "a second field"},
      {"two_sizes.pcd", pcd("SIZE", "4 4"), "2 entries for 3 fields"},
      {"bad_size.pcd", pcd("SIZE", "4 4 3"), "type 'F' and size 3"},
      {"bad_type.pcd", pcd("TYPE", "F F Q"), "type 'Q'"},
      {"huge_size.pcd", pcd("SIZE", "4 4 4000000000"), "from 1 to 8"},
      {"huge_count.pcd", pcd("COUNT", "1 1 4000000000"), "from 0 to 100000"},
      {"negative_count.pcd", pcd("COUNT", "1 1 -1"), "from 0 to 100000"},
      {"wide_ascii.pcd", pcd("COUNT", "1 1 100000"), "do not fit"},
      {"negative_points.pcd", pcd("POINTS", "-1"), "'-1'"},
      {"huge_points.pcd", pcd("POINTS", "4294967295"), "'4294967295'"},
      {"unequal_points.pcd", pcd("POINTS", "2"), "WIDTH times HEIGHT"},
      {"bad_viewpoint.pcd", pcd("", "", "VIEWPOINT 0 0 0\nDATA ascii\n1 2 3\n"), "seven numbers"},
      {"zero_viewpoint.pcd", pcd("", "", "VIEWPOINT 0 0 0 0 0 0 0\nDATA ascii\n1 2 3\n"),
       "no pose"},
      {"unknown_entry.pcd", pcd("", "", "COLOUR 1\nDATA ascii\n1 2 3\n"), "'COLOUR'"},
      {"twice.pcd", pcd("", "", "WIDTH 1\nDATA ascii\n1 2 3\n"), "a second WIDTH"},
      {"bad_data.pcd", pcd("", "", "DATA zip\n"), "'zip'"},
      {"short.pcd", pcd("", "", "DATA ascii\n"), "found 0 lines"},
      {"long.pcd", pcd("", "", "DATA ascii\n1 2 3\n4 5 6\n"), "found 2 lines"},
      {"short_line.pcd", pcd("", "", "DATA ascii\n1 2\n"), "found 2 values"},
      {"long_line.pcd", pcd("", "", "DATA ascii\n1 2 3 4\n"), "after the 3 values"},
      {"word.pcd", pcd("", "", "DATA ascii\n1 2 x\n"), "value 3 is 'x'"},
      {"glued.pcd", pcd("", "", "DATA ascii\n1 2 3x\n"), "value 3"},
      {"byte_overflow.pcd",
       "FIELDS x y z q\nSIZE 4 4 4 1\nTYPE F F F U\nWIDTH 1\nDATA ascii\n1 2 3 256\n", "type u8"},
      {"truncated.pcd", pcd("", "", "DATA binary\n" + three.substr(1)), "11 of 12 bytes"},
      {"more.pcd", pcd("", "", "DATA binary\n" + three + three), "bytes follow"},
      {"no_lengths.pcd", pcd("", "", "DATA binary_compressed\nabc"), "before the lengths"},
      {"packed_short.pcd",
       pcd("", "", "DATA binary_compressed\n" + bytes_of<std::uint32_t>({100, 12}) + "abc"),
       "packed data"},
      {"packed_wrong.pcd",
       pcd("", "", "DATA binary_compressed\n" + bytes_of<std::uint32_t>({3, 12}) + "\xE0\1\1"),
       "damaged"},
      {"packed_lie.pcd",
       pcd("", "", "DATA binary_compressed\n" + bytes_of<std::uint32_t>({3, 4000000000U}) + "abc"),
       "said to hold"}};
}

std::vector<Malformed> ply_files() {
  const string little = "binary_little_endian";
  const string three = bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0});
  return {
      {"empty.ply", "", "empty"},
      {"garbage.ply", garbage(500), "does not begin"},
      {"only_mark.ply", "ply\n", "no end_header"},
      {"no_format.ply", "ply\nelement vertex 0\nend_header\n", "no format"},
      {"bad_format.ply", ply("utf8", "0", ""), "format"},
      {"no_vertex.ply", "ply\nformat ascii 1.0\nend_header\n", "no element 'vertex'"},
      {"no_y.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n",
       "no column 'y'"},
      {"negative.ply", ply("ascii", "-1", ""), "count"},
      {"huge.ply", ply(little, "4000000000", ""), "count"},
      {"huge_ascii.ply", ply("ascii", "2000000000", "1 2 3\n"), "found 1 lines"},
      {"huge_binary.ply", ply(little, "2000000000", three), "ends within"},
      {"fraction.ply", ply("ascii", "1.5", ""), "count"},
      {"real_list.ply",
       "ply\nformat ascii 1.0\nelement vertex 1\nproperty list float int a\nend_header\n1\n",
       "expected 'property"},
      {"second_vertex.ply",
       "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nelement vertex "
       "1\nend_header\n1\n",
       "a second element"},
      {"second_property.ply",
       "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty int x\nend_header\n1 "
       "1\n",
       "a second property"},
      {"short.ply", ply("ascii", "2", "1 2 3\n"), "found 1 lines"},
      {"short_line.ply", ply("ascii", "1", "1 2\n"), "found 2 values"},
      {"word.ply", ply("ascii", "1", "1 2 z\n"), "'z'"},
      {"truncated.ply", ply(little, "3", three.substr(0, 30)), "ends within"},
      {"more.ply", ply(little, "3", three + "x"), "follow"},
      {"index.ply", ply_mesh("1", kThree + "3 0 1 99\n"), "out of range", As::mesh},
      {"negative_index.ply", ply_mesh("1", kThree + "3 0 1 -2\n"), "out of range", As::mesh},
      {"long_list.ply", ply_mesh("1", kThree + "255 0 1 2\n"), "a list of 255", As::mesh},
      {"binary_index.ply", ply_mesh("1", three + "\3" + bytes_of<int>({0, 1, 3}), little),
       "out of range", As::mesh},
      {"binary_list.ply", ply_mesh("1", three + "\xFF" + bytes_of<int>({0, 1, 2}), little),
       "a list of 255", As::mesh},
      {"huge_faces.ply", ply_mesh("2000000000", three, little), "ends within", As::mesh},
      {"no_faces.ply", ply("ascii", "1", "1 2 3\n"), "no element 'face'", As::mesh},
      {"nan_vertex.ply", ply_mesh("1", "0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n"), "no finite", As::mesh}};
}

std::vector<Malformed> text_files() {
  return {{"empty.xyz", "", "empty"},
          {"blank.xyz", "\n \n\n", "no line of points"},
          {"comments.txt", "# only\n// comments\n", "no line of points"},
          {"garbage.txt", garbage(3000), "binary data"},
          {"two.xyz", "1 2\n", "found 2 values"},
          {"uneven.xyz", "1 2 3\n4 5\n", "expected 3"},
          {"uneven_more.csv", "1,2,3\n4,5,6,7\n", "after the 3 values"},
          {"word.csv", "x,y,z\n1,2,three\n", "'three'"},
          {"names.csv", "a,b,c\n1,2,3\n", "no x, y and z"},
          {"names_twice.csv", "x,y,z,y\n1,2,3,4\n", "two columns called 'y'"},
          {"names_more.csv", "x,y,z,w\n1,2,3\n", "4 names for 3 columns"},
          {"decimal_comma.csv", "1,5;2,5;3,5\n", "value 1"},
          {"overflow.xyz", "1 2 1e999999x\n", "value 3"},
          {"hexadecimal.xyz", "0x10 2 3\n", "value 1"},
          {"counted.pts", "5\n1 2 3\n", "expected 5"},
          {"sentence.txt", "To whom it may concern\n", "no x, y and z"},
          {"zeros.xyz", string("1 2 3\n\0\0\0\n", 10), "binary data"},
          {"geo.json", "{\"type\": \"FeatureCollection\"}", "a JSON file"},
          {"packed.gz", string("\x1f\x8b\x08\0\0\0", 6), "a gzip file"}};
}

std::vector<Malformed> las_files() {
  return {{"empty.las", "", "empty"},
          {"short.las", "LASF", "at least 227"},
          {"version.las", las(24, string("\2\1")), "version 2.1"},
          {"laz.laz", las(104, "\x81"), "LAZ"},
          {"format.las", las(104, "\x0B"), "point format 11"},
          {"stride.las", las(105, bytes_of<std::uint16_t>({19})), "at least 20"},
          {"huge.las", las(107, bytes_of<std::uint32_t>({4000000000U})), "4000000000"},
          {"truncated.las", las(107, bytes_of<std::uint32_t>({2})), "20 of 40 bytes"},
          {"scale.las", las(131, bytes_of<double>({std::nan("")})), "a scale"},
          {"offset.las", las(155, bytes_of<double>({1e300})), "an offset"},
          {"place.las", las(96, bytes_of<std::uint32_t>({4000000000U})), "points at byte"}};
}

std::vector<Malformed> vtk_files() {
  return {{"empty.vtk", "", "empty"},
          {"no_points.vtk", vtk(""), "no POINTS"},
          {"image.vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_POINTS\n",
           "not read"},
          {"neither.vtk", vtk("", "TEXT"), "expected ASCII"},
          {"negative.vtk", vtk("POINTS -1 float\n"), "'-1'"},
          {"huge.vtk", vtk("POINTS 2000000000 float\n1 2 3\n"), "do not fit"},
          {"huge_binary.vtk", vtk("POINTS 2000000000 double\n123\n", "BINARY"), "bytes follow"},
          {"type.vtk", vtk("POINTS 1 bit\n1 2 3\n"), "'bit'"},
          {"word.vtk", vtk("POINTS 1 float\n1 2 x\n"), "'x'"},
          {"data.vtk", vtk("POINTS 1 float\n1 2 3\nPOINT_DATA 2\n"), "for 2 points"},
          {"cell.vtk", vtk("POINTS 1 float\n1 2 3\nPOLYGONS 1 2\n5 0\n"), "lies outside", As::mesh},
          {"index.vtk", vtk("POINTS 1 float\n1 2 3\nPOLYGONS 1 4\n3 0 0 1\n"), "out of range",
           As::mesh}};
}

std::vector<Malformed> mesh_files() {
  const string box = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  return {
      {"empty.obj", "", "empty", As::mesh},
      {"zero.obj", box + "f 0 1 2\n", "'0'", As::mesh},
      {"range.obj", box + "f 1 2 4\n", "'4'", As::mesh},
      {"before.obj", box + "f -4 1 2\n", "'-4'", As::mesh},
      {"huge.obj", box + "f 1 2 99999999999999999999\n", "refers to", As::mesh},
      {"short.obj", "v 1 2\n", "2 numbers", As::mesh},
      {"word.obj", box + "v 1 2 x\n", "'x'", As::mesh},
      {"normal.obj", box + "f 1//1 2//1 3//1\n", "refers to", As::mesh},
      {"unknown.obj", box + "frob 1\n", "'frob'", As::mesh},
      {"no_faces.obj", box, "no faces", As::mesh},
      {"empty.off", "", "empty", As::mesh},
      {"counts.off", "OFF\n3 1\n", "three counts", As::mesh},
      {"negative.off", "OFF\n-3 1 0\n", "three counts", As::mesh},
      {"huge.off", "OFF\n2000000000 1 0\n0 0 0\n", "found 1 lines", As::mesh},
      {"range.off", "OFF\n3 1 0\n" + kThree + "3 0 1 3\n", "out of range", As::mesh},
      {"list.off", "OFF\n3 1 0\n" + kThree + "2000000000 0 1\n", "corners", As::mesh},
      {"binary.off", "OFF BINARY\n", "binary OFF", As::mesh},
      {"empty.stl", "", "empty", As::mesh},
      {"short.stl", string(100, 'x'), "does not begin", As::mesh},
      {"cut.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", "ends within",
       As::mesh},
      {"order.stl", "solid a\nvertex 0 0 0\nfacet\n", "vertex", As::mesh},
      {"word.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 x\n", "'vertex'", As::mesh},
      {"nan.stl",
       string(80, ' ') + bytes_of<std::uint32_t>({1}) +
           bytes_of<float>({0, 0, 1, 0, 0, std::nanf(""), 1, 0, 0, 0, 1, 0}) + string(2, '\0'),
       "no finite", As::mesh}};
}

std::vector<Malformed> transform_files() {
  return {{"empty.txt", "", "empty", As::transform},
          {"short.txt", "1 0 0 0\n", "found 4 numbers", As::transform},
          {"scaled.txt", "2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1", "no rigid motion", As::transform},
          {"mirror.txt", "1 0 0 0 0 1 0 0 0 0 -1 0 0 0 0 1", "no rigid motion", As::transform},
          {"word.txt", "1 0 0 zero\n", "'zero'", As::transform},
          {"cut.json", "{\"matrix\": [[1, 0,", "no JSON", As::transform},
          {"deep.json", string(100000, '['), "no JSON", As::transform},
          {"other.json", "{\"motion\": []}", "no entry 'matrix'", As::transform}};
}

std::vector<Malformed> all_files() {
  std::vector<Malformed> all;
  for (const auto& some : {pcd_files(), ply_files(), text_files(), las_files(), vtk_files(),
                           mesh_files(), transform_files()})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

void read_as(const Malformed& file) {
  run::LocalContext context(2, 1);
  Source source(file.name, std::string_view(file.content));
  if (file.as == As::cloud)
    (void)read_cloud(source, {}, context);
  else if (file.as == As::mesh)
    (void)read_mesh(source, {}, context);
  else
    (void)read_transform(source, {});
}

long peak_kilobytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

}  // namespace

TEST_CASE("every malformed file is refused with its place and what is wrong") {
  const std::vector<Malformed> files = all_files();
  CHECK(files.size() >= 60);
  std::set<string> names;
  for (const Malformed& file : files) {
    INFO(file.name);
    CHECK(names.insert(file.name).second);
    try {
      read_as(file);
      FAIL_CHECK("it was taken");
    } catch (const Error& error) {
      CHECK(error.fault() == Fault::input);
      CHECK_THAT(error.where(), Catch::StartsWith(file.name));
      CHECK_THAT(error.what(), Catch::Contains(file.message));
    }
  }
}

TEST_CASE("no malformed file makes its reader allocate what it claims") {
  const long before = peak_kilobytes();
  for (const Malformed& file : all_files()) {
    try {
      read_as(file);
    } catch (const Error&) {
      continue;
    }
  }
  CHECK(peak_kilobytes() - before < 64 * 1024);
}

TEST_CASE("a good file cut short anywhere is refused or smaller, never half-read") {
  const test::Folder folder;
  const Cloud cloud = test::full_cloud(20);
  constexpr std::pair<const char*, CloudFormat> kFormats[] = {
      {"a.pcd", CloudFormat::pcd},       {"b.pcd", CloudFormat::pcd_compressed},
      {"c.pcd", CloudFormat::pcd_ascii}, {"d.ply", CloudFormat::ply},
      {"e.ply", CloudFormat::ply_ascii}, {"f.vtk", CloudFormat::vtk}};
  for (const auto& [name, format] : kFormats) {
    test::write(folder / name, cloud, format);
    const string whole(FileContent(folder / name).text());
    for (std::size_t size = 0; size + 2 < whole.size(); size += 7) {
      INFO(name << " cut to " << size);
      try {
        // Only what comes after all points may be missing without notice.
        const Index read = test::read(whole.substr(0, size), name).size();
        CHECK(read == cloud.size());
      } catch (const Error& error) {
        CHECK(error.fault() == Fault::input);
      }
    }
  }
}

TEST_CASE("a good file with any byte changed is read or refused") {
  const test::Folder folder;
  const Mesh mesh = test::full_mesh(12);
  run::LocalContext context(1, 1);
  for (const char* name : {"a.ply", "b.stl", "c.obj", "d.off", "e.vtk"}) {
    write_mesh(folder / name, mesh, MeshFormat::automatic, 1.0, context);
    const string whole(FileContent(folder / name).text());
    for (std::size_t at = 0; at < whole.size(); ++at) {
      string changed = whole;
      changed[at] = static_cast<char>(changed[at] ^ 0x15);
      const string error = test::mesh_error_of(changed, name);
      CHECK_THAT(error, !Catch::Contains("another fault"));
    }
  }
}
