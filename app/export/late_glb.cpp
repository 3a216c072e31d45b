// SPDX-License-Identifier: Apache-2.0
// GLB files are written by tinygltf, which comes with libneontetra_codecs.so when the first one is asked for.
#include "app/export/skinned_model.h"
#include "platform/codecs.h"

namespace nt {

std::vector<uint8_t> glb_bytes(const SkinnedModel& model) {
  using Write = void (*)(const SkinnedModel&, std::vector<uint8_t>&);
  static const auto write = reinterpret_cast<Write>(codecs_function("neontetra_write_glb"));
  std::vector<uint8_t> bytes;
  write(model, bytes);
  return bytes;
}

}  // namespace nt
