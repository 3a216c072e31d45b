// SPDX-License-Identifier: Apache-2.0
// neontetra: film a fish, see a drawing swim. Exit codes: 0 done, 1 failed, 2 wrong usage, 3 no camera.
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "app/cli.h"
#include "app/session.h"
#include "platform/camera.h"

namespace {

int fail(const std::string& line, int exit_code) {
  std::fprintf(stderr, "neontetra: %s\n", line.substr(0, line.find('\n')).c_str());
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  // A closed pipe and a file-size limit come back as errors of the write, where they can be told to the user.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  nt::end_on_interrupt();
  try {
    nt::parse_command_line(argc, argv)();
    return 0;
  } catch (const nt::UserError& error) {
    return fail(error.what(), error.exit_code);
  } catch (const std::bad_alloc&) {
    return fail("not enough memory; try a smaller --work-size", 1);
  } catch (const std::exception& error) {
    return fail(std::string("unexpected: ") + error.what(), 1);
  }
}
