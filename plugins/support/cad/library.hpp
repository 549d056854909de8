// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "cad/exchange.hpp"

class TopoDS_Shape;

namespace velum::cad {

/// Calls OpenCASCADE: one call at a time in a process, since its settings are global, without its
/// messages on the console. What it throws becomes an Error that begins with `what`.
void guarded(Fault fault, const std::string& what, const std::function<void()>& call);

/// All of these belong into guarded(). Writing says in the file that lengths are millimetres;
/// `name` is the part's. Nothing is known of success until the file is read.
void write_shape(const TopoDS_Shape& shape, Exchange format, const std::filesystem::path& path,
                 const std::string& name);
/// What the library makes of all that is in a file, in millimetres; throws Error with this fault
/// when it cannot make sense of it.
void transfer(const std::filesystem::path& path, Exchange format, Fault fault, TopoDS_Shape& shape);
/// Throws Error (Fault::output) when the file is not whole or the library cannot make sense of it.
void read_shape(const std::filesystem::path& path, Exchange format, TopoDS_Shape& shape);

}  // namespace velum::cad
