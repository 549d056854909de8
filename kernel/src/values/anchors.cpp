// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Destructors that anchor the vtables and type information of the SDK's classes in libvelum, so
// that exceptions and stages are recognised across shared objects.
#include "velum/context.hpp"
#include "velum/error.hpp"
#include "velum/stage.hpp"

namespace velum {

Error::~Error() = default;

Cancelled::~Cancelled() = default;
const char* Cancelled::what() const noexcept {
  return "interrupted";
}

Context::~Context() = default;

StageType::~StageType() = default;

}  // namespace velum
