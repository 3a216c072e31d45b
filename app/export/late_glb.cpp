// SPDX-License-Identifier: Apache-2.0
// GLB files are written by tinygltf, which comes with libneontetra_codecs.so when the first one is asked for.
#include "app/export/output_file.h"
#include "app/export/skinned_model.h"
#include "platform/camera.h"
#include "platform/codecs.h"

namespace nt {

std::vector<uint8_t> glb_bytes(const SkinnedModel& model) {
  using Write = void (*)(const SkinnedModel&, std::vector<uint8_t>&);
  static const auto write = reinterpret_cast<Write>(codecs_function("neontetra_write_glb"));
  std::vector<uint8_t> bytes;
  write(model, bytes);
  return bytes;
}

void write_model(const std::string& path, const SkinnedModel& model) {
  const std::vector<uint8_t> bytes = glb_bytes(model);
  OutputFile file(path);
  const bool complete = file.write_at(0, bytes);
  if (!file.close() || !complete) throw UserError(file.error_line() + "; the file is cut");
}

}  // namespace nt
