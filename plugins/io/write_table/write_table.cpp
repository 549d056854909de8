// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <velum/stage.hpp>

#include "formats/table_io.hpp"

namespace {

using velum::Context;
using velum::Table;
using velum::formats::TableFormat;

struct WriteTable {
  velum::OutputFile file;
  TableFormat format = TableFormat::automatic;

  static auto about() {
    velum::About<WriteTable> about("Writes a table as CSV or JSON");
    about.in("table", "what to write")
        .param(&WriteTable::file, "file", "the file to write")
        .required()
        .choice(&WriteTable::format, "format", "how to write it",
                {{"auto", TableFormat::automatic, "JSON for .json, CSV otherwise"},
                 {"csv", TableFormat::csv, "commas; units in the header, as in chord [m]"},
                 {"json", TableFormat::json, "an object with columns and rows"}});
    return about;
  }

  void operator()(const Table& table, Context& context) const {
    context.check();
    velum::formats::write_table(file.path, table, format);
    context.measure("rows", static_cast<double>(table.size()), "");
  }
};

}  // namespace

VELUM_STAGE(WriteTable)
