// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <tuple>
#include <type_traits>
#include <typeindex>
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
  /// Throws Error when settings that are right one by one do not fit together; may be empty.
  std::function<void(const std::vector<Setting>&)> check;
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
// A type of one field that is stored as a number or text.
template <class M, ParameterType Type, auto Field, class Stored>
struct FieldKind {
  static constexpr ParameterType type = Type;
  static M from(const Setting& setting) { return {std::get<Stored>(setting.value)}; }
  static Setting to(const M& member) { return {Stored(member.*Field)}; }
};
template <>
struct Kind<Angle> : FieldKind<Angle, ParameterType::angle, &Angle::radians, double> {};
template <>
struct Kind<Duration> : FieldKind<Duration, ParameterType::duration, &Duration::seconds, double> {};
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
// A file whose path is empty is not set.
template <class File, ParameterType Type>
struct FileKind : FieldKind<File, Type, &File::path, std::string> {
  static Setting to(const File& file) {
    return file.path.empty() ? Setting{} : Setting{file.path.string()};
  }
};
template <>
struct Kind<InputFile> : FileKind<InputFile, ParameterType::input_file> {};
template <>
struct Kind<OutputFile> : FileKind<OutputFile, ParameterType::output_file> {};
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

VELUM_API Parameter named(std::string name, std::string doc, ParameterType type);

template <class T, class M>
Parameter make_parameter(M T::*member, std::string name, std::string doc, Range range) {
  Parameter p = named(std::move(name), std::move(doc), Kind<M>::type);
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

// How an argument or a result of a stage's call appears as a port.
template <class A>
Port port_of() {
  Port port;
  if constexpr (is_optional<A> || is_vector<A>) {
    port = port_of<typename A::value_type>();
    (is_optional<A> ? port.required : port.many) = is_vector<A>;
  } else if constexpr (requires { std::variant_size<A>::value; }) {
    [&]<class... V>(std::type_identity<std::variant<V...>>) {
      port.types = {kValueType<V>...};
    }(std::type_identity<A>{});
  } else {
    port.types = {kValueType<A>};
  }
  return port;
}
// The ports of several values in a std::tuple.
template <class... A>
std::vector<Port> ports_of(std::type_identity<std::tuple<A...>>) {
  return {port_of<A>()...};
}

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

  static std::vector<Port> inputs() {
    return []<std::size_t... I>(std::index_sequence<I...>) {
      return std::vector<Port>{port_of<std::tuple_element_t<I, Arguments>>()...};
    }
    (std::make_index_sequence<kInputs>{});
  }
  static std::vector<Port> outputs() {
    if constexpr (std::is_void_v<R>)
      return {};
    else if constexpr (requires { std::tuple_size<R>::value; })
      return ports_of(std::type_identity<R>{});
    else
      return {port_of<R>()};
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

/// What About<T> says without knowing T. `in` and `out` name the arguments and results of the
/// stage's call, in order; `required`, `advanced`, `was`, `of` and `unit` speak of the parameter
/// before them. Ranges are in SI units. All throw Error (Fault::plugin) on what makes no sense.
class VELUM_API AboutStage {
 public:
  AboutStage& in(std::string name, std::string doc = "");
  AboutStage& out(std::string name, std::string doc = "");
  AboutStage& needs(std::string_view input, std::string column);
  AboutStage& needs_when(std::string parameter, std::string value, std::string_view input,
                         std::string column);
  AboutStage& adds(std::string_view output, std::string column);
  /// Output columns are only those that it adds.
  AboutStage& drops_columns();

  template <class T, class M>
  AboutStage& param(M T::*member, std::string name, std::string doc, Range range = anything()) {
    return add(typeid(T), detail::make_parameter(member, std::move(name), std::move(doc), range));
  }
  /// An enumeration: every value with its name and what it means.
  template <class T, class E>
  AboutStage& choice(E T::*member, std::string name, std::string doc,
                     std::vector<Choice<std::type_identity_t<E>>> choices) {
    Parameter p = detail::named(std::move(name), std::move(doc), ParameterType::choice);
    for (const Choice<E>& c : choices) {
      p.choices.push_back({c.name, c.doc});
      if (T{}.*member == c.value) p.initial = {c.name};
    }
    p.set = [member, choices](void* object, const Setting& setting) {
      for (const Choice<E>& c : choices)
        if (c.name == std::get<std::string>(setting.value))
          static_cast<T*>(object)->*member = c.value;
    };
    return add(typeid(T), std::move(p));
  }
  /// An array of small tables, such as `pairs = [{ source = [..], target = [..] }]`.
  template <class T, class R>
  AboutStage& rows(std::vector<R> T::*member, std::string name, std::string doc, Row<R> row) {
    Parameter p = detail::named(std::move(name), std::move(doc), ParameterType::rows);
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
    return add(typeid(T), std::move(p));
  }
  AboutStage& required();
  AboutStage& advanced();
  AboutStage& was(std::string old_name);
  /// Relative lengths count the spacing and diagonal of this input.
  AboutStage& of(std::string input);
  AboutStage& unit(std::string unit);

  /// Same inputs and parameters, same bytes. The default.
  AboutStage& deterministic();
  /// Same inputs, parameters and seed, same bytes.
  AboutStage& seeded();
  /// The same up to rounding.
  AboutStage& tolerant();
  /// No promise; never taken from the cache.
  AboutStage& nondeterministic();
  /// Never taken from the cache (devices).
  AboutStage& uncached();
  /// A library in it may crash: runs in a process of its own unless the graph says otherwise.
  AboutStage& isolated();
  AboutStage& version(std::string version);
  /// Where the method comes from: paper, thesis section, equation.
  AboutStage& reference(std::string citation);
  /// Licence of the stage with what it links (SPDX expression).
  AboutStage& licence(std::string licence);

  [[nodiscard]] const StageInfo& info() const { return info_; }

 protected:
  AboutStage(const std::type_info& stage, std::string summary, std::vector<Port> inputs,
             std::vector<Port> outputs);

 private:
  AboutStage& add(const std::type_info& owner, Parameter parameter);
  Parameter& last();

  std::type_index stage_;
  StageInfo info_;
  std::size_t named_inputs_ = 0;
  std::size_t named_outputs_ = 0;
};

/// Describes the stage T. Inputs come from the call's signature: `const V&` is required,
/// `std::optional<V>` optional, `std::vector<V>` takes many, `std::variant<V, W>` either type.
/// Results: a value, `std::tuple` of values, `std::optional` of what may be missing, or void.
template <class T>
class About : public AboutStage {
  using Call = detail::Signature<decltype(&T::operator())>;

 public:
  explicit About(std::string summary)
      : AboutStage(typeid(T), std::move(summary), Call::inputs(), Call::outputs()) {}
};

}  // namespace velum
