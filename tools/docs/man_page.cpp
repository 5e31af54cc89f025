// SPDX-License-Identifier: BSD-3-Clause
#include "tools/docs/man_page.hpp"

#include "pipelines/recognizer.hpp"
#include "tools/program.hpp"
#include "tools/text.hpp"

namespace posevote {
namespace {

/// Text that roff takes for text: no escapes, no hyphenated options, no line that is a request.
std::string roff(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    const bool begins = safe.empty() || safe.back() == '\n';
    if (begins && (c == '.' || c == '\'')) safe += "\\&";
    if (c == '\\')
      safe += "\\e";
    else if (c == '-')
      safe += "\\-";
    else
      safe += c;
  }
  return safe;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

bool takes_many(const CLI::Option& option) {
  return option.get_expected_max() >= CLI::detail::expected_max_vector_size;
}

/// An argument's place in the synopsis.
std::string argument(const CLI::Option& option) {
  const std::string name = italic(option.get_name(true)) + (takes_many(option) ? "..." : "");
  return option.get_required() ? name : "[" + name + "]";
}

std::string tagged(const std::string& tag, const CLI::Option& option) {
  const std::string given = option.get_default_str();
  return ".TP\n" + tag + "\n" + roff(option.get_description()) +
         (given.empty() ? "" : roff(" [" + given + "]")) + "\n";
}

std::string entry(const CLI::Option& option) {
  std::string names;
  for (const std::string& name : option.get_snames())
    names += (names.empty() ? "" : ", ") + bold("-" + name);
  for (const std::string& name : option.get_lnames())
    names += (names.empty() ? "" : ", ") + bold("--" + name);
  if (option.get_items_expected_max() > 0)
    names += " " + italic(value_name(option)) + (takes_many(option) ? "..." : "");
  return tagged(names, option);
}

/// Paragraphs as they are, examples (lines with an indent) line by line.
std::string footer(const std::string& text) {
  std::string page;
  bool in_example = false;
  for (const std::string& line : split(text, '\n')) {
    const bool is_example = line.starts_with("  ");
    if (is_example != in_example) page += is_example ? ".nf\n" : ".fi\n";
    in_example = is_example;
    page +=
        line.empty() ? ".PP\n" : (is_example ? "\\&  " + roff(line.substr(2)) : roff(line)) + "\n";
  }
  return page + (in_example ? ".fi\n" : "");
}

std::string command_section(const CLI::App& command) {
  std::string page = ".SS " + roff(command.get_name()) + "\n" + roff(command.get_description()) +
                     ".\n.PP\n" + bold("posevote " + command.get_name());
  for (const CLI::Option* option : shown_arguments(command)) page += " " + argument(*option);
  page += " [" + italic("options") + "]\n";
  for (const CLI::Option* option : shown_arguments(command))
    page += tagged(italic(option->get_name(true)), *option);
  for (const CLI::Option* option : shown_options(command))
    if (option != command.get_help_ptr()) page += entry(*option);
  return page + ".PP\n" + footer(command.get_footer());
}

constexpr const char* kEnd = R"(.SH EXIT STATUS
.TP
.B 0
Done; of a run: all scans answered.
.TP
.B 1
It failed on the way; of a run: some scans or models failed, or \-\-on\-error stop stopped it.
.TP
.B 2
Wrong usage, config or input: nothing ran.
.TP
.B 130
Ended by Ctrl\-C, in order.
.SH ENVIRONMENT
.TP
.B XDG_CACHE_HOME
Where trained libraries are kept, in posevote/; default ~/.cache.
.SH SEE ALSO
The reference of nodes, in the sources' nodes/README.md, or
.B posevote nodes
.IR NAME .
)";

}  // namespace

std::string man_page(const CLI::App& program) {
  std::string page = ".TH POSEVOTE 1 \"\" \"posevote " + roff(version()) +
                     "\" \"User Commands\"\n.SH NAME\nposevote \\- find known 3D objects in 3D "
                     "scans\n.SH SYNOPSIS\n" +
                     bold("posevote") + " " + italic("command") + " [" + italic("options") +
                     "]\n.SH OPTIONS\n";
  for (const CLI::Option* option : shown_options(program)) page += entry(*option);
  page += ".SH COMMANDS\n";
  for (const CLI::App* command : shown_commands(program)) page += command_section(*command);
  return page + kEnd;
}

std::string command_table(const CLI::App& program) {
  std::string table = "| command | |\n|---|---|\n";
  for (const CLI::App* command : shown_commands(program))
    table += "| `posevote " + command->get_name() + "` | " + command->get_description() + " |\n";
  return table;
}

}  // namespace posevote
