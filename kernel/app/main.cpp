// SPDX-FileCopyrightText: 2026 The Velum authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "commands.hpp"
#include "console.hpp"
#include "graph/diagnostic.hpp"
#include "study_task.hpp"

namespace velum::app {
namespace {

constexpr int kUsage = static_cast<int>(Fault::graph);
constexpr int kFailed = static_cast<int>(Fault::stage);

constexpr const char* kExamples = R"(Examples:
  velum run wind_tunnel.toml                    run a graph; results go to wind_tunnel.out/
  velum run wind_tunnel.toml --set mls.radius="60 mm" --out smoother
  velum check wind_tunnel.toml                  every mistake, before anything runs
  velum list filtering                          the stages of one kind
  velum describe registration.icp               what a stage takes, gives and can be set to
  velum convert scan.pcd scan.ply --units mm

Exit status: 0 done; 1 a stage failed or a result is empty; 2 the command line or the graph is
wrong; 3 a study is complete but some variants failed; 4 a plugin cannot be loaded; 5 an input file
is bad; 6 output or disk; 7 device; 130 interrupted.)";

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    if (!command->get_name().empty()) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> flag_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

const CLI::App& chosen(const CLI::App& app) {
  const auto commands = app.get_subcommands();
  return commands.empty() ? app : *commands.front();
}

// "--thread" is answered with "did you mean '--threads'?".
std::string hint_for(const CLI::App& app) {
  const CLI::App& command = chosen(app);
  for (const std::string& word : app.remaining(true)) {
    if (!word.starts_with("-")) continue;
    const std::string flag = word.substr(0, word.find('='));
    std::string hint = graph::did_you_mean(flag, flag_names(command));
    if (!hint.empty()) return hint;
  }
  const std::string name = &command == &app ? "" : " " + command.get_name();
  return "`velum" + name + " --help` shows what it takes";
}

int refuse(const std::string& message, const std::string& hint) {
  complain(format(Error(Fault::graph, message).hint(hint)));
  return kUsage;
}

int parse(CLI::App& app, int argc, char** argv) {
  const auto names = command_names(app);
  const std::string first = argc > 1 ? argv[1] : "";  // NOLINT
  if (first.empty()) {
    complain(app.help());
    return kUsage;
  }
  if (!first.starts_with("-") && std::find(names.begin(), names.end(), first) == names.end()) {
    const std::string guess = graph::did_you_mean(first, names);
    return refuse("unknown command '" + first + "'",
                  guess.empty() ? "`velum --help` lists the commands" : guess);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    print(chosen(app).help());
  } catch (const CLI::CallForVersion&) {
    print(std::string("velum ") + kVersion + "\n");
  } catch (const CLI::ParseError& error) {
    return refuse(error.what(), hint_for(app));
  }
  return 0;
}

int run(int argc, char** argv) {
  CLI::App app(
      "Turns laser scans into registered, segmented, meshed and measured surfaces by graphs"
      " of stages.",
      "velum");
  app.set_version_flag("--version", [] { return std::string("velum ") + kVersion; });
  app.footer(kExamples);
  app.require_subcommand(0, 1);
  add_run(app);
  add_check(app);
  add_study(app);
  add_study_task(app);
  add_rerun(app);
  add_report(app);
  add_list(app);
  add_describe(app);
  add_schema(app);
  add_new(app);
  add_convert(app);
  add_info(app);
  add_record(app);
  add_emulate(app);
  return parse(app, argc, argv);
}

}  // namespace
}  // namespace velum::app

// What is thrown by a stage is an Error of its node by now; what arrives here otherwise is ours.
int main(int argc, char** argv) {
  using namespace velum::app;
  take_standard_output();
  try {
    const int status = run(argc, argv);
    if (status == 0) check_output();
    return status;
  } catch (const Exit& exit) {
    return exit.status;
  } catch (const velum::Error& error) {
    complain(format(error));
    return static_cast<int>(error.fault());
  } catch (const std::bad_alloc&) {
    complain("error: out of memory\n");
  } catch (const std::exception& error) {
    complain(std::string("error: ") + error.what() + "\n");
  }
  return kFailed;
}
