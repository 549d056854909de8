// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include "plugins/library.hpp"

#include <dlfcn.h>

#include <boost/dll/shared_library.hpp>
#include <mutex>

#include "velum/error.hpp"

namespace velum::plugins {
namespace {

using Library = boost::dll::shared_library;

/// What the dynamic loader said, without the path that the message's place names already.
std::string loader_message(const std::filesystem::path& file) {
  const char* text = ::dlerror();
  std::string message = text == nullptr ? "no reason given" : text;
  const std::string prefix = file.string() + ": ";
  if (message.rfind(prefix, 0) == 0) message.erase(0, prefix.size());
  return message;
}

const char* loader_hint(const std::string& message) {
  if (message.find("undefined symbol") != std::string::npos)
    return "link the library that has it, or build the plugin again with this SDK; "
           "velum_add_plugin finds such a symbol when it links";
  if (message.find("cannot open shared object") != std::string::npos)
    return "install the library that the plugin links";
  return "build the plugin again";
}

/// Every opened library, kept until the process ends: values, exceptions and type information of
/// plugins may outlive any moment at which closing them would be safe.
void keep(Library&& library) {
  static std::mutex mutex;
  static auto& opened = *new std::vector<Library>;
  const std::lock_guard lock(mutex);
  opened.push_back(std::move(library));
}

[[noreturn]] void throwing(const std::filesystem::path& file, const std::string& what) {
  throw Error(Fault::plugin, "the stage's about() throws: " + what).at(file.string());
}

const StageType* ask(const std::filesystem::path& file, const StageType* (*entry)()) {
  try {
    return entry();
  } catch (const std::exception& error) {
    throwing(file, error.what());
  } catch (...) {
    throwing(file, "something that is not a std::exception");
  }
}

}  // namespace

const StageType& open_stage(const std::filesystem::path& file) {
  boost::dll::fs::error_code failed;
  Library library;
  library.load(boost::dll::fs::path(file.string()),
               boost::dll::load_mode::rtld_now | boost::dll::load_mode::rtld_local, failed);
  if (failed) {
    const std::string message = loader_message(file);
    throw Error(Fault::plugin, "the plugin cannot be opened: " + message)
        .at(file.string())
        .hint(loader_hint(message));
  }
  const auto entry =
      library.has("velum_stage") ? &library.get<const StageType*()>("velum_stage") : nullptr;
  keep(std::move(library));
  if (entry == nullptr) {
    throw Error(Fault::plugin, "the plugin has no function velum_stage")
        .at(file.string())
        .hint("end the plugin's source with VELUM_STAGE(Type)");
  }
  const StageType* stage = ask(file, entry);
  if (stage == nullptr) throw Error(Fault::plugin, "velum_stage gives no stage").at(file.string());
  const auto faults = faults_of(stage->info());
  if (!faults.empty()) {
    std::string all = faults.front();
    for (std::size_t i = 1; i < faults.size(); ++i) all += "; " + faults[i];
    throw Error(Fault::plugin, "the stage's about() is not sound: " + all).at(file.string());
  }
  return *stage;
}

}  // namespace velum::plugins
