// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

/// Marks what libvelum exports; everything else is hidden.
#define VELUM_API __attribute__((visibility("default")))

namespace velum {

/// Version of the SDK: plugins built against another one are refused at load time.
inline constexpr int kSdkMajor = 0;
inline constexpr int kSdkMinor = 1;
/// Version of Velum, as in records and `velum --version`.
inline constexpr const char* kVersion = "0.1.0";

}  // namespace velum
