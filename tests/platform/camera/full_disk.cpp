// SPDX-License-Identifier: Apache-2.0
#include "tests/platform/camera/full_disk.h"

#include <sqlite3.h>

#include <atomic>

namespace nt::test {
namespace {

sqlite3_vfs* system_files = nullptr;
sqlite3_vfs limited_files;
std::atomic<int64_t> bytes_left{0};

// The system's methods but for one; those of a database's own file, which is locked, and those of the files beside it.
template <int kind>
struct Limited {
  static inline const sqlite3_io_methods* system = nullptr;
  static inline sqlite3_io_methods methods{};
  static int write(sqlite3_file* file, const void* bytes, int count, sqlite3_int64 offset) {
    if ((bytes_left -= count) < 0) return SQLITE_FULL;
    return system->xWrite(file, bytes, count, offset);
  }
  static void take_over(sqlite3_file* file) {
    system = file->pMethods;
    methods = *system;
    methods.xWrite = write;
    file->pMethods = &methods;
  }
};

int open_limited(sqlite3_vfs*, const char* name, sqlite3_file* file, int flags, int* flags_out) {
  const int code = system_files->xOpen(system_files, name, file, flags, flags_out);
  if (code != SQLITE_OK || file->pMethods == nullptr) return code;
  if ((flags & SQLITE_OPEN_MAIN_DB) != 0) Limited<0>::take_over(file);
  else Limited<1>::take_over(file);
  return SQLITE_OK;
}

}  // namespace

FullDisk::FullDisk(int64_t bytes) {
  sqlite3_initialize();
  system_files = sqlite3_vfs_find(nullptr);
  limited_files = *system_files;
  limited_files.zName = "full disk";
  limited_files.xOpen = open_limited;
  bytes_left = bytes;
  sqlite3_vfs_register(&limited_files, 1);
}

FullDisk::~FullDisk() {
  sqlite3_vfs_unregister(&limited_files);
  sqlite3_vfs_register(system_files, 1);
}

}  // namespace nt::test
