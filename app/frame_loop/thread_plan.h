// SPDX-License-Identifier: Apache-2.0
// Which processors the threads of the frame loop run on, and how urgent each is: --affinity and --priority.
//
// A thread is named after its task (`nt-core` in top -H and ps). Without the options the system decides.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace nt {

enum class LoopThread : uint8_t { camera, core, display, store };
inline constexpr std::size_t kLoopThreads = 4;
const char* to_string(LoopThread thread);

struct ThreadPlace {
  std::vector<int> cpus;  // empty: any
  int priority = 0;       // 1 to 99: real-time, first in, first out (SCHED_FIFO); 0: as all others
};
using ThreadPlan = std::array<ThreadPlace, kLoopThreads>;  // by LoopThread

// "core=2-3" and "core=50". Throw UserError (exit code 2) with what can be written.
void parse_affinity(const std::string& text, ThreadPlan& plan);
void parse_priority(const std::string& text, ThreadPlan& plan);
// `draws`: the command has a display thread that can be placed.
void add_thread_options(CLI::App& command, ThreadPlan& plan, bool draws);

// Names the calling thread and puts it where the plan has it. Throws UserError where the machine has no such processor or
// the user may not ask for the priority.
void take_place(const ThreadPlan& plan, LoopThread thread);

}  // namespace nt
