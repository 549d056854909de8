// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include "velum/abi.hpp"

/// All that a plugin needs: define a struct with `about()` and a call operator, then VELUM_STAGE.
/// A `void check() const` is called before any graph runs: it throws Error (Fault::graph) when
/// parameters do not fit together, `.at()` the parameter's name. Lengths may still be relative.

namespace velum {

/// The values wired to one input: one, none (optional) or several (many).
using Wired = std::vector<Value>;
/// The results of a stage, in the order of its outputs; empty where nothing was made.
using Results = std::vector<std::optional<Value>>;

/// A stage as the kernel sees it.
class VELUM_API StageType {
 public:
  StageType() = default;
  StageType(const StageType&) = delete;
  StageType& operator=(const StageType&) = delete;
  virtual ~StageType();
  [[nodiscard]] virtual const StageInfo& info() const = 0;
  /// Runs a fresh instance: `settings` in the order of info().parameters, `inputs` in that of
  /// info().inputs. The kernel has checked both.
  [[nodiscard]] virtual Results run(const std::vector<Setting>& settings,
                                    const std::vector<Wired>& inputs, Context& context) const = 0;
};

namespace detail {

// What is wired to an input as the argument of a stage's call.
template <class A>
decltype(auto) unwrap(const Wired& wired) {
  if constexpr (is_optional<A>) {
    return wired.empty() ? A() : A(unwrap<typename A::value_type>(wired));
  } else if constexpr (is_vector<A>) {
    A values;
    for (const Value& value : wired) values.push_back(unwrap<typename A::value_type>(Wired{value}));
    return values;
  } else if constexpr (requires { std::variant_size<A>::value; }) {
    return std::visit(
        [](const auto& value) -> A {
          if constexpr (std::is_constructible_v<A, decltype(value)>)
            return value;
          else
            throw Error(Fault::graph, "a value of a type that the input does not take");
        },
        wired.front());
  } else {
    return std::get<A>(wired.front());  // a reference
  }
}

template <class V>
std::optional<Value> wrap(V&& value) {
  if constexpr (is_optional<V>)
    return value ? std::optional<Value>(*std::move(value)) : std::nullopt;  // NOLINT: an rvalue
  else
    return Value(std::move(value));  // NOLINT: an rvalue
}

template <class T>
class StageAdapter final : public StageType {
  using Call = Signature<decltype(&T::operator())>;

 public:
  explicit StageAdapter(const char* id) : info_(T::about().info()) {
    info_.id = id;
    if constexpr (requires(const T& stage) { stage.check(); })
      info_.check = [this](const std::vector<Setting>& settings) { made(settings).check(); };
  }
  [[nodiscard]] const StageInfo& info() const override { return info_; }
  [[nodiscard]] Results run(const std::vector<Setting>& settings, const std::vector<Wired>& inputs,
                            Context& context) const override {
    return call(made(settings), inputs, context, std::make_index_sequence<Call::kInputs>{});
  }

 private:
  [[nodiscard]] T made(const std::vector<Setting>& settings) const {
    T stage{};
    for (std::size_t i = 0; i < settings.size(); ++i)
      info_.parameters.at(i).set(&stage, settings[i]);
    return stage;
  }
  template <std::size_t... I>
  static Results call(const T& stage, [[maybe_unused]] const std::vector<Wired>& inputs,
                      Context& context, std::index_sequence<I...>) {
    const auto invoke = [&]() -> decltype(auto) {
      return stage(unwrap<std::tuple_element_t<I, typename Call::Arguments>>(inputs.at(I))...,
                   context);
    };
    Results results;
    using Return = typename Call::Return;
    if constexpr (std::is_void_v<Return>) {
      invoke();
    } else if constexpr (requires { std::tuple_size<Return>::value; }) {
      std::apply([&](auto&&... value) { (results.push_back(wrap(std::move(value))), ...); },
                 invoke());
    } else {
      results.push_back(wrap(invoke()));
    }
    return results;
  }
  StageInfo info_;
};

constexpr PluginEntry make_entry(const char* id) {
  PluginEntry entry;
  for (std::size_t i = 0; id[i] != '\0' && i + 1 < sizeof(entry.id); ++i) entry.id[i] = id[i];
  return entry;
}

}  // namespace detail
}  // namespace velum

/// Makes the translation unit a plugin that holds the stage `Type`. The build defines
/// VELUM_STAGE_ID, which comes from the plugin's place: resampling/voxel_grid →
/// resampling.voxel_grid.
#define VELUM_STAGE(Type)                                                          \
  extern "C" {                                                                     \
  [[gnu::visibility("default")]] extern const velum::PluginEntry velum_entry;      \
  [[gnu::section(".velum"), gnu::used]] constexpr velum::PluginEntry velum_entry = \
      velum::detail::make_entry(VELUM_STAGE_ID);                                   \
  [[gnu::visibility("default")]] const velum::StageType* velum_stage() {           \
    static const velum::detail::StageAdapter<Type> stage(VELUM_STAGE_ID);          \
    return &stage;                                                                 \
  }                                                                                \
  }
