// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "scene/keys.hpp"

#include <cmath>
#include <numbers>

#include "graph/diagnostic.hpp"
#include "graph/units.hpp"

namespace velum::scene {
namespace {

using Eigen::Vector3d;
using graph::toml::Kind;

constexpr double kDegree = std::numbers::pi / 180.0;

std::string article(Kind kind) {
  return "it is a " + std::string(name_of(kind));
}

}  // namespace

void SceneFile::fail(const graph::toml::Region& where, const std::string& message,
                     const std::string& hint) const {
  throw Error(Fault::input, message)
      .at(name + ":" + std::to_string(where.begin.line) + ":" + std::to_string(where.begin.column))
      .hint(hint);
}

Keys::Keys(const SceneFile& file, const Node& table, std::string subject)
    : file_(file), table_(table), subject_(std::move(subject)) {
  if (!table.is(Kind::table))
    file.fail(table.where, subject_ + " must be a table; " + article(table.kind));
}

std::string Keys::what(std::string_view key) const {
  return std::string(1, '\'').append(key).append("' of ").append(subject_);
}

const Node* Keys::find(std::string_view key) {
  asked_.emplace(key);
  const Entry* entry = table_.find(key);
  return entry != nullptr ? &entry->value : nullptr;
}

bool Keys::has(std::string_view key) {
  return find(key) != nullptr;
}

const Node& Keys::node(std::string_view key) {
  const Node* found = find(key);
  if (found == nullptr)
    file_.fail(table_.where, subject_ + " has no '" + std::string(key) + "', which it needs");
  return *found;
}

std::string Keys::text(std::string_view key) {
  const Node& value = node(key);
  if (!value.is(Kind::string))
    file_.fail(value.where, what(key) + " must be text; " + article(value.kind));
  return value.text;
}

std::int32_t Keys::integer(std::string_view key) {
  const Node& value = node(key);
  if (!value.is(Kind::integer) || std::abs(value.integer) > 1'000'000'000)
    file_.fail(value.where, what(key) + " must be an integer of at most nine digits");
  return static_cast<std::int32_t>(value.integer);
}

double Keys::number_of(const Node& value, const std::string& name) const {
  double number = value.number;
  if (value.is(Kind::integer)) number = static_cast<double>(value.integer);
  if (!(value.is(Kind::integer) || value.is(Kind::number)) || !std::isfinite(number))
    file_.fail(value.where, name + " must be a finite number");
  return number;
}

double Keys::length_of(const Node& value, const std::string& name) const {
  if (!value.is(Kind::string)) return number_of(value, name) * file_.metre;
  const auto amount = graph::parse_amount(value.text);
  const auto length = amount ? graph::to_length(*amount) : std::nullopt;
  if (!length || length->of != Length::Of::metres)
    file_.fail(value.where, name + " must be a length; it is \"" + value.text + "\"",
               "write a number, or text such as \"5 mm\"");
  return length->value;
}

double Keys::angle_of(const Node& value, const std::string& name) const {
  if (!value.is(Kind::string)) return number_of(value, name) * kDegree;
  const auto amount = graph::parse_amount(value.text);
  const auto angle = amount ? graph::to_angle(*amount) : std::nullopt;
  if (!angle)
    file_.fail(value.where, name + " must be an angle; it is \"" + value.text + "\"",
               "write degrees as a number, or text such as \"0.1 rad\"");
  return *angle;
}

const std::vector<Node>& Keys::items(const Node& value, std::size_t count,
                                     const std::string& name) const {
  if (!value.is(Kind::array) || value.items.size() != count)
    file_.fail(value.where, name + " must be an array of " + std::to_string(count) + " values");
  return value.items;
}

double Keys::length(std::string_view key) {
  const Node& value = node(key);
  const double length = length_of(value, what(key));
  if (length <= 0.0) file_.fail(value.where, what(key) + " must be above 0");
  return length;
}

double Keys::length(std::string_view key, double otherwise) {
  const Node* value = find(key);
  return value != nullptr ? length_of(*value, what(key)) : otherwise;
}

double Keys::angle(std::string_view key, double otherwise) {
  const Node* value = find(key);
  return value != nullptr ? angle_of(*value, what(key)) : otherwise;
}

double Keys::number(std::string_view key, double otherwise) {
  const Node* value = find(key);
  return value != nullptr ? number_of(*value, what(key)) : otherwise;
}

double Keys::number_between(std::string_view key, double low, double high) {
  const Node& value = node(key);
  const double number = number_of(value, what(key));
  if (number < low || number > high) {
    const auto shown = [](double x) { return std::to_string(static_cast<int>(std::lround(x))); };
    file_.fail(value.where, what(key) + " must be between " + shown(low) + " and " + shown(high));
  }
  return number;
}

Vector3d Keys::place_of(const Node& value, const std::string& name) const {
  const auto& three = items(value, 3, name);
  return {length_of(three[0], name), length_of(three[1], name), length_of(three[2], name)};
}

Vector3d Keys::place(std::string_view key) {
  return place_of(node(key), what(key));
}

Vector3d Keys::place(std::string_view key, const Vector3d& otherwise) {
  const Node* value = find(key);
  return value != nullptr ? place_of(*value, what(key)) : otherwise;
}

std::vector<double> Keys::lengths(std::string_view key, std::size_t count) {
  std::vector<double> lengths;
  for (const Node& one : items(node(key), count, what(key)))
    lengths.push_back(length_of(one, what(key)));
  return lengths;
}

Vector3d Keys::direction(std::string_view key, const Vector3d& otherwise) {
  const Node* value = find(key);
  if (value == nullptr) return otherwise;
  const auto& three = items(*value, 3, what(key));
  const Vector3d vector(number_of(three[0], what(key)), number_of(three[1], what(key)),
                        number_of(three[2], what(key)));
  if (vector.norm() == 0.0) file_.fail(value->where, what(key) + " must not be all zero");
  return vector.normalized();
}

Eigen::Matrix3d Keys::rotation(std::string_view key) {
  const Node* value = find(key);
  if (value == nullptr) return Eigen::Matrix3d::Identity();
  const auto& three = items(*value, 3, what(key));
  return (Eigen::AngleAxisd(angle_of(three[2], what(key)), Vector3d::UnitZ()) *
          Eigen::AngleAxisd(angle_of(three[1], what(key)), Vector3d::UnitY()) *
          Eigen::AngleAxisd(angle_of(three[0], what(key)), Vector3d::UnitX()))
      .toRotationMatrix();
}

Pose Keys::pose() {
  Pose pose = Pose::Identity();
  pose.translation() = place("position", Vector3d::Zero());
  pose.linear() = rotation("rotation");
  return pose;
}

const std::vector<Node>& Keys::array(std::string_view key) {
  const Node& value = node(key);
  if (!value.is(Kind::array) || value.items.empty())
    file_.fail(value.where, what(key) + " must be an array of at least one value");
  return value.items;
}

void Keys::fail(std::string_view key, const std::string& message, const std::string& hint) const {
  const Entry* entry = table_.find(key);
  file_.fail(entry != nullptr ? entry->value.where : table_.where, what(key) + " " + message, hint);
}

void Keys::finish() const {
  for (const Entry& entry : table_.entries) {
    if (asked_.contains(entry.key)) continue;
    const std::vector<std::string> known(asked_.begin(), asked_.end());
    const std::string guess = graph::did_you_mean(entry.key, known);
    file_.fail(entry.where, "unknown key '" + entry.key + "' in " + subject_,
               guess.empty() ? graph::known_list(known) : guess);
  }
}

}  // namespace velum::scene
