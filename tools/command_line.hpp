// SPDX-License-Identifier: BSD-3-Clause
// How a subcommand comes into the program: its file registers it, with its options and what runs
// it, and nothing else names it.
//
//   const auto registered = register_command<TrainCommand>(
//       "train", "Prepare models once", add_options,
//       [](const TrainCommand& command) { return train_command(command); });
#pragma once

#include <CLI/CLI.hpp>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace posevote {

/// Puts a subcommand's options into `app`; returns what runs it, for its exit status.
using AddCommand = std::function<std::function<int()>(CLI::App& app)>;

struct CommandEntry {
  std::string name;
  std::string help;
  AddCommand add;
};

/// In alphabetical order. Filled before main.
const std::vector<CommandEntry>& all_commands();
bool add_command(CommandEntry entry);

/// Options: what the command line says, default-constructed, then set by `add_options`.
template <class Options>
bool register_command(std::string name, std::string help,
                      std::function<void(CLI::App&, std::type_identity_t<Options>&)> add_options,
                      std::function<int(const std::type_identity_t<Options>&)> run) {
  const auto add = [=](CLI::App& app) -> std::function<int()> {
    const auto options = std::make_shared<Options>();
    add_options(app, *options);
    return [options, run] { return run(*options); };
  };
  return add_command({std::move(name), std::move(help), add});
}

/// Decimal digits alone, up to `most`: CLI11 takes signs, other bases ("010" is 8) and what
/// overflows.
CLI::Validator whole_number(std::uint64_t most);
/// As nodes' parameters are read; CLI::Range takes NaN.
CLI::Validator number_in(double low, double high);
constexpr std::uint64_t kMostThreads = 1024;

/// The option --set.
void add_set(CLI::App& app, std::vector<std::string>& set);

/// The option --threads.
void add_threads(CLI::App& app, std::size_t& threads);

/// The option --seed.
void add_seed(CLI::App& app, std::uint64_t& seed);

/// The option --cache.
void add_cache(CLI::App& app, std::string& cache);

/// The option --targets.
void add_targets(CLI::App& app, std::string& targets);

/// The flag --json; JsonAnswer (tools/json_answer.hpp) is what it asks for.
void add_json(CLI::App& app, bool& json);

/// An option that names a unit of length.
CLI::Option* add_unit(CLI::App& app, const std::string& name, std::string& unit,
                      const std::string& help);

/// Runs the command with that many threads, 0 for all; a flow graph belongs to the arena that it is
/// made in.
int with_threads(std::size_t threads, const std::function<int()>& command);

/// From now on the first Ctrl-C sets what is returned, for a command that ends in order; the second
/// one kills.
const std::atomic<bool>& end_in_order();

/// For messages: the program as it was called, and its arguments.
void remember_command(int argc, const char* const* argv);
/// Says on standard error what is left ("3 of 12 frames are left"), and the command that goes on:
/// `resume`: with --resume, without --overwrite.
void tell_interrupted(const std::string& left, bool resume);

}  // namespace posevote
