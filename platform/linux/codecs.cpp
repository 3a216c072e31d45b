// SPDX-License-Identifier: Apache-2.0
#include "platform/codecs.h"

#include <dlfcn.h>

#include "platform/camera.h"

namespace nt {
namespace {

const Codecs& load() {
  // Found by the program's run path: beside it in the build, in the library folder once installed.
  void* module = dlopen("libneontetra_codecs.so", RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr) {
    throw UserError(std::string("cannot load libneontetra_codecs.so, which reads and writes videos and pictures; "
                                "install neontetra again (") +
                    dlerror() + ")");
  }
  using Table = const Codecs* (*)();
  const auto table = reinterpret_cast<Table>(dlsym(module, "neontetra_codecs"));
  if (table == nullptr) throw UserError("libneontetra_codecs.so is of another version; install neontetra again");
  return *table();
}

}  // namespace

const Codecs& codecs() {
  static const Codecs& table = load();
  return table;
}

std::unique_ptr<FrameSource> open_frame_source(const std::string& path) { return codecs().open_frame_source(path); }

}  // namespace nt
