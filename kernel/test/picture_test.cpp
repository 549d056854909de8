// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <set>

#include "folder.hpp"
#include "picture/camera.hpp"
#include "picture/colours.hpp"
#include "picture/lettering.hpp"
#include "picture/raster.hpp"
#include "report/pictures.hpp"
#include "velum/files.hpp"
#include "velum/random.hpp"

using namespace velum;
using test::Folder;

namespace {

Points scattered(Index count, const Eigen::Vector3f& size) {
  Random random(7);
  Points points(3, count);
  for (Index i = 0; i < count; ++i)
    for (int axis = 0; axis < 3; ++axis)
      points(axis, i) = size[axis] * static_cast<float>(random.uniform());
  return points;
}

ConstPoints view(const Points& points) {
  return {points.data(), 3, points.cols()};
}

double lightness(const picture::Colour& colour) {
  return static_cast<double>(0.2126F * colour[0] + 0.7152F * colour[1] + 0.0722F * colour[2]);
}

/// Pixels of the image that are not white.
int drawn(const picture::Image& image) {
  int count = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) count += (image.at(x, y) < 0.99F).any() ? 1 : 0;
  return count;
}

}  // namespace

TEST_CASE("the ramp of colours grows ever lighter") {
  for (int i = 0; i < 100; ++i)
    CHECK(lightness(picture::colour_of(i / 100.0)) <
          lightness(picture::colour_of((i + 1) / 100.0)) + 1e-3);
  CHECK(lightness(picture::colour_of(1.0)) > lightness(picture::colour_of(0.0)) + 0.5);
  for (int label = 0; label < 30; ++label)
    CHECK((picture::colour_of_label(label) - picture::colour_of_label(label + 1)).abs().sum() >
          0.2F);
}

TEST_CASE("the camera keeps z up and the whole shape in the picture") {
  const Points box = scattered(5000, {3.0F, 2.0F, 1.0F});
  const picture::Camera camera = picture::look_at(view(box), {}, 800, 600);
  CHECK((camera.axes * camera.axes.transpose()).isIdentity(1e-5F));
  CHECK(camera.axes(0, 2) == Approx(0.0F).margin(1e-6));
  CHECK(camera.axes(1, 2) > 0.0F);
  int outside = 0;
  for (Index i = 0; i < box.cols(); ++i) {
    const Eigen::Vector3f seen = camera.axes * box.col(i);
    const Eigen::Vector2f off = camera.pixels * (seen.head<2>() - camera.middle);
    if (std::abs(off.x()) > 400.0F || std::abs(off.y()) > 300.0F) ++outside;
  }
  CHECK(outside == 0);
}

TEST_CASE("what is flat and upright is seen from its broad side, and from the scanner's") {
  const Points wall = scattered(2000, {0.01F, 4.0F, 3.0F});
  CHECK(std::abs(picture::look_at(view(wall), {}, 800, 600).axes(2, 0)) > 0.85F);
  const Points box = scattered(2000, {1.0F, 1.0F, 1.0F});
  const picture::Camera from_left =
      picture::look_at(view(box), {Eigen::Vector3f(-9.0F, 0.5F, 0.5F)}, 800, 600);
  CHECK(from_left.axes(2, 0) < -0.85F);
  // A scanner within a room sees it from within: no side is the right one.
  const picture::Camera within =
      picture::look_at(view(box), {Eigen::Vector3f(0.5F, 0.5F, 0.5F)}, 800, 600);
  CHECK(within.axes(2, 2) > 0.4F);
}

TEST_CASE("strays do not shrink the rest to a dot") {
  Points points = scattered(5000, {1.0F, 1.0F, 1.0F});
  points.col(17) = Eigen::Vector3f(900.0F, 0.0F, 0.0F);
  CHECK(picture::look_at(view(points), {}, 800, 600).pixels > 200.0F);
}

TEST_CASE("what is nearer hides what is behind it") {
  picture::Camera camera;  // looks down z
  camera.pixels = 10.0F;
  Points corners(3, 6);
  corners << -2, 2, 0, -2, 2, 0, -2, -2, 2, -2, -2, 2, 0, 0, 0, 1, 1, 1;
  Triangles both(3, 2);
  both << 3, 0, 4, 1, 5, 2;
  const picture::Colour red(1.0F, 0.0F, 0.0F);
  const picture::Colour blue(0.0F, 0.0F, 1.0F);
  picture::Raster raster(60, 60, camera);
  raster.draw_triangles(view(corners), ConstTriangles(both.data(), 3, 2),
                        {red, red, red, blue, blue, blue});
  picture::Image image(60, 60);
  raster.show(image, 0, 0);
  CHECK(image.at(30, 30)[2] > 0.4F);
  CHECK(image.at(30, 30)[0] < 0.05F);
  CHECK((image.at(1, 1) == 1.0F).all());
}

TEST_CASE("every letter that is used has a drawing of its own") {
  std::set<std::pair<int, int>> shapes;
  const std::string letters =
      "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz.,:-_+=/()[]%";
  picture::Image unknown(60, 60);
  picture::draw_text(unknown, "~", 10.0, 40.0, 24.0, picture::ink());
  for (const char letter : letters) {
    picture::Image image(60, 60);
    picture::draw_text(image, std::string(1, letter), 10.0, 40.0, 24.0, picture::ink());
    int difference = 0;
    int weight = 0;
    for (int y = 0; y < 60; ++y)
      for (int x = 0; x < 60; ++x) {
        difference += ((image.at(x, y) - unknown.at(x, y)).abs() > 0.3F).any() ? 1 : 0;
        weight += image.at(x, y)[0] < 0.5F ? 61 * y + x * x : 0;
      }
    INFO(letter);
    CHECK(drawn(image) > 3);
    CHECK(difference > 20);
    CHECK(shapes.emplace(drawn(image), weight).second);
  }
  CHECK(picture::width_of("mm", 12.0) > picture::width_of("ii", 12.0));
}

TEST_CASE("extreme sizes and numbers have pictures") {
  const Folder folder;
  for (const float size : {1e-40F, 1e-20F, 1e20F}) {
    const Cloud cloud(scattered(50, {size, size, size}));
    CHECK(report::draw_value(cloud, "a", "", folder / "a.png"));
  }
  for (const double most : {1.7e308, 1e18, 1e-300}) {
    const Eigen::VectorXd numbers = Eigen::VectorXd::LinSpaced(50, -1.0, 1.0) * most;
    const Eigen::VectorXd late = (Eigen::VectorXd::LinSpaced(50, 0.0, 2.0).array() + 1e18).matrix();
    const Cloud cloud = Cloud(scattered(50, {1.0F, 1.0F, 1.0F}))
                            .with("x", Column(numbers))
                            .with("late", Column(late));
    for (const char* colour : {"x", "late", "not there"})
      CHECK(report::draw_value(cloud, "a", colour, folder / "a.png"));
  }
}

TEST_CASE("every value with a shape has a picture, the same bytes each time") {
  const Folder folder;
  Clusters clusters;
  clusters.cloud = Cloud(scattered(500, {1.0F, 1.0F, 1.0F}));
  clusters.labels = Column(Eigen::VectorXi(Eigen::VectorXi::LinSpaced(500, -1, 3)));
  Eigen::VectorXf holes = Eigen::VectorXf::Constant(500, std::numeric_limits<float>::quiet_NaN());
  Triangles triangle(3, 1);
  triangle << 0, 1, 2;
  const std::vector<Value> values = {
      clusters,
      clusters.cloud.with("displacement", Column(holes)),
      Cloud(),
      Cloud(Points(Eigen::Vector3f(1.0F, 2.0F, 3.0F)), Eigen::Vector3d(5e6, 1e6, 0.0)),
      Mesh(clusters.cloud, triangle),
      Mesh(),
      Surface()};
  for (const Value& value : values) {
    std::string first;
    for (const char* name : {"a.png", "b.png"}) {
      REQUIRE(report::draw_value(value, "node.cloud", "", folder / name));
      const std::string bytes(FileContent(folder / name).text());
      CHECK(bytes.starts_with("\x89PNG"));
      if (first.empty()) first = bytes;
      CHECK(bytes == first);
    }
  }
  CHECK_FALSE(report::draw_value(Table({{"x", ""}}), "t", "", folder / "t.png"));
}
