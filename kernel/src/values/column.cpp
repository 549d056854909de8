// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "velum/column.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <new>

namespace velum {
namespace {

constexpr std::align_val_t kAlignment{64};

/// Memory that is neither zeroed nor constructed; the caller fills it.
std::shared_ptr<std::byte> allocate(std::size_t size) {
  auto* memory = static_cast<std::byte*>(::operator new(size, kAlignment));
  return {memory, [](std::byte* p) { ::operator delete(p, kAlignment); }};
}

std::size_t size_in_bytes(Scalar scalar, Index width, Index count) {
  return static_cast<std::size_t>(width * count) * size_of(scalar);
}

/// Copies elements of `Size` bytes (0: `size`, known at run time only).
template <std::size_t Size>
void gather(std::span<const std::int32_t> indices, const std::byte* from, std::byte* to,
            [[maybe_unused]] std::size_t size) {
  const std::size_t step = Size == 0 ? size : Size;
  for (const std::int32_t index : indices) {
    std::memcpy(to, from + static_cast<std::size_t>(index) * step, step);
    to += step;
  }
}

std::string type_name(Scalar scalar, Index width) {
  return width == 1 ? std::string(name_of(scalar)) : fmt::format("{}x{}", name_of(scalar), width);
}

}  // namespace

void Column::require(Scalar scalar) const {
  if (scalar == scalar_) return;
  throw Error(Fault::stage,
              fmt::format("a column of type {} was used as {}", name_of(scalar_), name_of(scalar)));
}

Column Column::select(std::span<const std::int32_t> indices) const {
  for (const std::int32_t index : indices) {
    if (index >= 0 && index < count_) continue;
    throw Error(Fault::stage, fmt::format("index {} into a column of {} elements", index, count_));
  }
  const std::size_t element = size_in_bytes(scalar_, width_, 1);
  auto memory = allocate(element * indices.size());
  const auto* from = static_cast<const std::byte*>(data_);
  switch (element) {
    case 1:
      gather<1>(indices, from, memory.get(), element);
      break;
    case 4:
      gather<4>(indices, from, memory.get(), element);
      break;
    case 8:
      gather<8>(indices, from, memory.get(), element);
      break;
    case 12:
      gather<12>(indices, from, memory.get(), element);
      break;
    default:
      gather<0>(indices, from, memory.get(), element);
  }
  const void* data = memory.get();
  return {scalar_, width_, static_cast<Index>(indices.size()), data, std::move(memory)};
}

Column Column::concatenate(std::span<const Column> parts) {
  if (parts.empty()) throw Error(Fault::stage, "no columns to join");
  const Column& first = parts.front();
  Index count = 0;
  for (const Column& part : parts) {
    if (part.scalar_ != first.scalar_ || part.width_ != first.width_)
      throw Error(Fault::stage, fmt::format("columns of type {} and {} cannot be joined",
                                            type_name(first.scalar_, first.width_),
                                            type_name(part.scalar_, part.width_)));
    count += part.count_;
  }
  auto memory = allocate(size_in_bytes(first.scalar_, first.width_, count));
  std::byte* to = memory.get();
  for (const Column& part : parts) {
    const auto bytes = part.bytes();
    to = std::copy(bytes.begin(), bytes.end(), to);
  }
  const void* data = memory.get();
  return {first.scalar_, first.width_, count, data, std::move(memory)};
}

Column Column::concatenate(const Column& a, const Column& b) {
  const Column parts[] = {a, b};
  return concatenate(parts);
}

Column Column::zeros(Scalar scalar, Index width, Index count) {
  const std::size_t size = size_in_bytes(scalar, width, count);
  auto memory = allocate(size);
  std::memset(memory.get(), 0, size);
  const void* data = memory.get();
  return {scalar, width, count, data, std::move(memory)};
}

}  // namespace velum
