// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>

#include "app/manual/manual.h"

namespace nt {
namespace {

constexpr const char* kLicence = "# SPDX-License-Identifier: Apache-2.0\n";
constexpr const char* kOrigin = "# Written by `neontetra --completions`.\n";

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : between) + word;
  return all;
}

std::vector<std::string> names_of(const CommandRow& command) {
  std::vector<std::string> names;
  for (const OptionRow& option : command.options) names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

std::vector<std::string> commands_of(const std::vector<CommandRow>& table) {
  std::vector<std::string> names;
  for (std::size_t i = 1; i < table.size(); ++i) names.push_back(table[i].name);
  return names;
}

// Words that can follow the option; a camera begins with its kind, the rest is the user's.
std::vector<std::string> choices_of(const OptionRow& option) {
  if (option.takes_camera) return {"sim", "v4l2", "libcamera"};
  return option.choices;
}

std::string with_escaped(const std::string& text, const std::string& special, const std::string& by) {
  std::string out;
  for (const char c : text) {
    if (special.find(c) != std::string::npos) out += by;
    out += c == '\n' ? ' ' : c;
  }
  return out;
}

// 'text' for a shell: what stands between single quotes.
std::string in_quotes(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c == '\n' ? ' ' : c);
  return out;
}

// What is offered after an option of this command that has a value.
std::string bash_values(const CommandRow& command) {
  std::string cases;
  for (const OptionRow& option : command.options) {
    if (option.value.empty() || option.names.empty()) continue;
    std::vector<std::string> patterns;
    for (const std::string& name : option.names) patterns.push_back(command.name + ":" + name);
    cases += "    " + joined(patterns, " | ") + ")\n";
    const std::vector<std::string> choices = choices_of(option);
    if (option.takes_file) cases += "      compopt -o default\n";
    cases += "      COMPREPLY=($(compgen -W '" + joined(choices, " ") + "' -- \"$word\"))\n      return\n      ;;\n";
  }
  return cases;
}

}  // namespace

std::string bash_completions(const std::vector<CommandRow>& table) {
  std::string script = std::string(kLicence) + kOrigin +
                       "_neontetra() {\n  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
                       "  local command=\n  [[ $COMP_CWORD -gt 1 && ${COMP_WORDS[1]} != -* ]] && "
                       "command=${COMP_WORDS[1]}\n  COMPREPLY=()\n"
                       "  case $command:$before in\n";
  for (const CommandRow& command : table) script += bash_values(command);
  script += "  esac\n  case $command in\n";
  for (std::size_t i = 1; i < table.size(); ++i) {
    script += "    " + table[i].name + ")\n      if [[ $word == -* ]]; then\n        COMPREPLY=($(compgen -W '" +
              joined(names_of(table[i]), " ") +
              "' -- \"$word\"))\n      else\n        compopt -o default\n      fi\n      ;;\n";
  }
  return script + "    '') COMPREPLY=($(compgen -W '" + joined(commands_of(table), " ") + " " +
         joined(names_of(table.front()), " ") + "' -- \"$word\")) ;;\n  esac\n}\ncomplete -F _neontetra neontetra\n";
}

namespace {

// "--layout[beside: ...]:beside|behind:(beside behind)", once for each name, quoted.
std::string zsh_option(const OptionRow& option) {
  const std::string help = with_escaped(option.help, "[]:\\", "\\");
  const std::vector<std::string> choices = choices_of(option);
  std::string does;
  if (!option.value.empty() || option.names.empty()) {
    does = ":" + with_escaped(option.value, ":\\", "\\") + ":";
    if (option.takes_camera)
      does += "_alternative \"kinds:camera:(" + joined(choices, " ") + ")\" \"files:file:_files\"";
    else if (option.takes_file) does += "_files";
    else if (!choices.empty()) does += "(" + joined(choices, " ") + ")";
    else does += " ";
  }
  if (option.names.empty()) return "      '*" + in_quotes(does) + "'";
  std::string lines;
  for (const std::string& name : option.names)
    lines += (lines.empty() ? "" : " \\\n") + ("      '*" + name + "[" + in_quotes(help) + "]" + in_quotes(does) + "'");
  return lines;
}

std::string zsh_arguments(const CommandRow& command) {
  std::string lines = "_arguments -s";
  for (const OptionRow& option : command.options) lines += " \\\n" + zsh_option(option);
  return lines;
}

}  // namespace

std::string zsh_completions(const std::vector<CommandRow>& table) {
  std::string script = std::string("#compdef neontetra\n") + kLicence + kOrigin +
                       "_neontetra() {\n  if ((CURRENT == 2)); then\n    local -a commands=(\n";
  for (std::size_t i = 1; i < table.size(); ++i)
    script += "      '" + table[i].name + ":" + in_quotes(with_escaped(table[i].help, ":\\", "\\")) + "'\n";
  script += "    )\n    _describe -t commands command commands\n    " + zsh_arguments(table.front()) +
            "\n    return\n  fi\n  local command=$words[2]\n  shift words\n  ((CURRENT--))\n  case $command in\n";
  for (std::size_t i = 1; i < table.size(); ++i)
    script += "  " + table[i].name + ")\n    " + zsh_arguments(table[i]) + " ;;\n";
  return script + "  esac\n}\n_neontetra \"$@\"\n";
}

std::string fish_completions(const std::vector<CommandRow>& table) {
  std::string script = std::string(kLicence) + kOrigin + "complete -c neontetra -f\n";
  for (const CommandRow& command : table) {
    const std::string when =
        command.name.empty() ? "-n __fish_use_subcommand" : "-n '__fish_seen_subcommand_from " + command.name + "'";
    if (!command.name.empty())
      script += "complete -c neontetra -n __fish_use_subcommand -a " + command.name + " -d '" +
                with_escaped(command.help, "'\\", "\\") + "'\n";
    for (const OptionRow& option : command.options) {
      std::string line = "complete -c neontetra " + when;
      for (const std::string& name : option.names)
        line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      const std::vector<std::string> choices = choices_of(option);
      if (!option.value.empty() && !option.names.empty()) line += option.takes_file ? " -r" : " -x";
      if (option.takes_file) line += " -F";
      else if (option.names.empty()) continue;  // neither a name nor a file: nothing to offer
      if (!choices.empty()) line += " -a '" + joined(choices, " ") + "'";
      script += line + " -d '" + with_escaped(option.help, "'\\", "\\") + "'\n";
    }
  }
  return script;
}

}  // namespace nt
