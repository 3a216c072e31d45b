// SPDX-License-Identifier: Apache-2.0
#include "app/cli.h"

#include <CLI/CLI.hpp>

#include "app/camera_list.h"
#include "app/manual/manual.h"
#include "app/nearest_name.h"
#include "app/text_file.h"
#include "platform/camera.h"

namespace nt {
namespace {

constexpr const char* kFooter =
    "Examples:\n"
    "  neontetra animate -c sim:frames=300 --character assets/characters/carp.png --out swim.mp4\n"
    "  neontetra live -c tank.mp4 --character carp.ntchar\n"
    "'neontetra COMMAND --help' explains each command.\n"
    "Exit codes: 0 done, 1 failed, 2 wrong usage, 3 no camera.";

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* sub : app.get_subcommands({})) names.push_back(sub->get_name());
  return names;
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

// CLI11 reports a missing command and a mistyped one alike, so the first word is looked at beforehand.
void check_command(const CLI::App& app, int argc, const char* const* argv) {
  const std::vector<std::string> names = command_names(app);
  if (argc < 2) throw UserError("say what to do: " + joined(names) + " ('neontetra --help' explains them)", 2);
  const std::string first = argv[1];
  if (first.starts_with("-")) return;
  if (std::find(names.begin(), names.end(), first) != names.end()) return;
  throw UserError("unknown command '" + first + "'; did you mean '" + nearest_name(first, names) +
                      "'? (there are: " + joined(names) + ")",
                  2);
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

// One line for a mistake in the options of `command`.
std::string explain(const CLI::App& command, const CLI::ParseError& error) {
  const std::string name = command.get_parent() != nullptr ? command.get_name() + ": " : "";
  for (const std::string& word : command.remaining()) {
    if (!word.starts_with("-")) return name + "'" + word + "' is not expected here";
    const std::string option = word.substr(0, word.find('='));
    const std::string nearest = nearest_name(option, option_names(command));
    if (edit_distance(option, nearest) <= 2)
      return name + "unknown option " + option + "; did you mean " + nearest + "?";
    return name + "unknown option " + option + " (there are: " + joined(option_names(command)) + ")";
  }
  return name + first_line(error.what()) + " ('neontetra " + command.get_name() + " --help' explains it)";
}

}  // namespace

Action parse_command_line(int argc, const char* const* argv) {
  CLI::App app("Film a fish, see a drawing swim.", "neontetra");
  app.set_version_flag("--version", "neontetra " NEONTETRA_VERSION);
  app.require_subcommand(1);
  app.footer(kFooter);
  add_list_cameras(app);
  add_manual_options(app);
  Action action;
  for (const auto add : {add_live, add_capture, add_animate, add_takes, add_edit, add_play, add_export, add_character,
                         add_markers, add_bench, add_doctor})
    add(app, action);
  check_command(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const ListCameras&) {
    return [] { write_text("-", camera_list_text()); };
  } catch (const WriteManual& wanted) {
    return [text = manual(app, wanted.kind)] { write_text("-", text); };
  } catch (const CLI::CallForVersion& version) {
    return [text = std::string(version.what()) + "\n"] { write_text("-", text); };
  } catch (const CLI::CallForHelp&) {
    return [text = app.help()] { write_text("-", text); };
  } catch (const CLI::ParseError& error) {
    const std::vector<CLI::App*> given = app.get_subcommands();
    throw UserError(explain(given.empty() ? app : *given.front(), error), 2);
  }
  return action;
}

}  // namespace nt
