// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "velum/table.hpp"

namespace velum::formats {

enum class TableFormat { automatic, csv, json };

/// The table as CSV (units in brackets in the header, cells quoted where needed) or JSON.
void write_table(const std::filesystem::path& path, const Table& table, TableFormat format);

std::string table_as_csv(const Table& table);
std::string table_as_json(const Table& table);

}  // namespace velum::formats
