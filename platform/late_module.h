// SPDX-License-Identifier: Apache-2.0
// A shared library of Neontetra's own that is loaded when it is first needed: what it links costs memory only then.
//
// File name + C name -> the function. The library is found by the program's run path: beside it in the build, in the library
// folder once installed. Throws UserError, one line, where it is missing or of another version.
#pragma once

namespace nt {

class LateModule {
 public:
  // "libneontetra_codecs.so", "which reads and writes videos and pictures"
  LateModule(const char* file, const char* purpose);
  void* function(const char* name) const;

 private:
  const char* file_;
  void* handle_;
};

}  // namespace nt
