// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace posevote {

/// posevote(1) in roff's man macros: every command with its options, as help has them.
std::string man_page(const CLI::App& program);

/// The commands as a table in Markdown, for tools/README.md.
std::string command_table(const CLI::App& program);

}  // namespace posevote
