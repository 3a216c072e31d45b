// SPDX-License-Identifier: Apache-2.0
#include "platform/late_module.h"

#include <dlfcn.h>

#include <string>

#include "platform/camera.h"

namespace nt {

LateModule::LateModule(const char* file, const char* purpose)
    : file_(file), handle_(dlopen(file, RTLD_NOW | RTLD_LOCAL)) {
  if (handle_ == nullptr) {
    throw UserError(std::string("cannot load ") + file + ", " + purpose + "; install neontetra again (" + dlerror() +
                    ")");
  }
}

void* LateModule::function(const char* name) const {
  void* function = dlsym(handle_, name);
  if (function == nullptr) throw UserError(std::string(file_) + " is of another version; install neontetra again");
  return function;
}

}  // namespace nt
