// SPDX-License-Identifier: Apache-2.0
#include "platform/codecs.h"

#include <dlfcn.h>

#include "platform/camera.h"

namespace nt {
namespace {

void* load() {
  // Found by the program's run path: beside it in the build, in the library folder once installed.
  void* module = dlopen("libneontetra_codecs.so", RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr) {
    throw UserError(std::string("cannot load libneontetra_codecs.so, which reads and writes videos and pictures; "
                                "install neontetra again (") +
                    dlerror() + ")");
  }
  return module;
}

}  // namespace

void* codecs_function(const char* name) {
  static void* const module = load();
  void* function = dlsym(module, name);
  if (function == nullptr) throw UserError("libneontetra_codecs.so is of another version; install neontetra again");
  return function;
}

const Codecs& codecs() {
  using Table = const Codecs* (*)();
  static const Codecs& table = *reinterpret_cast<Table>(codecs_function("neontetra_codecs"))();
  return table;
}

std::unique_ptr<FrameSource> open_frame_source(const std::string& path) { return codecs().open_frame_source(path); }

}  // namespace nt
