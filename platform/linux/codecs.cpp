// SPDX-License-Identifier: Apache-2.0
#include "platform/codecs.h"

#include "platform/late_module.h"

namespace nt {

void* codecs_function(const char* name) {
  static const LateModule module("libneontetra_codecs.so", "which reads and writes videos and pictures");
  return module.function(name);
}

const Codecs& codecs() {
  using Table = const Codecs* (*)();
  static const Codecs& table = *reinterpret_cast<Table>(codecs_function("neontetra_codecs"))();
  return table;
}

std::unique_ptr<FrameSource> open_frame_source(const std::string& path) { return codecs().open_frame_source(path); }

}  // namespace nt
