// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>

#include "commands.hpp"
#include "console.hpp"
#include "file_kind.hpp"
#include "plugins/registry.hpp"
#include "run/local_context.hpp"
#include "run/signals.hpp"
#include "run/single.hpp"
#include "run/summary.hpp"

namespace velum::app {
namespace {

namespace fs = std::filesystem;

struct Options {
  fs::path file;
  std::string units;
};

std::string line(const char* what, const std::string& text) {
  return fmt::format("{:<10} {}\n", what, text);
}

/// With as many decimals as tell `size` to six digits, so that large coordinates keep theirs.
std::string place(const Eigen::Vector3d& p, double size) {
  const double digits = size > 0.0 ? 5.0 - std::floor(std::log10(size)) : 6.0;
  const double scale = std::pow(10.0, std::clamp(digits, 0.0, 9.0));
  const auto rounded = [&](double x) { return std::round(x * scale) / scale; };
  return fmt::format("[{:.15g}, {:.15g}, {:.15g}]", rounded(p.x()), rounded(p.y()), rounded(p.z()));
}

/// Says all lengths in the unit that the user asked for.
class Describe {
 public:
  explicit Describe(LengthUnit unit) : unit_(std::move(unit)) {}

  std::string operator()(const Cloud& cloud) const {
    std::string text;
    const double size = cloud.diagonal() / unit_.metres;
    if (!cloud.empty()) {
      const Eigen::AlignedBox3f box = bounding_box(cloud.positions());
      const Eigen::Vector3d low = in_unit(box.min().cast<double>() + cloud.origin());
      const Eigen::Vector3d high = in_unit(box.max().cast<double>() + cloud.origin());
      text += line("extent",
                   fmt::format("{} to {} {}", place(low, size), place(high, size), unit_.name));
      text += line("diagonal", length(cloud.diagonal()));
      text += line("spacing", length(cloud.spacing()) + " (median to the nearest point)");
    }
    if (cloud.origin() != Eigen::Vector3d::Zero())
      text += line("origin", place(in_unit(cloud.origin()), size) + " " + unit_.name);
    for (const auto& [name, column] : cloud.columns())
      text += line("column",
                   fmt::format("{} ({}{})", name, name_of(column.scalar()),
                               column.width() > 1 ? fmt::format(" x {}", column.width()) : ""));
    for (const Sensor& sensor : cloud.sensors())
      text +=
          line("sensor", fmt::format("{} at {} {}", sensor.name,
                                     place(in_unit(sensor.pose.translation()), size), unit_.name));
    return text;
  }
  std::string operator()(const Mesh& mesh) const { return (*this)(mesh.vertices()); }
  std::string operator()(const Surface& surface) const {
    const Eigen::Vector3d low = surface.control.rowwise().minCoeff() + surface.origin;
    const Eigen::Vector3d high = surface.control.rowwise().maxCoeff() + surface.origin;
    const double size = (high - low).norm() / unit_.metres;
    std::string text =
        line("extent", fmt::format("{} to {} {} (of its control points)", place(in_unit(low), size),
                                   place(in_unit(high), size), unit_.name));
    text += line("degrees", fmt::format("{} and {}", surface.degree_u, surface.degree_v));
    text += line("weights", surface.weights.size() > 0 ? "yes (a NURBS)" : "no (a B-spline)");
    text += line("borders", surface.trimming.empty()
                                ? "not trimmed"
                                : fmt::format("{} trimming loops", surface.trimming.size()));
    return text;
  }
  std::string operator()(const Transform& transform) const {
    std::string text = line("frames", transform.source + " -> " + transform.target);
    for (int row = 0; row < 4; ++row) {
      const Eigen::RowVector4d r = transform.matrix.matrix().row(row);
      text += line(row == 0 ? "matrix" : "",
                   fmt::format("{:12.9f} {:12.9f} {:12.9f} {:14.9f}", r[0], r[1], r[2], r[3]));
    }
    const double angle = Eigen::AngleAxisd(transform.matrix.linear()).angle();
    text += line("turns", fmt::format("{:.6g} deg", angle * 180.0 / EIGEN_PI));
    text += line("moves", length(transform.matrix.translation().norm()));
    return text;
  }
  template <class Other>
  std::string operator()(const Other&) const {
    return "";
  }

 private:
  [[nodiscard]] Eigen::Vector3d in_unit(const Eigen::Vector3d& metres) const {
    return metres / unit_.metres;
  }
  [[nodiscard]] std::string length(double metres) const {
    return fmt::format("{:.6g} {}", metres / unit_.metres, unit_.name);
  }

  LengthUnit unit_;
};

void info(const Options& options) {
  const FileKind kind = kind_of_input(options.file);
  run::catch_signals();
  run::LocalContext context({.threads = run::default_threads(),
                             .arena = 0,
                             .seed = 1,
                             .cancel = &run::stop_requested(),
                             .log = {}});
  plugins::Registry registry;
  std::map<std::string, std::string> settings = {{"file", options.file.string()}};
  // STEP and IGES do, and recordings.
  const bool names_unit = kind == FileKind::surface || kind == FileKind::recording;
  if (!options.units.empty() && !names_unit) settings["units"] = options.units;
  try {
    const Results results = run::run_single(registry, reader_of(kind), settings, {}, context);
    const Value& value = results.at(0).value();
    const LengthUnit unit = length_unit(options.units.empty() ? "m" : options.units);
    std::string text = line("file", options.file.string());
    text +=
        line(std::string(name_of(type_of(value))).c_str(), run::in_words(run::summarise(value)));
    const char* otherwise = names_unit ? "m (the file names its own; --units for others here)"
                                       : "m (say --units when the file has others)";
    text += line("units", options.units.empty() ? otherwise : options.units);
    text += std::visit(Describe(unit), value);
    for (const std::string& warning : context.warnings()) text += line("note", warning);
    print(text);
  } catch (const Cancelled&) {
    throw Exit{run::kInterrupted};
  }
}

}  // namespace

void add_info(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("info", "What a cloud, mesh, surface or transform file holds");
  command->footer("Example:\n  velum info scan.pcd --units mm");
  command->add_option("FILE", options->file, "the file to read")->required();
  command->add_option("--units", options->units, "unit of the lengths in it; default: m")
      ->type_name("U");
  command->callback([options] { info(*options); });
}

}  // namespace velum::app
