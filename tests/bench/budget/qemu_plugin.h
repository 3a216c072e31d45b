// SPDX-License-Identifier: Apache-2.0
// What count_plugin calls of QEMU's plugin interface, version 1 (QEMU 6.0 to 8.2; Debian 12 has 7.2), which Debian ships
// no header for. Names and signatures are those of the interface's documentation.
#pragma once
#include <cstddef>
#include <cstdint>

extern "C" {

struct qemu_plugin_tb;    // a block of code that is being translated
struct qemu_plugin_insn;  // an instruction of it
struct qemu_info_t {
  const char* target_name;
  struct {
    int min, cur;
  } version;
  // What follows is not looked at.
};

enum qemu_plugin_cb_flags { QEMU_PLUGIN_CB_NO_REGS };
enum qemu_plugin_mem_rw { QEMU_PLUGIN_MEM_RW = 3 };
enum qemu_plugin_op { QEMU_PLUGIN_INLINE_ADD_U64 };

// What a plugin gives.
__attribute__((visibility("default"))) extern int qemu_plugin_version;
__attribute__((visibility("default"))) int qemu_plugin_install(uint64_t id, const qemu_info_t* info, int argc,
                                                               char** argv);

// What it calls.
void qemu_plugin_register_vcpu_tb_trans_cb(uint64_t id, void (*translated)(uint64_t id, qemu_plugin_tb* tb));
void qemu_plugin_register_atexit_cb(uint64_t id, void (*at_exit)(uint64_t id, void* data), void* data);
std::size_t qemu_plugin_tb_n_insns(const qemu_plugin_tb* tb);
qemu_plugin_insn* qemu_plugin_tb_get_insn(const qemu_plugin_tb* tb, std::size_t index);
const void* qemu_plugin_insn_data(const qemu_plugin_insn* insn);
std::size_t qemu_plugin_insn_size(const qemu_plugin_insn* insn);
void qemu_plugin_register_vcpu_insn_exec_cb(qemu_plugin_insn* insn, void (*executed)(unsigned vcpu, void* data),
                                            qemu_plugin_cb_flags flags, void* data);
void qemu_plugin_register_vcpu_insn_exec_inline(qemu_plugin_insn* insn, qemu_plugin_op op, void* counter, uint64_t by);
void qemu_plugin_register_vcpu_mem_cb(qemu_plugin_insn* insn,
                                      void (*accessed)(unsigned vcpu, uint32_t info, uint64_t address, void* data),
                                      qemu_plugin_cb_flags flags, qemu_plugin_mem_rw rw, void* data);
unsigned qemu_plugin_mem_size_shift(uint32_t info);
bool qemu_plugin_mem_is_store(uint32_t info);
}
