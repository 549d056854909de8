// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace velum::run {

/// Keys in the order in which they are put in, so that records read from general to particular.
using Json = nlohmann::ordered_json;

/// Text for a file or line; bytes that are no UTF-8 are replaced, never an exception.
inline std::string dump(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

}  // namespace velum::run
