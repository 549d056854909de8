// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <png.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "picture/image.hpp"
#include "velum/files.hpp"

namespace velum::picture {
namespace {

std::vector<std::uint8_t> bytes_of(const Image& image) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(3 * static_cast<std::size_t>(image.width()) *
                static_cast<std::size_t>(image.height()));
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      for (const float channel : image.at(x, y))
        bytes.push_back(
            static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(channel, 0.0F, 1.0F))));
  return bytes;
}

}  // namespace

void write_png(const Image& image, const std::filesystem::path& file) {
  const std::vector<std::uint8_t> pixels = bytes_of(image);
  png_image header = {};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width());
  header.height = static_cast<png_uint_32>(image.height());
  header.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::vector<std::byte> encoded(size);
  if (png_image_write_to_memory(&header, encoded.data(), &size, 0, pixels.data(), 0, nullptr) == 0)
    throw Error(Fault::output, std::string("the picture cannot be encoded: ") + header.message)
        .at(file.string());
  AtomicFile out(file);
  out.write(std::span<const std::byte>(encoded).first(size));
  out.commit();
}

}  // namespace velum::picture
