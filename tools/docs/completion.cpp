// SPDX-License-Identifier: BSD-3-Clause
#include "tools/docs/completion.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>

#include "graph/registry.hpp"
#include "pipelines/configuration.hpp"
#include "pipelines/installed.hpp"
#include "tools/evaluate/rules.hpp"
#include "tools/experiment/experiment.hpp"
#include "tools/program.hpp"
#include "tools/text.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;
using Files = Completion::Files;

/// What has been typed of a command before the last word.
struct Typed {
  const CLI::Option* open = nullptr;  ///< an option that takes the next word
  Words arguments;                    ///< words that are no option's
};

const CLI::Option* find_option(const CLI::App& app, const std::string& name) {
  for (const CLI::Option* option : shown_options(app))
    if (option->check_name(name)) return option;
  return nullptr;
}

Typed read(const CLI::App& program, const CLI::App& command, const Words& words) {
  Typed typed;
  int taken = 0;
  for (const std::string& word : words) {
    if (word.starts_with("-") && word.size() > 1) {
      const CLI::Option* option = find_option(command, word);
      if (!option) option = find_option(program, word);
      const bool takes = option && option->get_items_expected_max() > 0;
      typed.open = takes ? option : nullptr;
      taken = 0;
    } else if (typed.open) {
      const int most =
          typed.open->get_allow_extra_args() ? typed.open->get_items_expected_max() : 1;
      if (++taken >= most) typed.open = nullptr;
    } else {
      typed.arguments.push_back(word);
    }
  }
  return typed;
}

/// The argument without a name whose turn it is.
const CLI::Option* next_argument(const CLI::App& command, std::size_t place) {
  const std::vector<const CLI::Option*> arguments = shown_arguments(command);
  if (arguments.empty()) return nullptr;
  if (place < arguments.size()) return arguments[place];
  return arguments.back()->get_items_expected_max() > int(place) ? arguments.back() : nullptr;
}

/// Names of the YAML files in a folder of the installation.
Words installed(const std::string& folder) {
  Words names;
  for (const auto& entry : fs::directory_iterator(shared_folder() / folder))
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  return names;
}

/// Those of the configs' folder that are no lists of scenes for `simulate`.
Words config_names() {
  Words names = installed("configs");
  std::erase_if(names, [](const std::string& name) { return name.ends_with("_scenes"); });
  return names;
}

Words node_names() {
  Words names;
  for (const graph::NodeSpec* spec : graph::all_nodes()) names.push_back(spec->name);
  return names;
}

Words rule_names() {
  Words names{"all"};
  for (const Rule& rule : all_rules()) names.push_back(rule.name);
  return names;
}

Words method_names() {
  Words names;
  for (const Method& method : find_methods({})) names.push_back(method.name);
  return names;
}

/// "node.param=value" for every value of a closed set, "node.param=" for the others.
void add_settings(const graph::PlannedNode& node, const std::string& begun, Words& words) {
  for (const graph::ParamSpec& param : node.spec->params) {
    const std::string head = node.name + "." + param.name + "=";
    Words values = param.constraint.choices;
    if (param.type == graph::Scalar<bool>::name()) values = {"true", "false"};
    if (begun.starts_with(head))
      for (const std::string& value : values) words.push_back(head + value);
    else
      words.push_back(head);
  }
}

/// Of the nodes of the config that was typed, or of the default one.
Words settings(const Words& arguments, const std::string& begun) {
  Words words;
  const Configuration configuration =
      load_configuration(arguments.empty() ? "default" : arguments.front(), {});
  for (const graph::Plan* plan :
       std::initializer_list<const graph::Plan*>{&configuration.models, &configuration.scenes})
    for (const graph::PlannedNode& node : plan->nodes)
      if (!node.like) add_settings(node, begun, words);
  return words;
}

/// What a value's name in help says of it.
void add_values(const std::string& kind, const Words& arguments, const std::string& begun,
                Completion& completion) {
  static const std::map<std::string, Words (*)()> kLists{
      {"CONFIG", config_names}, {"SET", config_names},
      {"NODE", node_names},     {"RULE", rule_names},
      {"METHOD", method_names}, {"PIPELINE", [] {
                                                             return installed("pipelines"); }}};
  const auto add = [&](const Words& more) {
    completion.words.insert(completion.words.end(), more.begin(), more.end());
  };
  if (const auto list = kLists.find(kind); list != kLists.end()) add(list->second());
  if (kind.starts_with("NODE.PARAM=VALUE")) add(settings(arguments, begun));
  if (kind == "DIR") completion.files = Files::kFolders;
  if (kind == "FILE" || kind == "PATH" || kind == "CONFIG") completion.files = Files::kAll;
  const bool is_value = std::any_of(kind.begin(), kind.end(), [](unsigned char c) {
    return std::islower(c) != 0;  // a name of a value is in capitals
  });
  if (is_value) completion.words.push_back(kind);
}

void add_option_names(const CLI::App& app, Words& words) {
  for (const CLI::Option* option : shown_options(app))
    for (const std::string& name : option->get_lnames()) words.push_back("--" + name);
}

void add_fitting(const CLI::App& program, const CLI::App& command, const Words& words,
                 Completion& completion) {
  const std::string& begun = words.back();
  if (begun.starts_with("-")) {
    add_option_names(command, completion.words);
    return add_option_names(program, completion.words);
  }
  const Typed typed = read(program, command, {words.begin(), words.end() - 1});
  const CLI::Option* value =
      typed.open ? typed.open : next_argument(command, typed.arguments.size());
  if (!value) return;
  for (const std::string& kind : split(value_name(*value), '|'))
    add_values(kind, typed.arguments, begun, completion);
}

}  // namespace

Completion complete(const CLI::App& program, const Words& words) {
  Completion completion;
  const auto commands = shown_commands(program);
  const auto command = std::find_if(commands.begin(), commands.end(), [&](const CLI::App* each) {
    return words.size() > 1 && each->get_name() == words.front();
  });
  if (words.size() == 1 && !words.front().starts_with("-"))
    for (const CLI::App* each : commands) completion.words.push_back(each->get_name());
  else if (words.size() == 1)
    add_option_names(program, completion.words);
  else if (command != commands.end())
    add_fitting(program, **command, {words.begin() + 1, words.end()}, completion);
  std::erase_if(completion.words,
                [&](const std::string& word) { return !word.starts_with(words.back()); });
  std::sort(completion.words.begin(), completion.words.end());
  return completion;
}

std::string to_text(const Completion& completion) {
  constexpr const char* kFiles[] = {"none", "folders", "files"};
  std::string text = kFiles[int(completion.files)] + std::string("\n");
  for (const std::string& word : completion.words) text += word + "\n";
  return text;
}

}  // namespace posevote
