// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command_line.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <charconv>
#include <csignal>
#include <iostream>
#include <limits>
#include <thread>

#include "graph/schema.hpp"
#include "nodes/formats/units.hpp"
#include "tools/text.hpp"

namespace posevote {
namespace {

std::vector<CommandEntry>& commands() {
  static std::vector<CommandEntry> entries;
  return entries;
}

std::vector<std::string> command_words;

std::atomic<bool> interrupted = false;

extern "C" void on_interrupt(int signal) {
  interrupted = true;
  std::signal(signal, SIG_DFL);
}

}  // namespace

const std::vector<CommandEntry>& all_commands() { return commands(); }

bool add_command(CommandEntry entry) {
  const auto place = std::lower_bound(
      commands().begin(), commands().end(), entry,
      [](const CommandEntry& a, const CommandEntry& b) { return a.name < b.name; });
  commands().insert(place, std::move(entry));
  return true;
}

CLI::Validator whole_number(std::uint64_t most) {
  return {[most](const std::string& text) -> std::string {
            std::uint64_t value = 0;
            const char* end = text.data() + text.size();
            const auto [last, error] = std::from_chars(text.data(), end, value);
            const bool is_octal = text.size() > 1 && text.front() == '0';
            if (error == std::errc() && last == end && value <= most && !is_octal) return "";
            return "'" + text + "' is no whole number from 0 to " + std::to_string(most);
          },
          "", "whole number"};
}

CLI::Validator number_in(double low, double high) {
  return {[range = graph::in_range(low, high)](const std::string& text) -> std::string {
            const auto value = graph::Scalar<double>::parse(text);
            if (value && !range.violated_by(*value)) return "";
            return "'" + text + "' is no number " + range.text();
          },
          "", "number"};
}

void add_set(CLI::App& app, std::vector<std::string>& set) {
  app.add_option("--set", set, "Override one parameter: node.param=value (repeatable)")
      ->type_name("NODE.PARAM=VALUE")
      ->allow_extra_args(false);
}

void add_threads(CLI::App& app, std::size_t& threads) {
  app.add_option("--threads", threads, "Threads; 0: all cores")
      ->check(whole_number(kMostThreads))
      ->capture_default_str();
}

void add_seed(CLI::App& app, std::uint64_t& seed) {
  app.add_option("--seed", seed, "Seed of all randomness")
      ->check(whole_number(std::numeric_limits<std::uint64_t>::max()))
      ->capture_default_str();
}

void add_cache(CLI::App& app, std::string& cache) {
  app.add_option("--cache", cache, "Folder for trained libraries; default ~/.cache/posevote")
      ->type_name("DIR");
}

void add_targets(CLI::App& app, std::string& targets) {
  app.add_option("--targets", targets,
                 "Judge only these; default test_targets_bop19.json, if there; none: judge all")
      ->type_name("FILE");
}

void add_json(CLI::App& app, bool& json) {
  app.add_flag("--json", json,
               "Print JSON instead of tables, and nothing else, to standard output");
}

CLI::Option* add_unit(CLI::App& app, const std::string& name, std::string& unit,
                      const std::string& help) {
  std::string units;
  for (const std::string& known : formats::length_units())
    units += (units.empty() ? "" : "|") + known;
  return app.add_option(name, unit, help + "; default: as the config says")->type_name(units);
}

int with_threads(std::size_t threads, const std::function<int()>& command) {
  const std::size_t count =
      threads > 0 ? threads : std::max<std::size_t>(1, std::thread::hardware_concurrency());
  const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                          count);
  oneapi::tbb::task_arena arena(static_cast<int>(count));
  return arena.execute(command);
}

const std::atomic<bool>& end_in_order() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  return interrupted;
}

void remember_command(int argc, const char* const* argv) {
  command_words.assign(argv, argv + argc);
}

void tell_interrupted(const std::string& left, bool resume) {
  std::string text;
  for (const std::string& word : command_words)
    if (!resume || (word != "--overwrite" && word != "--resume"))
      text += (text.empty() ? "" : " ") + quote_for_shell(word);
  std::cerr << "interrupted: " << left << "; to go on:\n  " << text << (resume ? " --resume" : "")
            << "\n";
}

}  // namespace posevote
