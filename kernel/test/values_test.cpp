// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "velum/values.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <set>
#include <thread>

#include "velum/about.hpp"
#include "velum/stage.hpp"

using namespace velum;

namespace {

Points points_of(std::initializer_list<Eigen::Vector3f> list) {
  Points points(3, static_cast<Index>(list.size()));
  Index i = 0;
  for (const auto& point : list) points.col(i++) = point;
  return points;
}

Column floats(std::initializer_list<float> list) {
  Eigen::VectorXf values(static_cast<Index>(list.size()));
  std::copy(list.begin(), list.end(), values.begin());
  return Column(std::move(values));
}

Column labels(std::initializer_list<int> list) {
  Eigen::VectorXi values(static_cast<Index>(list.size()));
  std::copy(list.begin(), list.end(), values.begin());
  return Column(std::move(values));
}

Column sensors(std::initializer_list<int> list) {
  VectorXu8 values(static_cast<Index>(list.size()));
  Index i = 0;
  for (const int sensor : list) values(i++) = static_cast<std::uint8_t>(sensor);
  return Column(std::move(values));
}

Cloud triangle(const Eigen::Vector3d& origin = Eigen::Vector3d::Zero()) {
  return Cloud(points_of({{0, 0, 0}, {1, 0, 0}, {0, 2, 0}}), origin);
}

Pose pose_at(double x, double y, double z) {
  Pose pose = Pose::Identity();
  pose.translate(Eigen::Vector3d(x, y, z));
  return pose;
}

Pose turn_about_z(double angle, const Eigen::Vector3d& shift) {
  Pose pose = Pose::Identity();
  pose.rotate(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
  pose.pretranslate(shift);
  return pose;
}

/// Largest distance between true positions.
double difference(const Cloud& cloud, const std::vector<Eigen::Vector3d>& truth) {
  double worst = 0.0;
  for (Index i = 0; i < cloud.size(); ++i)
    worst = std::max(worst, (cloud.origin() + cloud.positions().col(i).cast<double>() -
                             truth[static_cast<std::size_t>(i)])
                                .norm());
  return worst;
}

}  // namespace

TEST_CASE("values: columns hold their elements without copies") {
  Eigen::Matrix3Xf matrix = Eigen::Matrix3Xf::Random(3, 5);
  const float* data = matrix.data();
  const Column column(std::move(matrix));
  CHECK(static_cast<const void*>(column.bytes().data()) == data);
  CHECK(column.width() == 3);
  CHECK(column.count() == 5);
  CHECK(column.bytes().size() == 60);
  CHECK(column.as<float>().cols() == 5);
  CHECK_THROWS_WITH(column.as<double>(), "a column of type f32 was used as f64");
  const Column copy = column;
  CHECK(copy.same_storage(column));
}

TEST_CASE("values: columns are selected and joined") {
  const std::vector<std::int32_t> indices = {2, 0, 2};
  CHECK(floats({1, 2, 3}).select(indices).vector<float>() == Eigen::Vector3f(3, 1, 3));
  const Eigen::MatrixXd wide = Eigen::MatrixXd::Random(7, 3);
  CHECK(Column(wide).select(indices).as<double>().col(1) == wide.col(0));
  CHECK(sensors({4, 5, 6}).select(indices).vector<std::uint8_t>()(0) == 6);
  for (const std::int32_t outside : {-1, 3}) {
    const std::vector<std::int32_t> bad = {0, outside};
    CHECK_THROWS_AS(floats({1, 2, 3}).select(bad), Error);
  }
  const Column joined = Column::concatenate(labels({1, 2}), labels({3}));
  CHECK(joined.vector<int>() == Eigen::Vector3i(1, 2, 3));
  CHECK_THROWS_AS(Column::concatenate(labels({1}), floats({1})), Error);
  CHECK_THROWS_AS(Column::concatenate(Column(wide), floats({1})), Error);
  const Column zeros = Column::zeros(Scalar::f64, 2, 3);
  CHECK(zeros.as<double>() == Eigen::MatrixXd::Zero(2, 3));
  CHECK(Column::concatenate(labels({}), labels({})).count() == 0);
}

TEST_CASE("values: clouds refuse what is no set of points") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  CHECK_THROWS_AS(Cloud(points_of({{0, nan, 0}})), Error);
  CHECK_THROWS_AS(Cloud(points_of({{0, 0, infinity}})), Error);
  CHECK_THROWS_AS(Cloud(Points(3, 0), Eigen::Vector3d(0, nan, 0)), Error);
  CHECK_THROWS_AS(Cloud(floats({1, 2, 3})), Error);
  CHECK_THROWS_AS(Cloud(Column(Eigen::Matrix3Xd(3, 1))), Error);
  CHECK(Cloud().empty());
  CHECK(Cloud().diagonal() == 0.0);
}

TEST_CASE("values: columns of a cloud") {
  const Cloud cloud = triangle().with(column::kIntensity, floats({1, 2, 3}));
  CHECK(cloud.has("intensity"));
  CHECK(cloud.intensity()(2) == 3.0F);
  CHECK_FALSE(triangle().has("intensity"));
  CHECK_THROWS_WITH(cloud.normals(), "the cloud has no column 'normals'");
  CHECK_THROWS_AS(cloud.with("extra", floats({1, 2})), Error);
  CHECK_THROWS_WITH(cloud.with(column::kLabel, floats({1, 2, 3})),
                    "column 'label' has type f32x1, expected i32x1");
  CHECK_FALSE(cloud.without("intensity").has("intensity"));
  CHECK(cloud.without("absent").columns().size() == 1);
  const Cloud again = cloud.with(column::kIntensity, floats({4, 5, 6}));
  CHECK(again.intensity()(0) == 4.0F);
  CHECK(cloud.intensity()(0) == 1.0F);
  CHECK(again.position_column().same_storage(cloud.position_column()));
  const std::vector<std::int32_t> indices = {2, 1};
  const Cloud some = cloud.select(indices);
  CHECK(some.positions().col(0) == Eigen::Vector3f(0, 2, 0));
  CHECK(some.intensity()(0) == 3.0F);
  CHECK_THROWS_AS(cloud.with_positions(Points::Zero(3, 2)), Error);
}

TEST_CASE("values: copies share their neighbours, and threads may ask at once") {
  const Cloud cloud(Points(Points::Random(3, 5000)));
  const Cloud copy = cloud.with("extra", Column::zeros(Scalar::f32, 1, 5000));
  std::set<const Neighbours*> seen;
  std::mutex mutex;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&, i] {
      const Neighbours* mine = &(i % 2 == 0 ? cloud : copy).neighbours();
      const std::lock_guard lock(mutex);
      seen.insert(mine);
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(seen.size() == 1);
  CHECK(cloud.spacing() > 0.0);
}

TEST_CASE("values: spacing and extent") {
  Points grid(3, 10000);
  for (Index i = 0; i < 10000; ++i)
    grid.col(i) << 0.01F * static_cast<float>(i % 100), 0.01F * static_cast<float>(i / 100), 0;
  const Cloud cloud(std::move(grid));
  CHECK(cloud.spacing() == Approx(0.01).epsilon(1e-4));
  CHECK(cloud.diagonal() == Approx(0.99 * std::sqrt(2.0)));
  CHECK(Cloud(points_of({{1, 2, 3}})).spacing() == 0.0);
  CHECK(triangle().spacing() == Approx(1.0));
  CHECK(Cloud(points_of({{1, 1, 1}, {1, 1, 1}})).spacing() == 0.0);
}

TEST_CASE("values: sensors") {
  const Cloud cloud =
      triangle({10, 0, 0}).with_sensors({{"a", pose_at(11, 0, 0)}, {"b", pose_at(0, 1, 0)}});
  CHECK(cloud.sensor_position(0) == Eigen::Vector3f(1, 0, 0));
  CHECK_THROWS_AS(cloud.sensor_position(2), Error);
  CHECK(cloud.sensor_of(1) == std::size_t{0});
  CHECK_FALSE(triangle().sensor_of(1));
  const Cloud seen = cloud.with(column::kSensor, sensors({0, 1, 255}));
  CHECK(seen.sensor_of(1) == std::size_t{1});
  CHECK_FALSE(seen.sensor_of(2));
}

TEST_CASE("values: motions turn normals, move sensors and act on true positions") {
  Eigen::Matrix3Xf normals(3, 3);
  normals << 1, 1, 1, 0, 0, 0, 0, 0, 0;
  const Cloud cloud = triangle({100, 0, 0})
                          .with(column::kNormals, Column(normals))
                          .with_sensors({{"a", pose_at(100, 5, 0)}});
  const double quarter = std::acos(0.0);
  const Cloud moved = cloud.transformed(turn_about_z(quarter, {0, 0, 3}));
  CHECK(difference(moved, {{0, 100, 3}, {0, 101, 3}, {-2, 100, 3}}) < 1e-5);
  CHECK((moved.normals().col(0) - Eigen::Vector3f(0, 1, 0)).norm() < 1e-6F);
  CHECK((moved.sensors()[0].pose.translation() - Eigen::Vector3d(-5, 100, 3)).norm() < 1e-9);
  CHECK(
      cloud.transformed(Pose::Identity()).position_column().same_storage(cloud.position_column()));
}

TEST_CASE("values: motions and origins lose nothing at large coordinates") {
  const Eigen::Vector3d far(5e6, 4e5, 100);
  const Cloud local(points_of({{0.001F, 0, 0}, {10, 0.002F, 0}, {0, 7, 0.003F}}));
  const Pose motion = turn_about_z(0.5, far);
  std::vector<Eigen::Vector3d> truth;
  for (Index i = 0; i < 3; ++i)
    truth.emplace_back(motion * local.positions().col(i).cast<double>());
  const Cloud there = local.transformed(motion);
  CHECK(difference(there, truth) < 2e-6);
  const Cloud back = there.transformed(motion.inverse());
  for (Index i = 0; i < 3; ++i)
    truth[static_cast<std::size_t>(i)] = local.positions().col(i).cast<double>();
  CHECK(difference(back, truth) < 3e-6);
  // Small motions keep the origin, so that clouds go on sharing it.
  CHECK(local.transformed(turn_about_z(0.5, {20, 0, 0})).origin() == Eigen::Vector3d::Zero());
  const Cloud about = there.with_origin(there.origin() + Eigen::Vector3d(1, 2, 3));
  CHECK((about.positions().col(0) - there.positions().col(0) + Eigen::Vector3f(1, 2, 3)).norm() <
        1e-5F);
  CHECK(Cloud().transformed(motion).empty());
}

TEST_CASE("values: merged clouds share one origin and the columns of all") {
  const Cloud a =
      triangle({100, 0, 0}).with("extra", floats({1, 2, 3})).with("mine", floats({1, 2, 3}));
  const Cloud b = triangle({100.5, 0, 0}).with("extra", floats({4, 5, 6}));
  const std::vector<Cloud> both = {a, b, Cloud()};
  const Cloud merged = merge(both);
  CHECK(merged.size() == 6);
  CHECK(merged.origin() == Eigen::Vector3d(100, 0, 0));
  CHECK(merged.positions().col(4) == Eigen::Vector3f(1.5F, 0, 0));
  CHECK(merged.columns().size() == 1);
  CHECK(merged.column("extra").vector<float>()(5) == 6.0F);
  CHECK(merged.sensors().empty());
  const std::vector<Cloud> unlike = {a, triangle().with("extra", labels({1, 2, 3}))};
  CHECK_THROWS_WITH(merge(unlike),
                    "column 'extra' has type f32x1 in one cloud and i32x1 in another");
  CHECK(merge(std::vector<Cloud>{}).empty());
  CHECK(merge(std::vector<Cloud>{Cloud(), a}).columns().size() == 2);
}

TEST_CASE("values: merged clouds know which sensor saw which point") {
  const Sensor left{"left", pose_at(1, 0, 0)};
  const Sensor right{"right", pose_at(2, 0, 0)};
  const Sensor third{"third", pose_at(3, 0, 0)};
  const Cloud a = triangle().with_sensors({left});
  const Cloud b = triangle().with_sensors({third, right}).with(column::kSensor, sensors({1, 0, 1}));
  const Cloud merged = merge(std::vector<Cloud>{a, b, a, triangle()});
  REQUIRE(merged.sensors().size() == 3);
  const auto name = [&](Index i) { return merged.sensors()[merged.sensor_of(i).value()].name; };
  CHECK(name(0) == "left");
  CHECK(name(3) == "right");
  CHECK(name(4) == "third");
  CHECK(name(8) == "left");
  CHECK_FALSE(merged.sensor_of(9));
  // Parts of one scan need no column.
  CHECK_FALSE(merge(std::vector<Cloud>{a, a}).has(column::kSensor));
  CHECK(merge(std::vector<Cloud>{a, a}).sensors().size() == 1);
}

TEST_CASE("values: meshes") {
  Triangles one(3, 1);
  one << 0, 1, 2;
  const Mesh mesh(triangle(), one);
  CHECK(mesh.size() == 1);
  CHECK(mesh.triangles()(2, 0) == 2);
  CHECK(mesh.with_vertices(triangle({5, 0, 0})).origin().x() == 5.0);
  CHECK_THROWS_AS(mesh.with_vertices(Cloud()), Error);
  one(1, 0) = 3;
  CHECK_THROWS_WITH(Mesh(triangle(), one),
                    "a triangle names vertex 3, but the mesh has 3 vertices");
  one(1, 0) = -1;
  CHECK_THROWS_AS(Mesh(triangle(), one), Error);
  CHECK(Mesh().empty());
}

TEST_CASE("values: tables") {
  Table table({{"height", "m"}, {"name", ""}});
  table.add({1.5, "head"});
  table.add({std::int64_t{2}, "foot"});
  CHECK(table.number(0, "height") == 1.5);
  CHECK(table.number(1, "height") == 2.0);
  CHECK(std::get<std::string>(table.at(1, "name")) == "foot");
  CHECK_THROWS_AS(table.add({1.0}), Error);
  CHECK_THROWS_WITH(table.at(0, "chord"), "the table has no column 'chord'");
  CHECK_THROWS_AS(table.at(2, "name"), Error);
  CHECK_THROWS_AS(table.number(0, "name"), Error);
}

TEST_CASE("values: equal values have equal hashes, others have not") {
  const Cloud cloud = triangle().with(column::kIntensity, floats({1, 2, 3}));
  CHECK(hash_of(cloud).size() == 32);
  CHECK(hash_of(cloud) == hash_of(triangle().with(column::kIntensity, floats({1, 2, 3}))));
  std::vector<Value> values = {
      cloud,
      triangle(),
      Cloud(),
      triangle({0, 0, 1e-9}),
      cloud.with_sensors({{"a", Pose::Identity()}}),
      cloud.with_sensors({{"b", Pose::Identity()}}),
      cloud.with_sensors({{"b", pose_at(0, 0, 1)}}),
      triangle().with("other", floats({1, 2, 3})),
      triangle().with("other", labels({1, 2, 3})),
      triangle().with(column::kIntensity, floats({1, 2, 4})),
      Mesh(cloud, Triangles(3, 0)),
      Clusters{cloud, labels({0, 0, 1}), Table()},
      Clusters{cloud, labels({0, 0, 2}), Table()},
      Transform(),
      Transform{Pose::Identity(), "source", "target", 0.5, Table()},
      Transform{Pose::Identity(), "sourcet", "arget", -1.0, Table()},
      Surface(),
      Correspondences(),
      Table(),
      Table({{"a", "m"}}),
      Table({{"a", "mm"}}),
      Table({{"am", "m"}}),
  };
  Table number({{"a", "m"}});
  number.add({1.0});
  Table text({{"a", "m"}});
  text.add({"1"});
  values.insert(values.end(), {number, text});
  std::set<std::string> hashes;
  for (const Value& value : values) hashes.insert(hash_of(value));
  CHECK(hashes.size() == values.size());
}

TEST_CASE("values: what is empty") {
  Table kinds({{"cluster", ""}});
  kinds.add({std::int64_t{0}});
  CHECK(is_empty(Cloud()));
  CHECK(is_empty(Mesh(triangle(), Triangles(3, 0))));
  CHECK(is_empty(Surface()));
  CHECK(is_empty(Clusters{triangle(), labels({-1, -1, -1}), Table()}));
  CHECK_FALSE(is_empty(Clusters{triangle(), labels({0, 0, 0}), kinds}));
  CHECK(is_empty(Correspondences()));
  CHECK_FALSE(is_empty(Table()));
  CHECK_FALSE(is_empty(Transform()));
  CHECK_FALSE(is_empty(triangle()));
}

TEST_CASE("values: names") {
  CHECK(name_of(Scalar::f64) == "f64");
  CHECK(size_of(Scalar::u8) == 1);
  CHECK(name_of(ValueType::correspondences) == "correspondences");
  CHECK(name_of(Determinism::tolerance) == "tolerance");
  CHECK(name_of(ParameterType::rows) == "rows");
  CHECK(type_of(Value(Table())) == ValueType::table);
}
