// SPDX-License-Identifier: Apache-2.0
#include "app/manual/manual.h"

#include <CLI/CLI.hpp>

namespace nt {

void add_manual_options(CLI::App& app) {
  app.add_option_function<std::string>(
         "--completions", [](const std::string& shell) { throw WriteManual(shell); },
         "print what the shell is to source for completing options (bash, zsh or fish)")
      ->type_name("bash|zsh|fish")
      ->check(CLI::IsMember({"bash", "zsh", "fish"}))
      ->trigger_on_parse();
  app.add_flag_callback(
      "--man-page", [] { throw WriteManual("man"); }, "print the man page (| man -l -)");
}

std::string manual(const CLI::App& app, const std::string& kind) {
  const std::vector<CommandRow> table = option_table(app);
  if (kind == "man") return man_page(table);
  if (kind == "bash") return bash_completions(table);
  if (kind == "zsh") return zsh_completions(table);
  return fish_completions(table);
}

}  // namespace nt
