// SPDX-License-Identifier: Apache-2.0
// A disk of a few kilobytes over a folder, seen by this process alone: for a forked child that fills it up.
#pragma once
#include <sched.h>
#include <sys/mount.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <string>

#include "tests/support/temp_dir.h"

namespace nt {

inline constexpr int kMayNotMount = 77;  // the child's exit code where this user may not mount

inline void mount_small_disk(const std::string& folder, uint64_t bytes) {
  const std::string options = "size=" + std::to_string(bytes);
  const std::string user = "0 " + std::to_string(geteuid()) + " 1", group = "0 " + std::to_string(getegid()) + " 1";
  const bool own = unshare(CLONE_NEWUSER | CLONE_NEWNS) == 0;
  write_text("/proc/self/setgroups", "deny");
  write_text("/proc/self/uid_map", user);
  write_text("/proc/self/gid_map", group);
  if (!own || mount("tmpfs", folder.c_str(), "tmpfs", 0, options.c_str()) != 0) {
    std::_Exit(kMayNotMount);
  }
}

// "Free some space": the same disk, larger.
inline bool enlarge_small_disk(const std::string& folder, uint64_t bytes) {
  const std::string options = "size=" + std::to_string(bytes);
  return mount("tmpfs", folder.c_str(), "tmpfs", MS_REMOUNT, options.c_str()) == 0;
}

}  // namespace nt
