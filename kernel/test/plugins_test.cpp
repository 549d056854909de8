// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Plugins that are found, probed, opened and run, also by those that crash or hang.
#include <algorithm>
#include <chrono>
#include <thread>

#include "plugins/probe.hpp"
#include "plugins_support.hpp"
#include "run/local_context.hpp"

namespace fs = std::filesystem;
using namespace velum;
using Catch::Matchers::Contains;
using plugins::Registry;
using test::content_of;
using test::kPlugins;
using test::PluginFolder;
using test::refusal;

TEST_CASE("a sound plugin is found by its id, opened once and run") {
  const PluginFolder folder;
  Registry registry(Registry::Trust::probe, {kPlugins});
  const StageType& stage = registry.stage("bad.sound");
  CHECK(stage.info().id == "bad.sound");
  CHECK(stage.info().parameters.at(0).name == "size");
  CHECK(&registry.stage("bad.sound") == &stage);
  CHECK(registry.find("bad.sound") == &stage.info());
  CHECK(registry.why_not("bad.sound").empty());
  CHECK(registry.file("bad.sound") == fs::weakly_canonical(kPlugins / "bad" / "sound.so"));
  CHECK(registry.file_hash("bad.sound").size() == 32);
  const auto ids = registry.ids();
  CHECK(std::is_sorted(ids.begin(), ids.end()));
  CHECK(std::find(ids.begin(), ids.end(), "bad.crash") != ids.end());
}

TEST_CASE("what crashes or throws while it is opened comes into quarantine") {
  const PluginFolder folder;
  const auto reason = [](const std::string& id) {
    const Error error = refusal(id);
    CHECK(error.fault() == Fault::plugin);
    CHECK_THAT(error.hint(), Contains("velum list --quarantined"));
    return std::string(error.what());
  };
  CHECK_THAT(reason("bad.crash"), Contains("crashes when it is opened: SIG"));
  CHECK_THAT(reason("bad.throw"), Contains("throws in a static constructor: no licence found"));
  CHECK_THAT(reason("bad.throw_int"), Contains("something that is not a std::exception"));
  CHECK_THAT(reason("bad.exit"), Contains("ends the process when it is opened, with status 3"));
}

TEST_CASE("what hangs while it is opened comes into quarantine") {
  const PluginFolder folder;
  const auto probed =
      plugins::probe_afresh(kPlugins / "bad" / "hang.so", std::chrono::milliseconds(300));
  CHECK_THAT(probed.quarantined, Contains("hangs when it is opened: no answer within 0.3 s"));
}

TEST_CASE("what a stage throws while it runs becomes an error of the kernel") {
  const PluginFolder folder;
  const auto thrown = [](const char* what) {
    Registry registry(Registry::Trust::probe, {kPlugins});
    const StageType& stage = registry.stage("bad.run_throws");
    run::LocalContext context(1, 1);
    return test::error_of([&] {
      const plugins::Call call{{Setting{std::string(what)}}, {}};
      (void)plugins::invoke(stage, call, context);
    });
  };
  CHECK(thrown("standard").fault() == Fault::stage);
  CHECK_THAT(thrown("standard").what(), Contains("a vector too long"));
  CHECK_THAT(thrown("own_standard").what(), Contains("own error of the plugin"));
  CHECK_THAT(thrown("own").what(), Contains("not a std::exception"));
  CHECK_THAT(thrown("integer").what(), Contains("not a std::exception"));
  CHECK_THAT(thrown("memory").what(), Contains("out of memory"));
  const Error kernel = thrown("kernel");
  CHECK(kernel.fault() == Fault::device);
  CHECK(kernel.where() == "COM1");
  CHECK(kernel.hint() == "plug it in");
  CHECK_THROWS_AS(thrown("cancelled"), Cancelled);
}

TEST_CASE("a probe is remembered until the file changes; damage of the memory costs time only") {
  const PluginFolder folder;
  const fs::path file = folder.put("sound", content_of("sound"));
  CHECK(plugins::probe(file).summary == "Gives its cloud back.");
  CHECK(folder.remembered() == 1);

  // The quickest of several: the machine may have other things to do.
  std::chrono::duration<double> quickest(1.0);
  for (int i = 0; i < 20; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    CHECK(plugins::probe(file).quarantined.empty());
    quickest =
        std::min<std::chrono::duration<double>>(quickest, std::chrono::steady_clock::now() - begin);
  }
#if !defined(VELUM_SANITIZED)
  CHECK(quickest.count() < 1e-3);
#endif

  folder.put("sound", content_of("crash"));
  CHECK_THAT(plugins::probe(file).quarantined, Contains("crashes"));
  const fs::path memory =
      fs::directory_iterator(folder.path() / "cache" / "velum" / "probes")->path();
  for (const char* damage : {"", "{", "[1,2]", "{\"key\": 7}", "{\"key\":", "\xff\xfe"}) {
    std::ofstream(memory, std::ios::binary) << damage;
    CHECK_THAT(plugins::probe(file).quarantined, Contains("crashes"));
  }
  plugins::forget_probe(file);
  CHECK(folder.remembered() == 0);
}

TEST_CASE(
    "probes of several threads do not disturb each other, nor does a cache that is no folder") {
  const PluginFolder folder;
  const fs::path file = folder.put("sound", content_of("sound"));
  std::vector<std::thread> threads;
  std::atomic<int> sound = 0;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] { sound += plugins::probe(file).quarantined.empty() ? 1 : 0; });
  for (std::thread& thread : threads) thread.join();
  CHECK(sound == 4);
  CHECK(folder.remembered() == 1);

  fs::remove_all(folder.path() / "cache");
  std::ofstream(folder.path() / "cache") << "not a folder";
  CHECK(plugins::probe(file).summary == "Gives its cloud back.");
}

TEST_CASE("the plugin path: order, empty entries, files that hide others") {
  const PluginFolder folder;
  folder.put("sound", content_of("sound"));
  ::setenv("VELUM_PLUGIN_PATH",
           (":" + folder.path().string() + "::" + kPlugins.string() + ":").c_str(), 1);
  const auto path = plugins::search_path();
  ::unsetenv("VELUM_PLUGIN_PATH");
  REQUIRE(path.size() >= 2);
  CHECK(path[0] == fs::weakly_canonical(folder.path()));
  CHECK(path[1] == fs::weakly_canonical(kPlugins));
  CHECK(std::find(path.begin(), path.end(), fs::current_path()) == path.end());

  const auto files = plugins::find_plugin(path, "bad.sound");
  REQUIRE(files.size() == 2);
  CHECK(files[0].parent_path().parent_path() == path[0]);
  CHECK(plugins::find_plugins(path).at("bad.sound").size() == 2);
  CHECK(plugins::is_id("resampling.mls2"));
  for (const char* bad :
       {"", "mls", ".mls", "a.", "a.b.c", "A.b", "a.b-c", "2a.b", "a/b.c", "a. b"})
    CHECK_FALSE(plugins::is_id(bad));
}
