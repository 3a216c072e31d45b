// SPDX-License-Identifier: Apache-2.0
// The man page, and completions for bash, zsh and fish, written from the option table.
//
// `neontetra --man-page` and `neontetra --completions SHELL` print them; the build puts them into the package.
#pragma once
#include <CLI/Error.hpp>
#include <string>
#include <vector>

#include "app/manual/option_table.h"

namespace nt {

std::string man_page(const std::vector<CommandRow>& table);
std::string bash_completions(const std::vector<CommandRow>& table);
std::string zsh_completions(const std::vector<CommandRow>& table);
std::string fish_completions(const std::vector<CommandRow>& table);

// Thrown while the command line is read, before anything is found missing in it.
struct WriteManual : CLI::Success {
  explicit WriteManual(std::string kind_) : CLI::Success("WriteManual", "", CLI::ExitCodes::Success), kind(kind_) {}
  std::string kind;  // man, bash, zsh or fish
};
void add_manual_options(CLI::App& app);
std::string manual(const CLI::App& app, const std::string& kind);

}  // namespace nt
