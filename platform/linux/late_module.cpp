// SPDX-License-Identifier: Apache-2.0
#include "platform/late_module.h"

#include <dlfcn.h>

#include <string>

#include "platform/camera.h"

namespace nt {

namespace {

// dlopen says "NAME: cannot open shared object file": the module itself is gone, or a library of another package that it needs.
[[noreturn]] void cannot_load(const std::string& file, const char* purpose, const std::string& error) {
  const std::string name = error.substr(0, error.find(':'));
  const bool library = name != file && error.find("cannot open shared object file") != std::string::npos;
  throw UserError("cannot load " + file + ", " + purpose + ": " +
                  (library ? name + " is missing; apt-get install --fix-policy --install-recommends"
                           : error + "; install neontetra again"));
}

}  // namespace

LateModule::LateModule(const char* file, const char* purpose)
    : file_(file), handle_(dlopen(file, RTLD_NOW | RTLD_LOCAL)) {
  if (handle_ == nullptr) cannot_load(file, purpose, dlerror());
}

void* LateModule::function(const char* name) const {
  void* function = dlsym(handle_, name);
  if (function == nullptr) throw UserError(std::string(file_) + " is of another version; install neontetra again");
  return function;
}

}  // namespace nt
