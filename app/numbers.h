// SPDX-License-Identifier: Apache-2.0
// Numbers and sizes typed by a user. Each throws UserError (exit code 2) that says what is allowed.
// `what` names the value in the message: "--work-size", "sim: fps".
#pragma once
#include <cstdint>
#include <string>

namespace nt {

int64_t parse_integer(const std::string& what, const std::string& text, int64_t least, int64_t most);
double parse_number(const std::string& what, const std::string& text, double least, double most);

struct Size {
  int width = 0, height = 0;
};
Size parse_size(const std::string& what, const std::string& text);  // "960x544"

}  // namespace nt
