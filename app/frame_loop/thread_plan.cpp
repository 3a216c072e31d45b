// SPDX-License-Identifier: Apache-2.0
#include "app/frame_loop/thread_plan.h"

#include <pthread.h>
#include <sched.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <sstream>

#include "app/numbers.h"
#include "platform/camera.h"

namespace nt {
namespace {

constexpr const char* kNames[kLoopThreads] = {"camera", "core", "display", "store"};
constexpr int kMostPriority = 99;

// "core=..." -> the place of core; `value` is what follows.
ThreadPlace& place_of(const char* option, const std::string& text, ThreadPlan& plan, std::string& value) {
  const std::size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  for (std::size_t i = 0; i < kLoopThreads; ++i) {
    if (equals == std::string::npos || name != kNames[i]) continue;
    value = text.substr(equals + 1);
    return plan[i];
  }
  throw UserError(
      std::string(option) + ": '" + text + "' names no thread (THREAD=..., with camera, core, display, store)", 2);
}

}  // namespace

const char* to_string(LoopThread thread) { return kNames[static_cast<std::size_t>(thread)]; }

void parse_affinity(const std::string& text, ThreadPlan& plan) {
  std::string value;
  ThreadPlace& place = place_of("--affinity", text, plan, value);
  place.cpus.clear();
  std::istringstream parts(value);
  for (std::string part; std::getline(parts, part, ',');) {
    const std::size_t dash = part.find('-');
    const auto cpu = [](const std::string& number) {
      return static_cast<int>(parse_integer("--affinity", number, 0, CPU_SETSIZE - 1));
    };
    const int first = cpu(part.substr(0, dash)), last = dash == std::string::npos ? first : cpu(part.substr(dash + 1));
    for (int i = first; i <= last; ++i) place.cpus.push_back(i);
  }
  if (place.cpus.empty())
    throw UserError("--affinity: '" + text + "' names no processor; write for example core=3 or camera=0-1", 2);
}

void parse_priority(const std::string& text, ThreadPlan& plan) {
  std::string value;
  ThreadPlace& place = place_of("--priority", text, plan, value);
  place.priority = static_cast<int>(parse_integer("--priority", value, 1, kMostPriority));
}

void add_thread_options(CLI::App& command, ThreadPlan& plan, bool draws) {
  const std::string names = draws ? "camera, core, display, store" : "camera, core, store";
  const auto add = [&](const char* option, void (*parse)(const std::string&, ThreadPlan&), const std::string& what,
                       const char* value) {
    command
        .add_option_function<std::vector<std::string>>(
            option,
            [&plan, draws, parse, option](const std::vector<std::string>& words) {
              for (const std::string& word : words) {
                if (!draws && word.starts_with("display="))
                  throw UserError(std::string(option) + ": '" + word + "': this command has no display thread", 2);
                parse(word, plan);
              }
            },
            what)
        ->type_name(value)
        ->allow_extra_args(false);
  };
  add("--affinity", parse_affinity,
      "the processors of a thread (" + names + "): core=3, camera=0-1; may be given several times", "THREAD=CPUS");
  add("--priority", parse_priority,
      "real-time priority of a thread (" + names + "), 1 to 99: core=50; it needs the right to (ulimit -r)",
      "THREAD=N");
}

void take_place(const ThreadPlan& plan, LoopThread thread) {
  const ThreadPlace& place = plan[static_cast<std::size_t>(thread)];
  const std::string name = to_string(thread);
  // The first thread keeps the program's own name, by which it is found.
  if (thread != LoopThread::display) pthread_setname_np(pthread_self(), ("nt-" + name).c_str());
  if (!place.cpus.empty()) {
    cpu_set_t set;
    CPU_ZERO(&set);
    for (const int cpu : place.cpus) CPU_SET(static_cast<std::size_t>(cpu), &set);
    if (pthread_setaffinity_np(pthread_self(), sizeof set, &set) != 0)
      throw UserError("--affinity " + name + ": this machine has none of these processors for us; see nproc", 2);
  }
  if (place.priority > 0) {
    sched_param wanted{};
    wanted.sched_priority = place.priority;
    // It is this thread's alone: what it starts, an encoder for example, is as all others.
    if (sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &wanted) != 0)
      throw UserError("--priority " + name + "=" + std::to_string(place.priority) +
                      (errno == EPERM
                           ? ": not allowed; raise the limit (ulimit -r, LimitRTPRIO= of a unit) or leave it out"
                           : ": the system refuses it"));
  }
}

}  // namespace nt
