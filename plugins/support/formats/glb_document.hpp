// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "formats/records.hpp"
#include "formats/source.hpp"

namespace velum::formats {

/// Elements of an accessor: `count` of `width` values of `type`, all of them within the file.
struct GlbArray {
  Index count = 0;
  Index width = 1;
  FieldType type = FieldType::f32;
  bool normalised = false;
  const std::byte* data = nullptr;
  std::size_t stride = 0;  ///< from one element to the next

  [[nodiscard]] const std::byte* at(Index element) const {
    return data + static_cast<std::size_t>(element) * stride;
  }
};

/// The parts of a GLB file. Everything that is asked for is checked against the file; what is wrong
/// is thrown as Error (Fault::input) with its place in the JSON ("a.glb: accessors[3]").
class GlbDocument {
 public:
  using json = nlohmann::json;

  explicit GlbDocument(const Source& source);

  /// Entry `index` of a list of the document, which must be an object.
  [[nodiscard]] const json& entry(const std::string& list, std::size_t index) const;
  [[nodiscard]] const json& root() const { return root_; }
  [[nodiscard]] GlbArray accessor(std::size_t index) const;

  /// A whole number that is not negative; nothing where there is no such key.
  [[nodiscard]] std::optional<std::size_t> whole(const json& object, const char* key,
                                                 const std::string& place) const;
  /// The same; throws when the key is not there.
  [[nodiscard]] std::size_t required(const json& object, const char* key,
                                     const std::string& place) const;
  [[nodiscard]] std::string text(const json& object, const char* key) const;
  [[nodiscard]] Error bad(const std::string& place, const std::string& message) const;

 private:
  void read_chunks();
  void parse(std::size_t begin, std::size_t length);
  void require_known_extensions() const;
  /// The bytes of a bufferView.
  [[nodiscard]] std::span<const std::byte> view(std::size_t index) const;

  const Source& source_;
  json root_;
  std::span<const std::byte> binary_;
};

/// "accessors[3]".
std::string place_of(const char* list, std::size_t index);

}  // namespace velum::formats
