// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// The SICK LMS 511's protocol: framing, values, telegrams. Facts and field order: SICK's telegram
/// listing 8014631 and captures of real devices; docs/lms511.md says which.
namespace velum::lms511 {

/// How telegrams are written.
enum class Dialect : std::uint8_t {
  ascii,   ///< CoLa A: 02 text 03, numbers in hexadecimal between blanks, no checksum
  binary,  ///< CoLa B: four 02, length, payload, exclusive or of the payload
};
[[nodiscard]] std::string_view name_of(Dialect dialect);

/// What stands between a frame's marks: "sRA SCdevicestate ..." with its parameters.
struct Telegram {
  Dialect dialect = Dialect::binary;
  std::string_view payload;
};

/// The longest telegram that is taken [bytes]: five echoes of 4561 beams with remission come to
/// 190 kB in CoLa A.
inline constexpr std::size_t kLongestTelegram = std::size_t{256} << 10U;

/// The payload with its marks, as it goes over the wire.
[[nodiscard]] std::string framed(Dialect dialect, std::string_view payload);

/// Cuts a stream of bytes into telegrams, however the bytes arrive. What is no telegram is skipped:
/// after a wrong length or checksum the search goes on one byte behind the false start, so that no
/// whole telegram behind it is lost. Keeps at most kLongestTelegram and a head between calls.
class Framer {
 public:
  struct Counts {
    std::uint64_t telegrams = 0;
    std::uint64_t skipped_bytes = 0;  ///< bytes that belong to no telegram
    std::uint64_t bad_checksums = 0;  ///< CoLa B
    std::uint64_t bad_lengths = 0;    ///< longer than any telegram, or not the start of one
  };

  /// Without a dialect each telegram may have its own, as in a dump of unknown origin.
  explicit Framer(std::optional<Dialect> dialect = std::nullopt) : dialect_(dialect) {}

  /// Takes bytes as they arrived. Ends the life of what next() gave.
  void feed(std::string_view bytes);
  /// The next whole telegram, or nothing until more is fed. Valid until the next feed().
  [[nodiscard]] std::optional<Telegram> next();

  [[nodiscard]] const Counts& counts() const { return counts_; }
  /// Bytes that wait for the rest of their telegram.
  [[nodiscard]] std::size_t pending() const { return buffer_.size() - begin_; }

 private:
  enum class Found : std::uint8_t { whole, part, nothing };
  struct Cut {
    Found found = Found::nothing;
    std::size_t size = 0;  ///< of the frame, when it is whole
    Telegram telegram{};
  };
  [[nodiscard]] Cut cut(std::string_view rest);
  [[nodiscard]] Cut cut_ascii(std::string_view rest);
  [[nodiscard]] Cut cut_binary(std::string_view rest);
  bool to_mark();

  std::optional<Dialect> dialect_;
  std::string buffer_;
  std::size_t begin_ = 0;
  std::size_t scanned_ = 0;  ///< of the CoLa A frame at begin_: bytes known to be text
  Counts counts_;
};

}  // namespace velum::lms511
