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

namespace {

template <class Ask>
void require_name(const std::filesystem::path& scene, const char* parameter, const Ask& ask) {
  std::optional<Scene> read;
  try {
    read = read_scene(scene);
  } catch (const Error&) {
    return;
  }
  try {
    ask(*read);
  } catch (Error& error) {
    throw std::move(error).at(parameter);
  }
}

}  // namespace

void require_scanner(const std::filesystem::path& scene, std::string_view name,
                     const char* parameter) {
  require_name(scene, parameter, [&](const Scene& read) { static_cast<void>(read.scanner(name)); });
}

void require_object(const std::filesystem::path& scene, std::string_view name,
                    const char* parameter) {
  require_name(scene, parameter, [&](const Scene& read) { static_cast<void>(read.object(name)); });
}

const Object& Scene::object(std::string_view name) const {
  return named(objects, name, "object", path);
}

const Scanner& Scene::scanner(std::string_view name) const {
  return named(scanners, name, "scanner", path);
}

}  // namespace velum::scene
