// SPDX-License-Identifier: Apache-2.0
// The frame loop with a display and a disk that are slow on purpose: capture must not notice.
#include "app/frame_loop/capture_loop.h"

#include <gtest/gtest.h>
#include <pthread.h>

#include <atomic>

#include "platform/linux/clock.h"

namespace nt {
namespace {

constexpr int64_t kMillisecond_ns = 1'000'000;
constexpr std::chrono::milliseconds kLook{10};

CaptureOptions tank(const std::string& more) {
  CaptureOptions options;
  options.camera = parse_camera_spec("sim:scene=turns,seed=1,size=320x180" + more);
  options.background = parse_background("vibe");
  return options;
}

const std::atomic<bool> never{false};

void nap(int64_t milliseconds) { sleep_until_ns(steady_now_ns() + milliseconds * kMillisecond_ns); }

TEST(CaptureLoop, GivesWhatOneThreadGives) {
  Session alone(tank(",frames=90")), session(tank(",frames=90"));
  std::vector<FishPose> poses;
  std::vector<std::size_t> outline;
  std::vector<uint64_t> hashes;
  CaptureLoop::Settings settings;
  settings.store.contours = settings.store.luma_hash = settings.store.picture = settings.store.truth = true;
  CaptureLoop loop(session, settings, {[&](const Observation& seen) {
                     poses.push_back(seen.pose());
                     outline.push_back(seen.of_target().contour.size());
                     hashes.push_back(seen.luma_hash);
                     EXPECT_NE(seen.picture.pixels, nullptr);
                     EXPECT_NE(seen.truth, nullptr);
                     if (seen.frame_index % 10 == 0) nap(5);  // a slow disk makes this pace wait
                   }});
  while (loop.wait(kLook)) {
  }
  loop.finish();
  ASSERT_EQ(poses.size(), 90u);
  for (std::size_t i = 0; alone.step(); ++i) {
    EXPECT_EQ(poses[i].status, alone.capture().pose().status) << i;
    EXPECT_EQ(poses[i].centre.x, alone.capture().pose().centre.x) << i;
    EXPECT_EQ(outline[i], alone.capture().contour().size()) << i;
    EXPECT_EQ(hashes[i], luma_hash(alone.frame().luma)) << i;
  }
  EXPECT_EQ(loop.not_stored(), 0);
}

// Stands still until capture has gone on by so many frames, or `over`. False when it does not go on: it is held up.
bool wait_for_frames(const CaptureLoop& loop, int64_t frames, const std::atomic<bool>& over) {
  const int64_t from = loop.frames(), give_up_ns = steady_now_ns() + 60'000 * kMillisecond_ns;
  while (!over && loop.running() && loop.frames() < from + frames) {
    if (steady_now_ns() > give_up_ns) return false;
    nap(1);
  }
  return true;
}

// The display looks once in some twenty frames, the disk stands still for a hundred.
TEST(CaptureLoop, ASlowDisplayAndAStandingDiskDoNotHoldCaptureUp) {
  Session session(tank(",fps=100"));  // without end
  CaptureLoop::Settings settings;
  settings.pace = Pace::clock;
  settings.has_display = true;
  settings.display.picture = settings.display.contours = settings.display.statistics = true;
  int64_t stored = 0;
  std::atomic<bool> disk_goes{false};
  CaptureLoop loop(session, settings, {[&](const Observation&) {
                     if (stored++ == 20) disk_goes.wait(false);
                   }});
  EXPECT_TRUE(wait_for_frames(loop, 21, never));
  int shown = 0;
  int64_t last = -1;
  while (loop.frames() < 121) {
    const int64_t newest = loop.frames() - 1;
    while (const Observation* seen = loop.next_seen()) {
      EXPECT_GT(seen->frame_index, last);
      EXPECT_EQ(seen->statistics->frames, seen->frame_index + 1);
      EXPECT_NE(seen->picture.pixels, nullptr);
      last = seen->frame_index;
      ++shown;
    }
    EXPECT_GE(last, newest) << "the newest observation was not among those that waited";
    ASSERT_TRUE(wait_for_frames(loop, 20, never)) << "the display or the disk holds capture up";
  }
  disk_goes = true;
  disk_goes.notify_all();
  loop.finish();
  EXPECT_EQ(stored, session.statistics().frames) << "a hundred frames fit into the ring";
  EXPECT_LT(shown, 40);
  EXPECT_GT(loop.not_shown(), 50);
}

// A disk that stands still for longer than its ring is deep loses frames, and says how many.
TEST(CaptureLoop, WhatAStandingDiskLosesIsCounted) {
  Session session(tank(",fps=500"));  // without end
  CaptureLoop::Settings settings;
  settings.pace = Pace::clock;
  int64_t stored = 0;
  std::atomic<bool> disk_goes{false};
  CaptureLoop loop(session, settings, {[&](const Observation&) {
                     if (stored++ == 0) disk_goes.wait(false);
                   }});
  EXPECT_TRUE(wait_for_frames(loop, 300, never));
  EXPECT_GT(loop.not_stored(), 20);
  disk_goes = true;
  disk_goes.notify_all();
  loop.finish();
  EXPECT_EQ(stored + loop.not_stored(), session.statistics().frames);
}

TEST(CaptureLoop, PicturesAreTheFirstThingASlowDiskLoses) {
  Session session(tank(",fps=200"));  // without end
  CaptureLoop::Settings settings;
  settings.pace = Pace::clock;
  settings.store.picture = true;
  int64_t stored = 0, pictures = 0;
  CaptureLoop* loop_seen = nullptr;
  std::atomic<bool> begun{false}, over{false};
  CaptureLoop loop(session, settings, {[&](const Observation& seen) {
                     begun.wait(false);
                     ++stored;
                     if (seen.picture.pixels == nullptr) return;
                     ++pictures;
                     EXPECT_TRUE(wait_for_frames(*loop_seen, 10, over));  // an encoder
                   }});
  loop_seen = &loop;
  begun = true;
  begun.notify_all();
  EXPECT_TRUE(wait_for_frames(loop, 150, never));
  over = true;
  loop.finish();
  EXPECT_EQ(stored, session.statistics().frames);
  EXPECT_EQ(pictures + loop.pictures_not_stored(), stored);
  EXPECT_GE(pictures, 4);
  EXPECT_LT(pictures, stored / 2);
}

TEST(CaptureLoop, TheStoreIsGivenPicturesOnlyWhileItWantsThem) {
  Session session(tank(",frames=200"));
  CaptureLoop::Settings settings;
  settings.store.picture = true;
  int64_t stored = 0, pictures = 0, at_change = 0;
  CaptureLoop* loop_seen = nullptr;
  std::atomic<bool> begun{false};
  CaptureLoop loop(session, settings, {[&](const Observation& seen) {
                     begun.wait(false);
                     pictures += seen.picture.pixels != nullptr;
                     if (++stored != 100) return;
                     at_change = pictures;
                     loop_seen->store_pictures(false);
                   }});
  loop_seen = &loop;
  begun = true;
  begun.notify_all();
  while (loop.wait(kLook)) {
  }
  loop.finish();
  EXPECT_EQ(at_change, 100);
  EXPECT_GE(pictures, 100);
  EXPECT_LE(pictures, 106) << "the ring holds four";
}

TEST(CaptureLoop, WhatStoringThrowsEndsItAndComesOut) {
  Session session(tank(""));  // without end
  bool ended = false;
  CaptureLoop loop(session, {},
                   {[](const Observation& seen) {
                      if (seen.frame_index == 5) throw UserError("the disk is full");
                    },
                    [&] { ended = true; }});
  while (loop.wait(kLook)) {
  }
  EXPECT_TRUE(ended);
  try {
    loop.finish();
    ADD_FAILURE() << "no error";
  } catch (const UserError& error) {
    EXPECT_STREQ(error.what(), "the disk is full");
  }
}

TEST(CaptureLoop, WhatIsAskedForIsDoneOnTheCoreThreadBetweenTwoFrames) {
  Session session(tank(",fps=100"));  // without end
  CaptureLoop::Settings settings;
  settings.pace = Pace::clock;
  CaptureLoop loop(session, settings, {[](const Observation&) {}});
  EXPECT_TRUE(wait_for_frames(loop, 30, never));
  const int64_t asked = loop.frames();
  std::atomic<int64_t> done{-1};
  char thread[32] = "";
  loop.ask([&](Session& of) {
    pthread_getname_np(pthread_self(), thread, sizeof thread);
    done = of.statistics().frames;
  });
  while (done < 0 && loop.wait(kLook)) {
  }
  loop.finish();
  EXPECT_GE(done, asked);
  EXPECT_LE(done, session.statistics().frames);
  EXPECT_STREQ(thread, "nt-core");
}

// By this a watchdog knows that the core thread lives, whether there is a picture or not.
TEST(CaptureLoop, ItsRoundsGoOnWhileNothingIsFilmed) {
  Session session(tank(",fps=100"));  // without end
  CaptureLoop::Settings settings;
  settings.pace = Pace::clock;
  CaptureLoop loop(session, settings, {[](const Observation&) {}});
  EXPECT_TRUE(wait_for_frames(loop, 3, never));
  loop.pause(true);
  const int64_t before = loop.rounds();
  for (int looks = 0; looks < 300 && loop.rounds() < before + 3; ++looks) std::this_thread::sleep_for(kLook);
  EXPECT_GE(loop.rounds(), before + 3);
  std::atomic<bool> hangs{false}, go{false};
  loop.ask([&](Session&) {
    hangs = true;
    hangs.notify_all();
    go.wait(false);
  });
  hangs.wait(false);
  const int64_t hung = loop.rounds();
  std::this_thread::sleep_for(30 * kLook);
  EXPECT_EQ(loop.rounds(), hung) << "a core thread that hangs is not seen";
  go = true;
  go.notify_all();
  loop.finish();
}

TEST(CaptureLoop, NoThreadAllocatesInStep) {
  Session session(tank(",frames=120"));
  CaptureLoop loop(session, {}, {[](const Observation&) {}});
  while (loop.wait(kLook)) {
  }
  loop.finish();
  EXPECT_EQ(session.statistics().allocations_after_frame_0, 0);
}

TEST(CaptureLoop, AProcessorThatIsNotThereIsOneLine) {
  Session session(tank(",frames=20"));
  CaptureLoop::Settings settings;
  parse_affinity("core=1000", settings.plan);
  CaptureLoop loop(session, settings, {[](const Observation&) {}});
  while (loop.wait(kLook)) {
  }
  try {
    loop.finish();
    ADD_FAILURE() << "no error";
  } catch (const UserError& error) {
    EXPECT_EQ(std::string(error.what()).find("--affinity core: this machine has none of these processors"), 0u)
        << error.what();
  }
}

}  // namespace
}  // namespace nt
