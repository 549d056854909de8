// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "commands.hpp"
#include "console.hpp"
#include "graph/diagnostic.hpp"
#include "plugins/listing.hpp"

namespace velum::app {
namespace {

struct Options {
  std::string kind;
  bool quarantined = false;
};

[[noreturn]] void refuse_kind(const std::string& kind) {
  std::vector<std::string> known;
  for (const auto& [id, files] : plugins::find_plugins(plugins::search_path())) {
    const std::string one = id.substr(0, id.find('.'));
    if (known.empty() || known.back() != one) known.push_back(one);
  }
  const std::string guess = graph::did_you_mean(kind, known);
  throw Error(Fault::graph, fmt::format("there are no stages of the kind '{}'", kind))
      .hint(guess.empty() ? graph::known_list(known) : guess);
}

void show_stages(const std::vector<plugins::Listed>& all) {
  std::size_t width = 0;
  std::size_t refused = 0;
  for (const auto& listed : all) width = std::max(width, listed.id.size());
  for (const auto& listed : all) {
    refused += listed.refused.empty() ? 0 : 1;
    print(fmt::format("{:<{}}  {}\n", listed.id, width,
                      listed.refused.empty() ? listed.summary : "(cannot be loaded)"));
    for (std::size_t i = 1; i < listed.files.size(); ++i)
      print(fmt::format("{:<{}}  ({} hides {})\n", "", width, listed.files.front().string(),
                        listed.files[i].string()));
  }
  if (refused > 0)
    complain(fmt::format("{} of {} cannot be loaded: `velum list --quarantined` says why\n",
                         refused, all.size()));
}

void show_refused(const std::vector<plugins::Listed>& all) {
  bool none = true;
  for (const auto& listed : all) {
    if (listed.refused.empty()) continue;
    none = false;
    print(fmt::format("{}\n  {}\n", listed.id, listed.refused));
  }
  if (none) print("no plugin is refused\n");
}

void list(const Options& options) {
  const auto all = plugins::list_plugins(plugins::search_path(), options.kind, options.quarantined);
  if (all.empty() && !options.kind.empty()) refuse_kind(options.kind);
  if (options.quarantined)
    show_refused(all);
  else
    show_stages(all);
}

}  // namespace

void add_list(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("list", "The stages there are, one line each");
  command->add_option("KIND", options->kind, "only those of this kind, such as filtering");
  command->add_flag("--quarantined", options->quarantined,
                    "the plugins that are refused, with the reason; they are tried again");
  command->callback([options] { list(*options); });
}

}  // namespace velum::app
