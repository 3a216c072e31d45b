// SPDX-License-Identifier: Apache-2.0
// troff with the macros of man(7).
#include <CLI/CLI.hpp>
#include <algorithm>

#include "app/manual/manual.h"

namespace nt {
namespace {

// Hyphens that are typed, and nothing that troff would take for its own.
std::string text(const std::string& plain) {
  std::string out;
  for (const char c : plain) {
    if (c == '\\') out += "\\e";
    else if (c == '-') out += "\\-";
    else if (c == '\'') out += "\\(aq";
    else if (c == '`') out += "\\(ga";
    else if (c == '^') out += "\\(ha";
    else if (c == '~') out += "\\(ti";
    else if (c == '[') out += "\\:[";  // a long word may be broken here
    else if (c == '\n') out += "\n.br\n";
    else out += c;
    if (out.size() == 1 && c == '.') out = "\\&.";
  }
  return out;
}

std::string bold(const std::string& plain) { return "\\fB" + text(plain) + "\\fR"; }
std::string slanted(const std::string& plain) { return "\\fI" + text(plain) + "\\fR"; }

std::string head(const OptionRow& option) {
  std::string line;
  for (const std::string& name : option.names) line += (line.empty() ? "" : ", ") + bold(name);
  if (line.empty()) return slanted(option.place);
  return option.value.empty() ? line : line + " " + slanted(option.value);
}

std::string options(const CommandRow& command) {
  std::string page;
  for (const OptionRow& option : command.options) {
    page += ".TP\n" + head(option) + "\n" + text(option.help) + (option.required ? " (required)" : "") + "\n";
  }
  return page;
}

std::string use(const CommandRow& command) {
  std::string line = bold("neontetra " + command.name) + " [" + slanted("OPTIONS") + "]";
  for (const OptionRow& option : command.options) {
    if (option.names.empty()) line += " " + slanted(option.place);
  }
  return line + "\n";
}

constexpr const char* kEnd = R"(.SH EXIT STATUS
0 done, 1 failed, 2 wrong usage, 3 no camera. Every failure is one line on standard error: what, where, what to do.
.SH FILES
.TP
.I /usr/share/neontetra/characters
characters to begin with
.TP
.I /etc/default/neontetra
.B NEONTETRA_OPTIONS
of the service
.BR neontetra\-kiosk ,
which shows a camera's fish on a screen without a desktop;
.I /usr/share/doc/neontetra/examples/kiosk.env
is an example
)";

}  // namespace

std::string man_page(const std::vector<CommandRow>& table) {
  const CommandRow& program = table.front();
  std::string page = ".\\\" SPDX-License-Identifier: Apache-2.0\n.TH NEONTETRA 1 \"\" \"neontetra " NEONTETRA_VERSION
                     "\"\n.ad l\n.nh\n.SH NAME\nneontetra \\- film a fish, see a drawing swim\n.SH SYNOPSIS\n";
  for (std::size_t i = 1; i < table.size(); ++i) page += (i > 1 ? ".br\n" : "") + use(table[i]);
  page +=
      ".SH DESCRIPTION\n" +
      text(
          "Point a camera at an aquarium from above and a drawing swims like the fish in it: live, as a video, or as "
          "poses in a file.") +
      "\n.SH OPTIONS\n" + options(program) + ".SH COMMANDS\n";
  for (std::size_t i = 1; i < table.size(); ++i) {
    page += ".SS " + text(table[i].name) + "\n" + text(table[i].help) + ".\n" + options(table[i]);
    if (!table[i].footer.empty()) page += ".PP\n" + text(table[i].footer) + "\n";
  }
  return page + kEnd;
}

}  // namespace nt
