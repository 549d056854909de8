// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <velum/stage.hpp>

struct Nothing {
  static auto about() { return velum::About<Nothing>("Nothing.").out("table"); }
  velum::Table operator()(velum::Context&) const { return {}; }
};
