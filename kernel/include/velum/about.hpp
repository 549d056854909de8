// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>

#include "velum/context.hpp"
#include "velum/parameter.hpp"
#include "velum/values.hpp"

namespace velum {

/// How far two runs of a stage with the same inputs, parameters and seed agree.
enum class Determinism : std::uint8_t { bitwise, seeded, tolerance, none };
VELUM_API std::string_view name_of(Determinism determinism);

/// A column that a port needs or adds; with `parameter`, only when that parameter has that value.
struct ColumnRule {
  std::string column;
  std::string parameter;
  std::string value;
};

/// An input or output of a stage.
struct Port {
  std::string name;
  std::string doc;
  std::vector<ValueType> types;  ///< accepted; outputs have one
  bool required = true;
  bool many = false;
  std::vector<ColumnRule> columns;  ///< needed of an input, added by an output
};

/// All that can be said about a stage.
struct StageInfo {
  std::string id;
  std::string version = "1";
  std::string summary;
  std::vector<Port> inputs;
  std::vector<Port> outputs;
  std::vector<Parameter> parameters;
  Determinism determinism = Determinism::bitwise;
  bool cacheable = true;
  bool isolated = false;  ///< runs in a process of its own unless the graph says otherwise
  /// Output columns are those of the first input unless said otherwise.
  bool keeps_columns = true;
  std::vector<std::string> references;
  std::string licence = "MIT";
};

namespace detail {

// How a member of a stage appears as a parameter: type, and conversion from and to a Setting.
template <class M>
struct Kind;

template <class M, ParameterType Type, class Stored>
struct PlainKind {
  static constexpr ParameterType type = Type;
  static M from(const Setting& setting) { return static_cast<M>(std::get<Stored>(setting.value)); }
  static Setting to(const M& member) { return {static_cast<Stored>(member)}; }
};
template <>
struct Kind<bool> : PlainKind<bool, ParameterType::boolean, bool> {};
template <>
struct Kind<int> : PlainKind<int, ParameterType::integer, std::int64_t> {};
template <>
struct Kind<std::int64_t> : PlainKind<std::int64_t, ParameterType::integer, std::int64_t> {};
template <>
struct Kind<double> : PlainKind<double, ParameterType::number, double> {};
template <>
struct Kind<std::string> : PlainKind<std::string, ParameterType::text, std::string> {};
template <>
struct Kind<Length> : PlainKind<Length, ParameterType::length, Length> {};
template <>
struct Kind<Angle> {
  static constexpr ParameterType type = ParameterType::angle;
  static Angle from(const Setting& setting) { return {std::get<double>(setting.value)}; }
  static Setting to(const Angle& angle) { return {angle.radians}; }
};
template <>
struct Kind<Duration> {
  static constexpr ParameterType type = ParameterType::duration;
  static Duration from(const Setting& setting) { return {std::get<double>(setting.value)}; }
  static Setting to(const Duration& duration) { return {duration.seconds}; }
};
template <>
struct Kind<Eigen::Vector3d> {
  static constexpr ParameterType type = ParameterType::vector;
  static Eigen::Vector3d from(const Setting& setting) {
    const auto& list = std::get<Setting::List>(setting.value);
    return {std::get<double>(list.at(0).value), std::get<double>(list.at(1).value),
            std::get<double>(list.at(2).value)};
  }
  static Setting to(const Eigen::Vector3d& v) { return {Setting::List{{v.x()}, {v.y()}, {v.z()}}}; }
};
template <>
struct Kind<Place> {
  static constexpr ParameterType type = ParameterType::point;
  static Place from(const Setting& setting) { return {Kind<Eigen::Vector3d>::from(setting)}; }
  static Setting to(const Place& place) { return Kind<Eigen::Vector3d>::to(place.metres); }
};
template <>
struct Kind<LengthUnit> {
  static constexpr ParameterType type = ParameterType::length_unit;
  static LengthUnit from(const Setting& setting) {
    return length_unit(std::get<std::string>(setting.value));
  }
  static Setting to(const LengthUnit&) { return {}; }  // unset: the graph's units
};
template <>
struct Kind<InputFile> {
  static constexpr ParameterType type = ParameterType::input_file;
  static InputFile from(const Setting& setting) { return {std::get<std::string>(setting.value)}; }
  static Setting to(const InputFile& file) {
    return file.path.empty() ? Setting{} : Setting{file.path.string()};
  }
};
template <>
struct Kind<OutputFile> {
  static constexpr ParameterType type = ParameterType::output_file;
  static OutputFile from(const Setting& setting) { return {std::get<std::string>(setting.value)}; }
  static Setting to(const OutputFile& file) {
    return file.path.empty() ? Setting{} : Setting{file.path.string()};
  }
};
template <class M>
struct Kind<std::optional<M>> : Kind<M> {
  static std::optional<M> from(const Setting& setting) {
    if (!setting.is_set()) return std::nullopt;
    return Kind<M>::from(setting);
  }
  static Setting to(const std::optional<M>& member) {
    return member ? Kind<M>::to(*member) : Setting{};
  }
};
template <class M>
struct Kind<std::vector<M>> : Kind<M> {
  static std::vector<M> from(const Setting& setting) {
    std::vector<M> members;
    for (const Setting& entry : std::get<Setting::List>(setting.value))
      members.push_back(Kind<M>::from(entry));
    return members;
  }
  static Setting to(const std::vector<M>& members) {
    Setting::List list;
    for (const M& member : members) list.push_back(Kind<M>::to(member));
    return {std::move(list)};
  }
};

template <class M>
inline constexpr bool is_optional = false;
template <class M>
inline constexpr bool is_optional<std::optional<M>> = true;
template <class M>
inline constexpr bool is_vector = false;
template <class M>
inline constexpr bool is_vector<std::vector<M>> = true;

template <class T, class M>
Parameter make_parameter(M T::*member, std::string name, std::string doc, Range range) {
  Parameter p;
  p.name = std::move(name);
  p.doc = std::move(doc);
  p.type = Kind<M>::type;
  p.list = is_vector<M>;
  p.optional = is_optional<M> || std::is_same_v<M, LengthUnit>;
  p.range = range;
  p.initial = Kind<M>::to(T{}.*member);
  p.set = [member](void* object, const Setting& setting) {
    if constexpr (!is_optional<M>) {
      if (!setting.is_set()) return;
    }
    static_cast<T*>(object)->*member = Kind<M>::from(setting);
  };
  return p;
}

// How an argument of a stage's call appears as an input.
template <class A>
struct Argument {
  static void describe(Port& port) { port.types = {kValueType<A>}; }
};
template <class A>
struct Argument<std::optional<A>> {
  static void describe(Port& port) {
    Argument<A>::describe(port);
    port.required = false;
  }
};
template <class A>
struct Argument<std::vector<A>> {
  static void describe(Port& port) {
    Argument<A>::describe(port);
    port.many = true;
  }
};
template <class... A>
struct Argument<std::variant<A...>> {
  static void describe(Port& port) { port.types = {kValueType<A>...}; }
};

template <class R>
struct Result {
  static std::vector<Port> ports() {
    Port port;
    Argument<R>::describe(port);
    return {port};
  }
};
template <>
struct Result<void> {
  static std::vector<Port> ports() { return {}; }
};
template <class... R>
struct Result<std::tuple<R...>> {
  static std::vector<Port> ports() { return {Result<R>::ports().front()...}; }
};

template <class Call>
struct Signature;
template <class T, class R, class... A>
struct Signature<R (T::*)(A...) const> {
  using Return = R;
  /// Types of the inputs, the Context at the end included.
  using Arguments = std::tuple<std::remove_cvref_t<A>...>;
  static constexpr std::size_t kInputs = sizeof...(A) - 1;
  static_assert(std::is_same_v<std::tuple_element_t<kInputs, std::tuple<A...>>, Context&>,
                "the last argument of a stage's call is velum::Context&");

  static std::vector<Port> inputs() { return inputs(std::make_index_sequence<kInputs>{}); }

 private:
  template <std::size_t... I>
  static std::vector<Port> inputs(std::index_sequence<I...>) {
    std::vector<Port> ports(kInputs);
    (Argument<std::tuple_element_t<I, Arguments>>::describe(ports[I]), ...);
    return ports;
  }
};

}  // namespace detail

/// The fields of one row of a small table, such as a picked pair of points.
template <class R>
class Row {
 public:
  template <class M>
  Row&& field(M R::*member, std::string name, std::string doc, Range range = anything()) && {
    fields.push_back(detail::make_parameter(member, std::move(name), std::move(doc), range));
    return std::move(*this);
  }
  std::vector<Parameter> fields;
};

/// One value of an enumeration parameter.
template <class E>
struct Choice {
  std::string name;
  E value;
  std::string doc;
};

/// Describes the stage T. `in` and `out` name the arguments and results of its call, in order;
/// `required`, `advanced`, `was`, `of` and `unit` speak of the parameter before them. Ranges are in
/// SI units. Inputs come from the call's signature: `const V&` is required, `std::optional<V>`
/// optional, `std::vector<V>` takes many, `std::variant<V, W>` either type. Results: a value,
/// `std::tuple` of values, `std::optional` of what may be missing, or void.
template <class T>
class About {
  using Call = detail::Signature<decltype(&T::operator())>;

 public:
  explicit About(std::string summary) {
    info_.summary = std::move(summary);
    info_.inputs = Call::inputs();
    info_.outputs = detail::Result<typename Call::Return>::ports();
    info_.cacheable = !info_.outputs.empty();
  }

  About& in(std::string name, std::string doc = "") {
    return name_port(info_.inputs, named_inputs_, std::move(name), std::move(doc));
  }
  About& out(std::string name, std::string doc = "") {
    return name_port(info_.outputs, named_outputs_, std::move(name), std::move(doc));
  }
  About& needs(std::string_view input, std::string column) {
    port(info_.inputs, input).columns.push_back({std::move(column), {}, {}});
    return *this;
  }
  About& needs_when(std::string parameter, std::string value, std::string_view input,
                    std::string column) {
    port(info_.inputs, input)
        .columns.push_back({std::move(column), std::move(parameter), std::move(value)});
    return *this;
  }
  About& adds(std::string_view output, std::string column) {
    port(info_.outputs, output).columns.push_back({std::move(column), {}, {}});
    return *this;
  }
  /// Output columns are only those that it adds.
  About& drops_columns() {
    info_.keeps_columns = false;
    return *this;
  }

  template <class M>
  About& param(M T::*member, std::string name, std::string doc, Range range = anything()) {
    info_.parameters.push_back(
        detail::make_parameter(member, std::move(name), std::move(doc), range));
    return *this;
  }
  /// An enumeration: every value with its name and what it means.
  template <class E>
  About& choice(E T::*member, std::string name, std::string doc, std::vector<Choice<E>> choices) {
    Parameter p;
    p.name = std::move(name);
    p.doc = std::move(doc);
    p.type = ParameterType::choice;
    for (const Choice<E>& c : choices) {
      p.choices.push_back({c.name, c.doc});
      if (T{}.*member == c.value) p.initial = {c.name};
    }
    p.set = [member, choices](void* object, const Setting& setting) {
      for (const Choice<E>& c : choices)
        if (c.name == std::get<std::string>(setting.value))
          static_cast<T*>(object)->*member = c.value;
    };
    info_.parameters.push_back(std::move(p));
    return *this;
  }
  /// An array of small tables, such as `pairs = [{ source = [..], target = [..] }]`.
  template <class R>
  About& rows(std::vector<R> T::*member, std::string name, std::string doc, Row<R> row) {
    Parameter p;
    p.name = std::move(name);
    p.doc = std::move(doc);
    p.type = ParameterType::rows;
    p.fields = std::move(row.fields);
    p.initial = {Setting::List{}};
    p.set = [member, fields = p.fields](void* object, const Setting& setting) {
      std::vector<R> made;
      for (const Setting& entry : std::get<Setting::List>(setting.value)) {
        const auto& cells = std::get<Setting::List>(entry.value);
        R& one = made.emplace_back();
        for (std::size_t i = 0; i < fields.size(); ++i) fields[i].set(&one, cells.at(i));
      }
      static_cast<T*>(object)->*member = std::move(made);
    };
    info_.parameters.push_back(std::move(p));
    return *this;
  }
  About& required() {
    return last([](Parameter& p) { p.required = true; });
  }
  About& advanced() {
    return last([](Parameter& p) { p.advanced = true; });
  }
  About& was(std::string name) {
    return last([&](Parameter& p) { p.old_names.push_back(std::move(name)); });
  }
  /// Relative lengths count the spacing and diagonal of this input.
  About& of(std::string input) {
    return last([&](Parameter& p) { p.relative_to = std::move(input); });
  }
  About& unit(std::string unit) {
    return last([&](Parameter& p) { p.unit = std::move(unit); });
  }

  /// Same inputs and parameters, same bytes. The default.
  About& deterministic() { return determinism(Determinism::bitwise); }
  /// Same inputs, parameters and seed, same bytes.
  About& seeded() { return determinism(Determinism::seeded); }
  /// The same up to rounding.
  About& tolerant() { return determinism(Determinism::tolerance); }
  /// No promise; never taken from the cache.
  About& nondeterministic() {
    info_.cacheable = false;
    return determinism(Determinism::none);
  }
  /// Never taken from the cache (devices).
  About& uncached() {
    info_.cacheable = false;
    return *this;
  }
  /// A library in it may crash: runs in a process of its own unless the graph says otherwise.
  About& isolated() {
    info_.isolated = true;
    return *this;
  }
  About& version(std::string version) {
    info_.version = std::move(version);
    return *this;
  }
  /// Where the method comes from: paper, thesis section, equation.
  About& reference(std::string citation) {
    info_.references.push_back(std::move(citation));
    return *this;
  }
  /// Licence of the stage with what it links (SPDX expression).
  About& licence(std::string licence) {
    info_.licence = std::move(licence);
    return *this;
  }

  [[nodiscard]] const StageInfo& info() const { return info_; }

 private:
  About& name_port(std::vector<Port>& ports, std::size_t& named, std::string name,
                   std::string doc) {
    if (named == ports.size()) throw Error(Fault::plugin, "more ports named than the call has");
    ports[named].name = std::move(name);
    ports[named++].doc = std::move(doc);
    return *this;
  }
  static Port& port(std::vector<Port>& ports, std::string_view name) {
    for (Port& p : ports)
      if (p.name == name) return p;
    throw Error(Fault::plugin, "no port '" + std::string(name) + "'");
  }
  template <class Change>
  About& last(const Change& change) {
    if (info_.parameters.empty()) throw Error(Fault::plugin, "no parameter to speak of");
    change(info_.parameters.back());
    return *this;
  }
  About& determinism(Determinism determinism) {
    info_.determinism = determinism;
    return *this;
  }

  StageInfo info_;
  std::size_t named_inputs_ = 0;
  std::size_t named_outputs_ = 0;
};

}  // namespace velum
