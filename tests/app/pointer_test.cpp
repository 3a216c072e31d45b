// SPDX-License-Identifier: Apache-2.0
#include "app/ui/pointer.h"

#include <gtest/gtest.h>

#include <string>

namespace nt {
namespace {

using Kind = PointerEvent::Kind;

PointerEvent mouse(Kind kind, float x) { return {kind, {x, 1}, false, 0}; }
PointerEvent finger(Kind kind, float x, int64_t id = 7) { return {kind, {x, 1}, true, id}; }

// Frames until nothing waits: "10 " the pointer at 10, "10* " pressed there, "- " no pointer.
std::string frames(PointerQueue& queue) {
  std::string out;
  while (queue.waiting()) {
    const PointerState s = queue.next();
    out += s.over ? std::to_string(static_cast<int>(s.at.x)) + (s.down ? "* " : " ") : "- ";
  }
  return out;
}

TEST(PointerQueue, AFingerIsPutPressedReleasedAndTakenAwayAFrameEach) {
  PointerQueue queue;
  queue.push(finger(Kind::press, 10));
  queue.push(finger(Kind::release, 10));
  EXPECT_EQ(frames(queue), "10 10* 10 - ");
  EXPECT_FALSE(queue.next().over);  // and stays away
}

TEST(PointerQueue, ADraggedFingerIsSeenWhereItIsAndMovesAreJoined) {
  PointerQueue queue;
  queue.push(finger(Kind::press, 10));
  for (const float x : {11.f, 12.f, 13.f}) queue.push(finger(Kind::move, x));
  EXPECT_EQ(frames(queue), "10 10* 13* ");
  queue.push(finger(Kind::move, 20));
  queue.push(finger(Kind::move, 30));
  queue.push(finger(Kind::release, 31));
  EXPECT_EQ(frames(queue), "30* 31 - ");
}

TEST(PointerQueue, AClickBetweenTwoFramesIsTwoFrames) {
  PointerQueue queue;
  queue.push(mouse(Kind::move, 5));
  queue.push(mouse(Kind::press, 5));
  queue.push(mouse(Kind::release, 5));
  queue.push(mouse(Kind::press, 5));
  queue.push(mouse(Kind::release, 5));
  EXPECT_EQ(frames(queue), "5 5* 5 5* 5 ");
  EXPECT_TRUE(queue.next().over);  // the mouse is still there
}

TEST(PointerQueue, AMoveNeverEatsTheFrameOfAPress) {
  PointerQueue queue;
  queue.push(mouse(Kind::press, 5));
  queue.push(mouse(Kind::move, 9));
  queue.push(mouse(Kind::move, 10));
  queue.push(mouse(Kind::release, 10));
  queue.push(mouse(Kind::move, 50));
  EXPECT_EQ(frames(queue), "5* 10* 10 50 ");
}

TEST(PointerQueue, OtherFingersAndTheMouseWait) {
  PointerQueue queue;
  queue.push(finger(Kind::press, 10, 1));
  queue.push(finger(Kind::press, 90, 2));
  queue.push(finger(Kind::move, 95, 2));
  queue.push(mouse(Kind::move, 70));
  queue.push(finger(Kind::move, 12, 1));
  queue.push(finger(Kind::release, 95, 2));
  queue.push(finger(Kind::release, 12, 1));
  EXPECT_EQ(frames(queue), "10 10* 12* 12 - ");
  queue.push(finger(Kind::move, 40, 2));  // was never put down
  EXPECT_EQ(frames(queue), "");
  queue.push(finger(Kind::press, 40, 2));
  EXPECT_EQ(frames(queue), "40 40* ");
}

}  // namespace
}  // namespace nt
