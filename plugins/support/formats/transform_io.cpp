// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "formats/transform_io.hpp"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <nlohmann/json.hpp>

#include "formats/lines.hpp"
#include "formats/records.hpp"

namespace velum::formats {
namespace {

using nlohmann::json;

/// A matrix that deviates more is refused: four digits of a text file are kept.
constexpr double kRounding = 1e-3;
/// A matrix that deviates less is taken as it is, so that what was written is read the same.
constexpr double kExact = 1e-12;
constexpr std::size_t kLargestFile = std::size_t{16} << 20U;

struct Content {
  std::vector<double> numbers;
  Transform transform;
  std::optional<LengthUnit> unit;
};

Error not_a_matrix(const Source& source, std::size_t numbers) {
  return Error(Fault::input,
               fmt::format("found {} numbers, expected the 16 of a 4x4 matrix", numbers))
      .at(source.name());
}

LengthUnit unit_called(const Source& source, const std::string& name) {
  try {
    return length_unit(name);
  } catch (const Error& error) {
    throw Error(Fault::input, error.what()).at(source.name());
  }
}

/// "name: value" of a comment.
void read_comment(const Source& source, std::string_view comment, Content& content) {
  const std::size_t colon = comment.find(':');
  if (colon == std::string_view::npos) return;
  const std::string key = lower(trimmed(comment.substr(0, colon)));
  const std::string value(trimmed(comment.substr(colon + 1)));
  if (key == "source") content.transform.source = value;
  if (key == "target") content.transform.target = value;
  if (key == "unit") content.unit = unit_called(source, value);
  if (key == "fitness") content.transform.fitness = as_real(value).value_or(-1.0);
}

Content read_text(const Source& source) {
  Content content;
  std::string_view rest = source.text();
  while (!rest.empty()) {
    const std::string_view line = trimmed(take_line(rest));
    if (line.starts_with('#')) {
      read_comment(source, line.substr(1), content);
      continue;
    }
    std::string plain(line);
    for (char& c : plain)
      if (c == ',' || c == ';' || c == '[' || c == ']') c = ' ';
    for (const std::string_view word : words_of(plain)) {
      const auto value = as_real(word);
      if (!value)
        throw source.bad_line(line, "found " + quote(word) + ", expected a number of a 4x4 matrix");
      content.numbers.push_back(*value);
      if (content.numbers.size() > 16)
        throw source.bad_line(line, "more than the 16 numbers expected");
    }
  }
  return content;
}

/// The numbers of an array, or of its arrays.
void gather(const json& node, std::vector<double>& numbers) {
  constexpr std::size_t kMost = 17;  // one too many is seen
  if (!node.is_array()) return;
  for (const json& part : node) {
    if (part.is_number() && numbers.size() < kMost) numbers.push_back(part.get<double>());
    if (!part.is_array()) continue;
    for (const json& cell : part)
      if (cell.is_number() && numbers.size() < kMost) numbers.push_back(cell.get<double>());
  }
}

json parse(const Source& source) {
  try {
    return json::parse(source.text());
  } catch (const json::parse_error& error) {
    throw source.bad_line(error.byte == 0 ? 0 : error.byte - 1,
                          "this is no JSON: it cannot be read from here on");
  } catch (const json::exception&) {
    throw Error(Fault::input, "a number that is out of range").at(source.name());
  }
}

std::string text_of(const json& node, const char* key, const std::string& otherwise) {
  const auto found = node.find(key);
  return found != node.end() && found->is_string() ? found->get<std::string>() : otherwise;
}

Content read_json(const Source& source, const std::string& entry) {
  const json all = parse(source);
  const json* node = &all;
  if (!entry.empty()) {
    try {
      node = &all.at(json::json_pointer(entry));
    } catch (const json::exception&) {
      throw Error(Fault::input, "the file has no entry " + quote(entry)).at(source.name());
    }
  }
  Content content;
  if (node->is_object()) {
    content.transform.source = text_of(*node, "source", content.transform.source);
    content.transform.target = text_of(*node, "target", content.transform.target);
    if (node->contains("unit")) content.unit = unit_called(source, text_of(*node, "unit", "?"));
    const auto fitness = node->find("fitness");
    if (fitness != node->end() && fitness->is_number())
      content.transform.fitness = fitness->get<double>();
    const auto matrix = node->find("matrix");
    if (matrix == node->end())
      throw Error(Fault::input, "the JSON object has no entry 'matrix'")
          .at(source.name())
          .hint("name the matrix's place by entry = \"/name/of/entry\"");
    node = &*matrix;
  }
  gather(*node, content.numbers);
  return content;
}

std::string name_for_line(std::string name) {
  for (char& c : name)
    if (c >= '\0' && c < ' ') c = ' ';
  return name;
}

std::string row_of(const Eigen::Matrix4d& matrix, Index row, const char* separator) {
  return fmt::format("{:.17g}{}{:.17g}{}{:.17g}{}{:.17g}", matrix(row, 0), separator,
                     matrix(row, 1), separator, matrix(row, 2), separator, matrix(row, 3));
}

std::string as_text(const Transform& transform, const Eigen::Matrix4d& matrix,
                    const std::string& unit) {
  std::string text = fmt::format(
      "# rigid motion written by Velum\n# source: {}\n# target: {}\n"
      "# unit: {}\n",
      name_for_line(transform.source), name_for_line(transform.target), unit);
  if (transform.fitness >= 0.0) text += fmt::format("# fitness: {:.17g}\n", transform.fitness);
  for (Index row = 0; row < 4; ++row) text += row_of(matrix, row, " ") + "\n";
  return text;
}

std::string as_json(const Transform& transform, const Eigen::Matrix4d& matrix,
                    const std::string& unit) {
  const auto quoted = [](const std::string& name) {
    return json(name).dump(-1, ' ', true, json::error_handler_t::replace);
  };
  std::string text = fmt::format("{{\n  \"source\": {},\n  \"target\": {},\n  \"unit\": {},\n",
                                 quoted(transform.source), quoted(transform.target), quoted(unit));
  if (transform.fitness >= 0.0) text += fmt::format("  \"fitness\": {:.17g},\n", transform.fitness);
  text += "  \"matrix\": [\n";
  for (Index row = 0; row < 4; ++row)
    text += fmt::format("    [{}]{}\n", row_of(matrix, row, ", "), row < 3 ? "," : "");
  return text + "  ]\n}\n";
}

}  // namespace

Pose rigid_motion(const Source& source, const Eigen::Matrix4d& matrix) {
  if (!matrix.allFinite())
    throw Error(Fault::input, "the matrix has entries that are not finite").at(source.name());
  const Eigen::Matrix3d turn = matrix.topLeftCorner<3, 3>();
  const double skew = (turn.transpose() * turn - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  const double last = (matrix.row(3) - Eigen::RowVector4d::Unit(3)).cwiseAbs().maxCoeff();
  if (!(skew <= kRounding) || !(last <= kRounding) || turn.determinant() < 0.0)
    throw Error(Fault::input,
                fmt::format("the matrix is no rigid motion: its axes deviate by {:.3g} from unit "
                            "length and right angles, its last row by {:.3g} from 0 0 0 1, its "
                            "determinant is {:.3g}; at most {} and a determinant of 1 are expected",
                            skew, last, turn.determinant(), kRounding))
        .at(source.name());
  Pose pose = Pose::Identity();
  pose.linear() = turn;
  if (skew > kExact) {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(turn, Eigen::ComputeFullU | Eigen::ComputeFullV);
    pose.linear() = svd.matrixU() * svd.matrixV().transpose();
  }
  pose.translation() = matrix.topRightCorner<3, 1>();
  return pose;
}

Transform read_transform(const Source& source, const TransformOptions& options) {
  if (source.size() > kLargestFile)
    throw Error(Fault::input, fmt::format("{} bytes are too many for a transform", source.size()))
        .at(source.name());
  const std::string_view start = trimmed(source.text());
  const bool is_json = start.starts_with('{') || (start.starts_with('[') && start.ends_with(']')) ||
                       source.extension() == ".json" || !options.entry.empty();
  Content content = is_json ? read_json(source, options.entry) : read_text(source);
  if (content.numbers.size() != 16) throw not_a_matrix(source, content.numbers.size());
  const Eigen::Matrix4d matrix =
      Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(content.numbers.data());
  Transform transform = std::move(content.transform);
  transform.matrix = rigid_motion(source, matrix);
  transform.matrix.translation() *= content.unit ? content.unit->metres : options.unit;
  return transform;
}

void write_transform(const std::filesystem::path& path, const Transform& transform,
                     TransformFormat format, const LengthUnit& unit) {
  if (format == TransformFormat::automatic)
    format =
        lower(path.extension().string()) == ".json" ? TransformFormat::json : TransformFormat::text;
  Eigen::Matrix4d matrix = transform.matrix.matrix();
  matrix.topRightCorner<3, 1>() /= unit.metres;
  write_file(path, format == TransformFormat::json ? as_json(transform, matrix, unit.name)
                                                   : as_text(transform, matrix, unit.name));
}

}  // namespace velum::formats
