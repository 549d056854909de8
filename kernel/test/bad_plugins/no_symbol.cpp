// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// The entry of a plugin, but no stage.
#include <velum/stage.hpp>

extern "C" {
[[gnu::visibility("default")]] extern const velum::PluginEntry velum_entry;
[[gnu::section(".velum"), gnu::used]] constexpr velum::PluginEntry velum_entry =
    velum::detail::make_entry(VELUM_STAGE_ID);
}
