// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "scene/scene.hpp"

#include "velum/error.hpp"

namespace velum::scene {
namespace {

template <class T>
const T& named(const std::vector<T>& all, std::string_view name, const std::string& kind,
               const std::string& path) {
  std::string known;
  for (const T& one : all) {
    if (one.name == name) return one;
    known += (known.empty() ? "" : ", ") + one.name;
  }
  throw Error(Fault::graph, "the scene has no " + kind + " '" + std::string(name) + "'")
      .at(path)
      .hint(known.empty() ? "it has none" : "known: " + known);
}

}  // namespace

const Sail* Object::sail() const {
  return shapes.size() == 1 ? std::get_if<Sail>(&shapes.front()) : nullptr;
}

const Object& Scene::object(std::string_view name) const {
  return named(objects, name, "object", path);
}

const Scanner& Scene::scanner(std::string_view name) const {
  return named(scanners, name, "scanner", path);
}

}  // namespace velum::scene
