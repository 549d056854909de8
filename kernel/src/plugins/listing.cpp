// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "plugins/listing.hpp"

#include <tbb/parallel_for_each.h>

#include "plugins/entry.hpp"
#include "plugins/probe.hpp"
#include "plugins/registry.hpp"
#include "velum/error.hpp"

namespace velum::plugins {
namespace {

void look_at(Listed& listed, bool again) {
  const std::filesystem::path& file = listed.files.front();
  try {
    check_entry(file, listed.id);
    Probed probed = probe(file);
    if (again && !probed.quarantined.empty()) {
      forget_probe(file);
      probed = probe(file);
    }
    listed.summary = probed.summary;
    listed.refused = probed.refused;
    if (!probed.quarantined.empty())
      listed.refused = file.string() + ": in quarantine: it " + probed.quarantined;
  } catch (const Error& error) {
    listed.refused = one_line(error);
  }
}

}  // namespace

std::vector<Listed> list_plugins(const std::vector<std::filesystem::path>& path,
                                 const std::string& kind, bool again) {
  std::vector<Listed> all;
  for (auto& [id, files] : find_plugins(path))
    if (kind.empty() || id.rfind(kind + ".", 0) == 0) all.push_back({id, files, "", ""});
  // A first probe of everything takes a child process for each plugin.
  tbb::parallel_for_each(all, [again](Listed& listed) { look_at(listed, again); });
  return all;
}

}  // namespace velum::plugins
