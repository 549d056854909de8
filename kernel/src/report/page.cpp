// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "report/page.hpp"

#include <cstdint>
#include <cstdlib>

#include "plugins/search.hpp"
#include "velum/files.hpp"

namespace velum::report {
namespace {

namespace fs = std::filesystem;

constexpr const char* kVariable = "VELUM_REPORT_TEMPLATE";
constexpr const char* kHint =
    "build Velum with `make build`, which needs npm, or install it whole; then `velum report`";
constexpr std::uint64_t kLimit = std::uint64_t{1} << 28U;

std::string read(const fs::path& file) {
  try {
    return std::string(FileContent(file, kLimit).text());
  } catch (const Error& error) {
    throw Error(Fault::output, std::string("the page for reports: ") + error.what())
        .at(file.string())
        .hint(kHint);
  }
}

std::string installed_page() {
  const char* named = std::getenv(kVariable);  // NOLINT(concurrency-mt-unsafe)
  if (named != nullptr && *named != '\0') return read(named);
  const fs::path file = shared_file("report.html");
  if (file.empty())
    throw Error(Fault::output, "the page for reports, share/velum/report.html, is not there")
        .hint(kHint);
  return read(file);
}

}  // namespace

fs::path shared_file(std::string_view name) {
  // build/release/lib, <prefix>/lib or <prefix>/lib/x86_64-linux-gnu
  const fs::path library = plugins::library_folder();
  for (const fs::path& above : {library.parent_path(), library.parent_path().parent_path()}) {
    fs::path file = above / "share" / "velum" / name;
    std::error_code failed;
    if (fs::is_regular_file(file, failed)) return file;
  }
  return {};
}

Page::Page() : Page(installed_page(), "report.html") {}

Page::Page(std::string text, const std::string& name)
    : text_(std::move(text)), mark_(text_.find(kMark)) {
  if (mark_ == std::string::npos || text_.find(kMark, mark_ + 1) != std::string::npos)
    throw Error(Fault::output, "the page for reports has not one line " + std::string(kMark))
        .at(name)
        .hint(kHint);
}

void Page::write(const fs::path& file, const run::Json& json,
                 std::span<const std::byte> block) const {
  AtomicFile out(file);
  const std::string_view text = text_;
  out.write(text.substr(0, mark_));
  out.write("<script id=\"velum-report\" type=\"application/json\">");
  out.write(script_json(json));
  out.write("</script>\n<script id=\"velum-data\" type=\"text/plain\">");
  out.write(base64(block));
  out.write("</script>");
  out.write(text.substr(mark_ + kMark.size()));
  out.commit();
}

std::string script_json(const run::Json& json) {
  const std::string text = run::dump(json);
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text)
    if (c == '<')  // only ever within a string
      safe += "\\u003c";
    else
      safe += c;
  return safe;
}

std::string base64(std::span<const std::byte> bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group =
          group << 8U | (i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0);
    const std::size_t digits = std::min<std::size_t>(bytes.size() - i, 3) + 1;
    for (std::size_t k = 0; k < 4; ++k)
      text += k < digits ? kDigits[group >> (6 * (3 - k)) & 63U] : '=';
  }
  return text;
}

}  // namespace velum::report
