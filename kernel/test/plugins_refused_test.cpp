// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Plugins that will not load: each must end in an error that says what is wrong, the host alive.
#include <random>

#include "plugins_support.hpp"

namespace fs = std::filesystem;
using namespace velum;
using Catch::Matchers::Contains;
using plugins::Registry;
using test::content_of;
using test::entry_of;
using test::kPlugins;
using test::PluginFolder;
using test::refusal;
using test::with_entry;

TEST_CASE("an unknown stage is a mistake of the graph, with the nearest name") {
  const PluginFolder folder;
  const Error error = refusal("bad.sond");
  CHECK(error.fault() == Fault::graph);
  CHECK_THAT(error.what(), Contains("there is no stage 'bad.sond'"));
  CHECK_THAT(error.hint(), Contains("bad.sound"));
  CHECK(refusal("../bad/sound").fault() == Fault::graph);
  CHECK(refusal("").fault() == Fault::graph);
  Registry registry(Registry::Trust::probe, {kPlugins});
  CHECK(registry.why_not("bad.sond").empty());
}

TEST_CASE("files that are no plugins are refused unopened") {
  const PluginFolder folder;
  folder.put("garbage", std::string(5000, '\x7f'));
  folder.put("text", "#!/bin/sh\nexit 1\n");
  folder.put("none", "");
  fs::create_directory(folder.path() / "bad" / "folder.so");
  const auto message = [&](const std::string& name) {
    const Error error = refusal("bad." + name, folder.path());
    CHECK(error.fault() == Fault::plugin);
    CHECK_THAT(error.where(), Contains("bad/" + name + ".so"));
    return std::string(error.what());
  };
  CHECK_THAT(message("garbage"), Contains("no ELF header"));
  CHECK_THAT(message("text"), Contains("is not a shared object"));
  CHECK_THAT(message("none"), Contains("too short"));
  CHECK_THAT(message("folder"), Contains("not a regular file"));

  const Error other = refusal("bad.not_a_plugin");
  CHECK(other.fault() == Fault::plugin);
  CHECK_THAT(other.what(), Contains("no section .velum"));
  CHECK_THAT(other.hint(), Contains("VELUM_STAGE"));
}

TEST_CASE("a plugin that is cut short is refused at every length") {
  const PluginFolder folder;
  const std::string whole = content_of("sound");
  for (std::size_t length = 0; length < whole.size(); length += 1 + whole.size() / 60) {
    folder.put("sound", std::string_view(whole).substr(0, length));
    const Error error = refusal("bad.sound", folder.path());
    INFO("length " << length << ": " << error.what());
    CHECK(error.fault() == Fault::plugin);
  }
  folder.put("sound", std::string_view(whole).substr(0, whole.size() - 1));
  CHECK_THAT(refusal("bad.sound", folder.path()).what(), Contains("less than its header promises"));
}

TEST_CASE("reading a damaged file's entry never fails otherwise than by an Error") {
  const PluginFolder folder;
  const std::string whole = content_of("sound");
  std::mt19937 random(3);
  for (int round = 0; round < 200; ++round) {
    std::string damaged = whole;
    for (int i = 0; i < 4; ++i) {
      // The headers at both ends are what is read.
      const std::size_t at = random() % 4096;
      damaged[i % 2 == 0 ? at % 64 : damaged.size() - 1 - at] = static_cast<char>(random());
    }
    const fs::path file = folder.put("sound", damaged);
    try {
      plugins::check_entry(file, "bad.sound");
    } catch (const Error& error) {
      CHECK(error.fault() == Fault::plugin);
    }
  }
}

TEST_CASE("a plugin of another kind of build is refused, the field named with both values") {
  const PluginFolder folder;
  const std::string whole = content_of("sound");
  const PluginEntry ours = entry_of(whole);
  const auto refused = [&](std::uint32_t Fingerprint::*field, std::uint32_t value) {
    PluginEntry entry = ours;
    entry.fingerprint.*field = value;
    folder.put("sound", with_entry(whole, entry));
    const Error error = refusal("bad.sound", folder.path());
    CHECK(error.fault() == Fault::plugin);
    CHECK_FALSE(error.hint().empty());
    return std::string(error.what());
  };
  CHECK_THAT(refused(&Fingerprint::sdk_major, 9), Contains("sdk_major = 9, this Velum with 0"));
  CHECK_THAT(refused(&Fingerprint::sdk_minor, 77), Contains("sdk_minor = 77"));
  CHECK_THAT(refused(&Fingerprint::compiler, 3 - ours.fingerprint.compiler),
             Contains("compiler ="));
  CHECK_THAT(refused(&Fingerprint::compiler_major, 5), Contains("compiler_major = 5"));
  CHECK_THAT(refused(&Fingerprint::cplusplus, 201103), Contains("cplusplus = 201103"));
  CHECK_THAT(refused(&Fingerprint::cxx11_abi, 0), Contains("cxx11_abi = off, this Velum with on"));
  CHECK_THAT(refused(&Fingerprint::debug_containers, 1 - ours.fingerprint.debug_containers),
             Contains("debug_containers"));
  CHECK_THAT(refused(&Fingerprint::eigen_version, 30300), Contains("eigen_version = 3.3.0"));
  CHECK_THAT(refused(&Fingerprint::eigen_alignment, 64), Contains("eigen_alignment = 64"));
  CHECK_THAT(refused(&Fingerprint::size_of_cloud, 1), Contains("size_of_cloud"));
  CHECK_THAT(refused(&Fingerprint::size_of_mesh, 1), Contains("size_of_mesh"));
  CHECK_THAT(refused(&Fingerprint::size_of_surface, 1), Contains("size_of_surface"));
  CHECK_THAT(refused(&Fingerprint::size_of_transform, 1), Contains("size_of_transform"));
  CHECK_THAT(refused(&Fingerprint::size_of_clusters, 1), Contains("size_of_clusters"));
  CHECK_THAT(refused(&Fingerprint::size_of_table, 1), Contains("size_of_table"));
}

TEST_CASE("a plugin in the wrong place, or with an entry of another size, is refused") {
  const PluginFolder folder;
  const std::string whole = content_of("sound");
  folder.put("renamed", whole);
  const Error renamed = refusal("bad.renamed", folder.path());
  CHECK(renamed.fault() == Fault::plugin);
  CHECK_THAT(renamed.what(), Contains("holds the stage 'bad.sound'") && Contains("'bad.renamed'"));

  PluginEntry entry = entry_of(whole);
  entry.size = 12;
  folder.put("sound", with_entry(whole, entry));
  CHECK_THAT(refusal("bad.sound", folder.path()).what(), Contains("12 bytes"));
  entry.magic[7] = '2';
  folder.put("sound", with_entry(whole, entry));
  CHECK_THAT(refusal("bad.sound", folder.path()).what(), Contains("not the entry of a plugin"));
}

TEST_CASE("what cannot be linked or has no stage is refused with the reason") {
  const PluginFolder folder;
  const Error undefined = refusal("bad.undefined_symbol");
  CHECK(undefined.fault() == Fault::plugin);
  CHECK_THAT(undefined.what(), Contains("undefined symbol") && Contains("found_nowhere"));
  CHECK_THAT(undefined.hint(), Contains("link the library"));
  const Error missing = refusal("bad.no_symbol");
  CHECK(missing.fault() == Fault::plugin);
  CHECK_THAT(missing.what(), Contains("no function velum_stage"));
  // Harmless to open, and cured by an installation: not remembered.
  CHECK(folder.remembered() == 0);
}

TEST_CASE("a description that throws or breaks the rules is refused") {
  const PluginFolder folder;
  const Error thrown = refusal("bad.about_throws");
  CHECK(thrown.fault() == Fault::plugin);
  CHECK_THAT(thrown.what(), Contains("about() throws: two ports, one name"));
  const Error unsound = refusal("bad.about_unsound");
  CHECK(unsound.fault() == Fault::plugin);
  CHECK_THAT(unsound.what(), Contains("no summary") && Contains("output 1 has no name") &&
                                 Contains("depends on 'metric', which is no parameter") &&
                                 Contains("default of 'size', -1, is outside its range") &&
                                 Contains("'size' is named twice"));
}
