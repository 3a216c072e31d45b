// SPDX-License-Identifier: Apache-2.0
// A plugin for QEMU's user mode: what a program does between two marker instructions (marker.h), for each such interval.
//
// `qemu-aarch64 -plugin libcount_plugin.so,out=FILE PROGRAM`. Output: one line for each marker that was executed, about the
// interval that it ended: instructions; divisions and roots among them; bytes read; bytes written; how many distinct 64-byte
// lines were touched; how many lines came from memory, and how many went back there, past a cache of 512 KB, 16 ways, least
// recently used out first. The first interval is all that came before the first marker; the cache goes on from each to the next.
// 512 KB is half of the second-level cache of a Raspberry Pi 4, which all cores share, and all of a Raspberry Pi 5's.
// Divisions and roots, floating point or not, are known on aarch64 only. DC ZVA, which clears a line, is no access to QEMU: it
// is counted as a line touched that goes to memory. One thread.
#include <array>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "tests/bench/budget/marker.h"
#include "tests/bench/budget/qemu_plugin.h"

int qemu_plugin_version = 1;

namespace {

constexpr unsigned kLineShift = 6;

struct Interval {
  uint64_t instructions = 0, slow = 0, read_bytes = 0, written_bytes = 0, lines = 0, fetched = 0, written_back = 0;
};

// Which lines have been seen in this interval: a hash table whose entries grow old instead of being cleared.
class LineSet {
 public:
  // True the first time.
  bool add(uint64_t line) {
    if (2 * (count_ + 1) > slots_.size()) grow();
    Slot& slot = find(line);
    if (slot.age == age_) return false;
    slot = {line, age_};
    ++count_;
    return true;
  }
  void clear() { ++age_, count_ = 0; }

 private:
  struct Slot {
    uint64_t line = 0;
    uint32_t age = 0;
  };
  Slot& find(uint64_t line) {
    std::size_t at = (line * 0x9e3779b97f4a7c15ull >> 20) & (slots_.size() - 1);
    while (slots_[at].age == age_ && slots_[at].line != line) at = (at + 1) & (slots_.size() - 1);
    return slots_[at];
  }
  void grow() {
    std::vector<Slot> old(2 * slots_.size());
    old.swap(slots_);
    for (const Slot& slot : old)
      if (slot.age == age_) find(slot.line) = slot;
  }
  std::vector<Slot> slots_ = std::vector<Slot>(1u << 16);
  uint32_t age_ = 1;
  std::size_t count_ = 0;
};

class Cache {
 public:
  struct Traffic {
    bool fetched = false, written_back = false;
  };
  Traffic access(uint64_t line, bool store) {
    std::array<Way, kWays>& set = sets_[line % kSets];
    ++time_;
    Way* oldest = set.data();
    for (Way& way : set) {
      if (way.used != 0 && way.line == line) {
        way.used = time_, way.dirty = way.dirty || store;
        return {};
      }
      if (way.used < oldest->used) oldest = &way;
    }
    const Traffic traffic{true, oldest->used != 0 && oldest->dirty};
    *oldest = {line, time_, store};
    return traffic;
  }

 private:
  static constexpr std::size_t kWays = 16, kSets = 512 * 1024 / 64 / kWays;
  struct Way {
    uint64_t line = 0, used = 0;  // used: when last; 0: empty
    bool dirty = false;
  };
  std::array<std::array<Way, kWays>, kSets> sets_{};
  uint64_t time_ = 0;
};

Interval now;
std::vector<Interval> ended;
LineSet touched;
Cache cache;
std::string output;
bool arm = false;

void touch(uint64_t line, bool store) {
  now.lines += touched.add(line);
  const Cache::Traffic traffic = cache.access(line, store);
  now.fetched += traffic.fetched, now.written_back += traffic.written_back;
}

void accessed(unsigned, uint32_t info, uint64_t address, void*) {
  const uint64_t bytes = uint64_t{1} << qemu_plugin_mem_size_shift(info);
  const bool store = qemu_plugin_mem_is_store(info);
  (store ? now.written_bytes : now.read_bytes) += bytes;
  const uint64_t first = address >> kLineShift, last = (address + bytes - 1) >> kLineShift;
  touch(first, store);
  if (last != first) touch(last, store);
}

void marked(unsigned, void*) {
  ended.push_back(now);
  now = {};
  touched.clear();
}

void line_cleared(unsigned, void*) {
  now.written_bytes += 1u << kLineShift;
  ++now.lines, ++now.written_back;
}

uint32_t arm_code(const void* data) {
  uint32_t code = 0;
  std::memcpy(&code, data, sizeof code);
  return code;
}
bool clears_line(uint32_t code) { return (code & 0xffffffe0u) == 0xd50b7420u; }

// SDIV and UDIV; FDIV and FSQRT of a number and of a vector.
bool is_slow(uint32_t code) {
  return (code & 0x7fe0f800u) == 0x1ac00800u || (code & 0xff20fc00u) == 0x1e201800u ||
         (code & 0xff3ffc00u) == 0x1e21c000u || (code & 0xbfa0fc00u) == 0x2e20fc00u ||
         (code & 0xbfbffc00u) == 0x2ea1f800u;
}

void translated(uint64_t, qemu_plugin_tb* tb) {
  for (std::size_t i = 0; i < qemu_plugin_tb_n_insns(tb); ++i) {
    qemu_plugin_insn* insn = qemu_plugin_tb_get_insn(tb, i);
    const void* data = qemu_plugin_insn_data(insn);
    if (nt::budget::is_marker(data, qemu_plugin_insn_size(insn))) {
      qemu_plugin_register_vcpu_insn_exec_cb(insn, marked, QEMU_PLUGIN_CB_NO_REGS, nullptr);
      continue;
    }
    qemu_plugin_register_vcpu_insn_exec_inline(insn, QEMU_PLUGIN_INLINE_ADD_U64, &now.instructions, 1);
    qemu_plugin_register_vcpu_mem_cb(insn, accessed, QEMU_PLUGIN_CB_NO_REGS, QEMU_PLUGIN_MEM_RW, nullptr);
    if (!arm) continue;
    if (is_slow(arm_code(data)))
      qemu_plugin_register_vcpu_insn_exec_inline(insn, QEMU_PLUGIN_INLINE_ADD_U64, &now.slow, 1);
    if (clears_line(arm_code(data)))
      qemu_plugin_register_vcpu_insn_exec_cb(insn, line_cleared, QEMU_PLUGIN_CB_NO_REGS, nullptr);
  }
}

void at_exit(uint64_t, void*) {
  std::FILE* file = std::fopen(output.c_str(), "w");
  if (file == nullptr) return;  // whoever reads it says that it is not there
  for (const Interval& i : ended) {
    std::fprintf(file, "%llu %llu %llu %llu %llu %llu %llu\n", static_cast<unsigned long long>(i.instructions),
                 static_cast<unsigned long long>(i.slow), static_cast<unsigned long long>(i.read_bytes),
                 static_cast<unsigned long long>(i.written_bytes), static_cast<unsigned long long>(i.lines),
                 static_cast<unsigned long long>(i.fetched), static_cast<unsigned long long>(i.written_back));
  }
  std::fclose(file);
}

}  // namespace

int qemu_plugin_install(uint64_t id, const qemu_info_t* info, int argc, char** argv) {
  constexpr char kOut[] = "out=";
  if (argc != 1 || std::strncmp(argv[0], kOut, sizeof kOut - 1) != 0) {
    std::fprintf(stderr, "count_plugin: say where to write: -plugin libcount_plugin.so,out=FILE\n");
    return 1;
  }
  output = argv[0] + sizeof kOut - 1;
  arm = std::strcmp(info->target_name, "aarch64") == 0;
  qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
  qemu_plugin_register_atexit_cb(id, at_exit, nullptr);
  return 0;
}
