// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
// Plugins that will not load: each must end in an error that says what is wrong, the host alive.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <random>
#include <thread>

#include "plugins/call.hpp"
#include "plugins/elf.hpp"
#include "plugins/entry.hpp"
#include "plugins/library.hpp"
#include "plugins/probe.hpp"
#include "plugins/registry.hpp"
#include "run/local_context.hpp"
#include "velum/files.hpp"

namespace {

namespace fs = std::filesystem;
using namespace velum;
using Catch::Matchers::Contains;
using plugins::Registry;

const fs::path kPlugins = fs::path(VELUM_BINARY_DIR) / "test-plugins";

/// A folder of its own for each test, with the user's cache in it.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("velum-plugins-" + std::to_string(::getpid()))) {
    fs::remove_all(path_);
    fs::create_directories(path_ / "bad");
    ::setenv("XDG_CACHE_HOME", (path_ / "cache").c_str(), 1);
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  [[nodiscard]] const fs::path& path() const { return path_; }
  fs::path put(const std::string& name, std::string_view content) const {
    const fs::path file = path_ / "bad" / (name + ".so");
    std::ofstream(file, std::ios::binary) << content;
    return file;
  }
  [[nodiscard]] std::size_t remembered() const {
    const fs::path probes = path_ / "cache" / "velum" / "probes";
    if (!fs::exists(probes)) return 0;
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(probes), {}));
  }

 private:
  fs::path path_;
};

std::string content_of(const std::string& plugin) {
  return std::string(FileContent(kPlugins / "bad" / (plugin + ".so")).text());
}

/// The error with which `attempt` ends.
template <class Attempt>
Error error_of(const Attempt& attempt) {
  try {
    attempt();
  } catch (const Error& error) {
    return error;
  }
  FAIL("no error");
  throw std::logic_error("unreachable");
}

Error refusal(const std::string& id, const fs::path& path = kPlugins) {
  Registry registry(Registry::Trust::probe, {path});
  Error error = error_of([&] { registry.stage(id); });
  // What the graph's check is told is the same.
  CHECK(registry.find(id) == nullptr);
  if (error.fault() == Fault::plugin) CHECK(registry.why_not(id) == plugins::one_line(error));
  return error;
}

/// Where the entry of `content` begins.
std::size_t entry_in(const std::string& content) {
  const auto at = content.find(std::string_view("VELUMPL1", 8));
  REQUIRE(at != std::string::npos);
  return at;
}

PluginEntry entry_of(const std::string& content) {
  PluginEntry entry;
  std::memcpy(&entry, content.data() + entry_in(content), sizeof(entry));
  return entry;
}

std::string with_entry(std::string content, const PluginEntry& entry) {
  std::memcpy(content.data() + entry_in(content), &entry, sizeof(entry));
  return content;
}

}  // namespace

TEST_CASE("a sound plugin is found by its id, opened once and run") {
  const Folder folder;
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

TEST_CASE("an unknown stage is a mistake of the graph, with the nearest name") {
  const Folder folder;
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
  const Folder folder;
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
  const Folder folder;
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
  const Folder folder;
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
  const Folder folder;
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
  const Folder folder;
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

TEST_CASE("what crashes or throws while it is opened comes into quarantine") {
  const Folder folder;
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
  const Folder folder;
  const auto probed =
      plugins::probe_afresh(kPlugins / "bad" / "hang.so", std::chrono::milliseconds(300));
  CHECK_THAT(probed.quarantined, Contains("hangs when it is opened: no answer within 0.3 s"));
}

TEST_CASE("what cannot be linked or has no stage is refused with the reason") {
  const Folder folder;
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
  const Folder folder;
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

TEST_CASE("what a stage throws while it runs becomes an error of the kernel") {
  const Folder folder;
  const auto thrown = [](const char* what) {
    Registry registry(Registry::Trust::probe, {kPlugins});
    const StageType& stage = registry.stage("bad.run_throws");
    run::LocalContext context(1, 1);
    return error_of([&] {
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
  const Folder folder;
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
  const Folder folder;
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
  const Folder folder;
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
