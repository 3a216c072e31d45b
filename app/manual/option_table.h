// SPDX-License-Identifier: Apache-2.0
// The command line as a table: what the man page and the shells' completions are written from.
//
// The commands as they register themselves (app/cli.h) -> names, values, choices and help of every option. There is no second
// list of options anywhere, so none can be out of date.
#pragma once
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace nt {

struct OptionRow {
  std::vector<std::string> names;  // "-c", "--camera"; none for what is given without a name
  std::string place;               // its name then: "input"
  std::string value;               // "WxH", "beside|behind|alone"; "" for a switch
  std::vector<std::string> choices;
  bool takes_file = false, takes_camera = false, required = false;
  std::string help;
};

struct CommandRow {
  std::string name, help, footer;  // the program itself has no name here
  std::vector<OptionRow> options;
};

// The program first, then its commands.
std::vector<CommandRow> option_table(const CLI::App& app);

}  // namespace nt
