// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "cad/exchange.hpp"

class TopoDS_Face;
class TopoDS_Shape;

namespace velum::cad {

/// Calls OpenCASCADE: one call at a time in a process, since its settings are global, without its
/// messages on the console. What it throws becomes an Error that begins with `what`.
void guarded(Fault fault, const std::string& what, const std::function<void()>& call);

/// Both of these belong into guarded(). Writing says in the file that lengths are millimetres;
/// `name` is the part's. Nothing is known of success until the file is read.
void write_face(const TopoDS_Face& face, Exchange format, const std::filesystem::path& path,
                const std::string& name);
/// Throws Error (Fault::output) when the file is not whole or the library cannot make sense of it.
void read_shape(const std::filesystem::path& path, Exchange format, TopoDS_Shape& shape);

}  // namespace velum::cad
