// SPDX-License-Identifier: Apache-2.0
#include "app/check_outputs.h"

#include <filesystem>
#include <system_error>

#include "app/export/output_file.h"
#include "platform/camera.h"

namespace nt {
namespace {

bool is_file(const std::string& path) {
  std::error_code unused;
  return !path.empty() && path != "-" &&
         (!std::filesystem::exists(path, unused) || std::filesystem::is_regular_file(path, unused));
}

bool same_file(const std::string& a, const std::string& b) {
  if (!is_file(a) || !is_file(b)) return false;
  std::error_code unused;
  return std::filesystem::equivalent(a, b, unused) ||
         std::filesystem::weakly_canonical(a, unused) == std::filesystem::weakly_canonical(b, unused);
}

void expect_replaceable(const std::string& path) {
  std::error_code unused;
  if (path == "-" || !std::filesystem::exists(path, unused)) return;
  if (std::filesystem::is_directory(path, unused)) throw UserError(path + " is a folder; name a file in it", 2);
  if (path.ends_with(".take") || path.ends_with(".take.mkv"))
    throw UserError(path + ": exists; a take is never overwritten, choose another name");
}

}  // namespace

void check_outputs(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    expect_folder(outputs[i]);
    for (const std::string& input : inputs) {
      if (same_file(outputs[i], input))
        throw UserError(outputs[i] + " is read by this command and would be overwritten; give the output another name",
                        2);
    }
    expect_replaceable(outputs[i]);
    for (std::size_t k = 0; k < i; ++k) {
      if (same_file(outputs[i], outputs[k]))
        throw UserError(outputs[i] + " is named for two outputs; give each its own name", 2);
    }
  }
}

}  // namespace nt
