// SPDX-License-Identifier: Apache-2.0
#include "app/frame_loop/thread_plan.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <thread>

#include "platform/camera.h"
#include "tests/app/run_binary.h"

namespace nt {
namespace {

const ThreadPlace& of(const ThreadPlan& plan, LoopThread thread) { return plan[static_cast<std::size_t>(thread)]; }

TEST(ThreadPlan, ReadsProcessorsAndPriorities) {
  ThreadPlan plan{};
  parse_affinity("core=3", plan);
  parse_affinity("camera=0-1,5", plan);
  parse_priority("core=50", plan);
  EXPECT_EQ(of(plan, LoopThread::core).cpus, std::vector<int>{3});
  EXPECT_EQ(of(plan, LoopThread::camera).cpus, (std::vector<int>{0, 1, 5}));
  EXPECT_TRUE(of(plan, LoopThread::store).cpus.empty());
  EXPECT_EQ(of(plan, LoopThread::core).priority, 50);
}

TEST(ThreadPlan, RefusesWhatItCannotRead) {
  ThreadPlan plan{};
  for (const char* text :
       {"", "core", "core=", "core=x", "core=-1", "core=2-1", "brain=1", "core=1-", "core=99999999999"})
    EXPECT_THROW(parse_affinity(text, plan), UserError) << text;
  for (const char* text : {"", "core", "core=0", "core=100", "core=high", "tail=3"})
    EXPECT_THROW(parse_priority(text, plan), UserError) << text;
  const Outcome run = neontetra("capture -c sim:frames=1 --affinity display=0");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("this command has no display thread"), std::string::npos) << run.err;
}

TEST(ThreadPlan, AThreadGoesToItsProcessorUnderItsName) {
  cpu_set_t ours;
  sched_getaffinity(0, sizeof ours, &ours);
  int last = 0;
  for (int i = 0; i < CPU_SETSIZE; ++i)
    if (CPU_ISSET(static_cast<std::size_t>(i), &ours)) last = i;
  ThreadPlan plan{};
  parse_affinity("store=" + std::to_string(last), plan);
  std::thread([&] {
    take_place(plan, LoopThread::store);
    cpu_set_t set;
    pthread_getaffinity_np(pthread_self(), sizeof set, &set);
    EXPECT_EQ(CPU_COUNT(&set), 1);
    EXPECT_TRUE(CPU_ISSET(static_cast<std::size_t>(last), &set));
    char name[32];
    pthread_getname_np(pthread_self(), name, sizeof name);
    EXPECT_STREQ(name, "nt-store");
  }).join();
}

// Whether it may be had depends on the user; either it is so afterwards or there is one line.
TEST(ThreadPlan, ARealTimePriorityIsTakenOrRefusedInOneLine) {
  ThreadPlan plan{};
  parse_priority("core=7", plan);
  std::thread([&] {
    try {
      take_place(plan, LoopThread::core);
      sched_param now{};
      sched_getparam(0, &now);
      EXPECT_EQ(sched_getscheduler(0) & ~SCHED_RESET_ON_FORK, SCHED_FIFO);
      EXPECT_EQ(now.sched_priority, 7);
      std::thread([] { EXPECT_EQ(sched_getscheduler(0), SCHED_OTHER) << "what it starts is as urgent"; }).join();
    } catch (const UserError& error) {
      EXPECT_NE(std::string(error.what()).find("--priority core=7: not allowed; raise the limit"), std::string::npos)
          << error.what();
    }
  }).join();
}

}  // namespace
}  // namespace nt
