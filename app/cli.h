// SPDX-License-Identifier: Apache-2.0
// The command line: arguments -> the command to run.
//
// Each command registers itself (app/commands/) and hands back what to do. Mistakes throw UserError with exit code 2 and
// name the nearest valid option or command.
#pragma once
#include <functional>

namespace CLI {
class App;
}

namespace nt {

using Action = std::function<void()>;

// The action that the arguments ask for; for --help and --version the action prints them.
Action parse_command_line(int argc, const char* const* argv);

// One a file in app/commands/. `action` is set when the command is the one that was given.
void add_live(CLI::App& app, Action& action);
void add_capture(CLI::App& app, Action& action);
void add_animate(CLI::App& app, Action& action);
void add_takes(CLI::App& app, Action& action);
void add_edit(CLI::App& app, Action& action);
void add_export(CLI::App& app, Action& action);
void add_play(CLI::App& app, Action& action);
void add_character(CLI::App& app, Action& action);
void add_markers(CLI::App& app, Action& action);
void add_bench(CLI::App& app, Action& action);
void add_doctor(CLI::App& app, Action& action);

}  // namespace nt
