// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "report/views_file.hpp"

#include <array>
#include <cstring>

#include "files/hasher.hpp"
#include "report/views.hpp"
#include "velum/files.hpp"

namespace velum::report {
namespace {

/// First 40 bytes of the file; then `json` bytes of JSON, blanks included, and `block` bytes of
/// arrays.
struct Header {
  std::array<char, 8> magic = {'V', 'E', 'L', 'U', 'M', 'V', 'W', '1'};
  std::uint64_t json = 0;
  std::uint64_t block = 0;
  std::uint64_t low = 0;  ///< XXH3-128 of all that follows
  std::uint64_t high = 0;
};
static_assert(sizeof(Header) == 40);

constexpr std::uint64_t kLimit = std::uint64_t{1} << 30U;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw Error(Fault::input, what)
      .at(file.string())
      .hint(
          "remove the file; `velum report` makes "
          "the report from the record then");
}

}  // namespace

void write_views(const std::filesystem::path& file, const ViewsFile& content) {
  const Packed packed = pack(content.views);
  const std::string json = run::dump(run::Json{{"record", content.record},
                                               {"values", packed.values},
                                               {"histograms", packed.histograms}}) +
                           "\n";
  files::Hasher hasher;
  hasher.add(std::as_bytes(std::span(json)));
  hasher.add(std::span<const std::byte>(packed.block));
  const XXH128_hash_t digest = hasher.digest();
  Header header;
  header.json = json.size();
  header.block = packed.block.size();
  header.low = digest.low64;
  header.high = digest.high64;
  AtomicFile out(file);
  out.write(std::as_bytes(std::span(&header, 1)));
  out.write(json);
  out.write(std::span<const std::byte>(packed.block));
  out.commit();
}

ViewsFile read_views(const std::filesystem::path& file) {
  const FileContent content(file, kLimit);
  const auto bytes = content.bytes();
  Header header;
  const auto magic = header.magic;
  if (bytes.size() < sizeof(header)) refuse(file, "too short for a file of views");
  std::memcpy(&header, bytes.data(), sizeof(header));
  if (header.magic != magic) refuse(file, "no file of views, or of another version of Velum");
  const auto rest = bytes.subspan(sizeof(header));
  if (header.json > rest.size() || header.block != rest.size() - header.json)
    refuse(file, "cut short");
  files::Hasher hasher;
  hasher.add(rest);
  const XXH128_hash_t digest = hasher.digest();
  if (digest.low64 != header.low || digest.high64 != header.high) refuse(file, "damaged");
  try {
    const auto json = run::Json::parse(
        content.text().substr(sizeof(header), static_cast<std::size_t>(header.json)));
    return {json.at("record").get<std::string>(),
            unpack(json.at("values"), json.at("histograms"),
                   rest.subspan(static_cast<std::size_t>(header.json)))};
  } catch (const run::Json::exception&) {
    refuse(file, "damaged");
  }
}

}  // namespace velum::report
