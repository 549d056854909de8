// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstring>
#include <memory>

#include "velum/abi.hpp"
#include "velum/about.hpp"

/// All that a plugin needs: define a struct with `about()` and a call operator, then VELUM_STAGE.

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

template <class A>
struct Unwrap {
  static const A& from(const Wired& wired) { return std::get<A>(wired.front()); }
};
template <class A>
struct Unwrap<std::optional<A>> {
  static std::optional<A> from(const Wired& wired) {
    if (wired.empty()) return std::nullopt;
    return Unwrap<A>::from(wired);
  }
};
template <class A>
struct Unwrap<std::vector<A>> {
  static std::vector<A> from(const Wired& wired) {
    std::vector<A> values;
    for (const Value& value : wired) values.push_back(Unwrap<A>::from({value}));
    return values;
  }
};
template <class... A>
struct Unwrap<std::variant<A...>> {
  static std::variant<A...> from(const Wired& wired) {
    return std::visit(
        [](const auto& value) -> std::variant<A...> {
          using V = std::remove_cvref_t<decltype(value)>;
          if constexpr ((std::is_same_v<V, A> || ...))
            return value;
          else
            throw Error(Fault::graph, "a value of a type that the input does not take");
        },
        wired.front());
  }
};

template <class V>
std::optional<Value> wrap(V&& value) {
  return Value(std::forward<V>(value));
}
template <class V>
std::optional<Value> wrap(std::optional<V>&& value) {
  if (!value) return std::nullopt;
  return Value(std::move(*value));
}

template <class T>
class StageAdapter final : public StageType {
  using Call = Signature<decltype(&T::operator())>;

 public:
  explicit StageAdapter(const char* id) : info_(T::about().info()) { info_.id = id; }
  [[nodiscard]] const StageInfo& info() const override { return info_; }
  [[nodiscard]] Results run(const std::vector<Setting>& settings, const std::vector<Wired>& inputs,
                            Context& context) const override {
    T stage{};
    for (std::size_t i = 0; i < settings.size(); ++i)
      info_.parameters.at(i).set(&stage, settings[i]);
    return call(stage, inputs, context, std::make_index_sequence<Call::kInputs>{});
  }

 private:
  template <std::size_t... I>
  static Results call(const T& stage, [[maybe_unused]] const std::vector<Wired>& inputs,
                      Context& context, std::index_sequence<I...>) {
    const auto invoke = [&]() -> decltype(auto) {
      return stage(Unwrap<std::tuple_element_t<I, typename Call::Arguments>>::from(inputs.at(I))...,
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
