// SPDX-License-Identifier: Apache-2.0
#include "app/manual/option_table.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <string_view>

namespace nt {
namespace {

// CLI11 gives "N:INT in [1 - 16]", "on|off:{on,off}": the part before what it says about the check.
std::string value_of(const CLI::Option& option) {
  if (!option.get_option_text().empty()) return option.get_option_text();
  const std::string type = option.get_type_name();
  const std::size_t brace = type.find(":{"), check = type.find(" in [");
  if (brace != std::string::npos) return type.substr(0, brace);
  if (check != std::string::npos) return type.substr(0, type.rfind(':', check));
  return type;
}

std::vector<std::string> split(const std::string& text, char between) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(between, at), text.size());
    parts.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return parts;
}

// Words to be given as they stand are written in lower case, what stands for something else is not.
bool is_word(const std::string& text) {
  return !text.empty() && std::none_of(text.begin(), text.end(), [](unsigned char c) { return std::isupper(c) != 0; });
}

bool names_a_file(const std::string& value) {
  constexpr std::string_view kFiles[] = {"FILE", "VIDEO", "MESH", "PICTURE", "PREFIX", "FOLDER"};
  return std::any_of(std::begin(kFiles), std::end(kFiles),
                     [&](std::string_view name) { return value.find(name) != std::string::npos; });
}

OptionRow row_of(const CLI::Option& option) {
  OptionRow row;
  for (const std::string& name : option.get_snames()) row.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) row.names.push_back("--" + name);
  if (row.names.empty()) row.place = option.get_name(true);
  if (option.get_items_expected_max() > 0) row.value = value_of(option);
  for (const std::string& part : split(row.value, '|')) {
    if (is_word(part)) row.choices.push_back(part);
  }
  row.takes_camera = std::find(row.names.begin(), row.names.end(), "--camera") != row.names.end();
  row.takes_file = row.takes_camera || names_a_file(row.value);
  row.required = option.get_required();
  row.help = option.get_description();
  return row;
}

CommandRow command_of(const CLI::App& app, const std::string& name) {
  CommandRow row{name, app.get_description(), app.get_footer(), {}};
  for (const CLI::Option* option : app.get_options()) row.options.push_back(row_of(*option));
  return row;
}

}  // namespace

std::vector<CommandRow> option_table(const CLI::App& app) {
  std::vector<CommandRow> table = {command_of(app, "")};
  for (const CLI::App* command : app.get_subcommands({})) table.push_back(command_of(*command, command->get_name()));
  return table;
}

}  // namespace nt
