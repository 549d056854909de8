#!/bin/sh
# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
# Formats the sources; with --check only says which are not.
set -eu
cd "$(dirname "$0")/.."
if [ "${1:-}" = --check ]; then
  git ls-files -z '*.cpp' '*.hpp' | xargs -0 clang-format-14 --dry-run -Werror
else
  git ls-files -z '*.cpp' '*.hpp' | xargs -0 clang-format-14 -i
fi
