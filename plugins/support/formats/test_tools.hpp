// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>

#include "formats/cloud_io.hpp"
#include "formats/mesh_io.hpp"
#include "kernel/src/run/local_context.hpp"
#include "velum/values.hpp"

/// What the tests of formats share.
namespace velum::formats::test {

/// A folder of its own that is removed at the end.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "velum_formats_XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const {
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

/// `count` points on a curved surface, without columns.
inline Cloud plain_cloud(Index count, const Eigen::Vector3d& origin = Eigen::Vector3d::Zero()) {
  Points points(3, count);
  for (Index i = 0; i < count; ++i) {
    const auto t = static_cast<float>(i);
    points.col(i) << std::sin(t * 0.37F) * 3.1F, t * 0.0123F, std::cos(t * 0.11F) - 0.5F;
  }
  return Cloud(std::move(points), origin);
}

/// The same with a column of every meaning and type, and two sensors.
inline Cloud full_cloud(Index count, const Eigen::Vector3d& origin = Eigen::Vector3d::Zero()) {
  Cloud cloud = plain_cloud(count, origin);
  Points normals(3, count);
  Eigen::VectorXf real(count);
  Eigen::VectorXd time(count);
  Eigen::VectorXi whole(count);
  VectorXu8 byte(count);
  Eigen::Matrix<std::uint8_t, 3, Eigen::Dynamic> colour(3, count);
  Eigen::Matrix<float, 5, Eigen::Dynamic> wide(5, count);
  for (Index i = 0; i < count; ++i) {
    const auto t = static_cast<float>(i);
    normals.col(i) = Eigen::Vector3f(std::sin(t), 0.3F, std::cos(t)).normalized();
    real[i] = 0.01F * t + 0.123F;
    time[i] = 1.5e9 + 0.1 * static_cast<double>(i);
    whole[i] = static_cast<int>(i % 7) - 1;
    byte[i] = static_cast<std::uint8_t>(i % 2);
    colour.col(i) << static_cast<std::uint8_t>(i % 256), static_cast<std::uint8_t>(i % 13 * 19),
        255;
    for (Index c = 0; c < 5; ++c) wide(c, i) = static_cast<float>(c) + 0.25F * t + 0.1F;
  }
  Sensor first{"left scanner", Pose::Identity()};
  first.pose.translation() = Eigen::Vector3d(0.1, -2.25, 1e-3);
  first.pose.linear() =
      Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  return cloud.with(column::kNormals, Column(normals))
      .with(column::kCurvature,
            Column(Eigen::VectorXf(real.array() / (3.1F + 3.0F * real.array()))))
      .with(column::kIntensity, Column(Eigen::VectorXf(real * 100.0F)))
      .with(column::kColour, Column(colour))
      .with(column::kTime, Column(time))
      .with(column::kLabel, Column(whole))
      .with(column::kSensor, Column(byte))
      .with(column::kBeam, Column(whole))
      .with(column::kLine, Column(whole))
      .with(column::kTilt, Column(real))
      .with("quality", Column(byte))
      .with("echo", Column(whole))
      .with("height", Column(Eigen::VectorXf(real * 3.0F)))
      .with("range", Column(Eigen::VectorXd(time / 7.0)))
      .with("histogram", Column(wide))
      .with_sensors({first, {"right", Pose::Identity()}});
}

inline Cloud read(std::string_view content, const std::string& name = "cloud.pcd",
                  const ReadOptions& options = {}) {
  Source source(name, content);
  run::LocalContext context(2, 1);
  return read_cloud(source, options, context);
}

inline Cloud read_file(const std::filesystem::path& path, const ReadOptions& options = {}) {
  Source source(path);
  run::LocalContext context(2, 1);
  return read_cloud(source, options, context);
}

inline void write(const std::filesystem::path& path, const Cloud& cloud,
                  CloudFormat format = CloudFormat::automatic, double unit = 1.0) {
  run::LocalContext context(2, 1);
  write_cloud(path, cloud, format, unit, context);
}

/// The error of reading `content`, "" when there is none: "where: message".
inline std::string error_of(std::string_view content, const std::string& name = "cloud.pcd",
                            const ReadOptions& options = {}) {
  try {
    (void)read(content, name, options);
  } catch (const Error& error) {
    if (error.fault() != Fault::input) return "another fault: " + std::string(error.what());
    return error.where() + ": " + error.what();
  }
  return "";
}

inline Mesh read_mesh_text(std::string_view content, const std::string& name = "mesh.obj",
                           const ReadOptions& options = {}) {
  Source source(name, content);
  run::LocalContext context(2, 1);
  return read_mesh(source, options, context);
}

inline Mesh read_mesh_file(const std::filesystem::path& path, const ReadOptions& options = {}) {
  Source source(path);
  run::LocalContext context(2, 1);
  return read_mesh(source, options, context);
}

inline std::string mesh_error_of(std::string_view content, const std::string& name = "mesh.obj") {
  try {
    (void)read_mesh_text(content, name);
  } catch (const Error& error) {
    if (error.fault() != Fault::input) return "another fault: " + std::string(error.what());
    return error.where() + ": " + error.what();
  }
  return "";
}

/// A grid of triangles over the points of full_cloud().
inline Mesh full_mesh(Index count, const Eigen::Vector3d& origin = Eigen::Vector3d::Zero()) {
  Triangles triangles(3, count - 2);
  for (Index i = 0; i < count - 2; ++i) {
    const auto first = static_cast<std::int32_t>(i);
    triangles.col(i) << first, first + 1, first + 2;
  }
  return {full_cloud(count, origin), std::move(triangles)};
}

template <class T>
std::string bytes_of(std::initializer_list<T> values) {
  std::string bytes;
  for (const T& value : values) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    bytes.append(raw, sizeof(T));
  }
  return bytes;
}

}  // namespace velum::formats::test
