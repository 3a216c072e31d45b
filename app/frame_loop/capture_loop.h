// SPDX-License-Identifier: Apache-2.0
// The frame loop: camera, core, display and store, each on a thread of its own, with fixed rings between them.
//
//   camera thread -> 4 frames -> core thread -> 4 observations   -> display (the caller's thread)
//                                            -> 256 observations -> store thread
//
// Pace `clock`: nobody waits for whoever comes after him. A display that is slow misses observations, and what waits for it
// last is always the newest; a store that is slow for longer than the ring is deep loses frames, which are counted; capture
// notices neither. Pictures go to the store in a ring of their own, of four: the first thing that a slow disk loses is pictures,
// not poses.
// Pace `every` (files, as fast as can be): nothing is lost, each waits for the next.
// Errors: what is thrown on any of the threads ends the loop and comes out of finish().
#pragma once
#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "app/frame_loop/camera_thread.h"
#include "app/frame_loop/observation_ring.h"
#include "app/frame_loop/thread_plan.h"
#include "app/session.h"

namespace nt {

class CaptureLoop {
 public:
  struct Settings {
    Pace pace = Pace::every;
    bool has_display = false;
    Keep display, store;  // what each is given
    ThreadPlan plan{};
  };
  // On the store thread: `write` once a frame; `end` after the last one, or when writing has failed.
  struct Store {
    std::function<void(const Observation&)> write;
    std::function<void()> end = [] {};
  };

  // Starts at once. The session is the loop's until finish(): whoever wants something of it asks.
  CaptureLoop(Session& session, const Settings& settings, Store store);
  ~CaptureLoop();
  CaptureLoop(const CaptureLoop&) = delete;
  CaptureLoop& operator=(const CaptureLoop&) = delete;

  // On the core thread, before its next step.
  void ask(std::function<void(Session&)> what);
  void pause(bool on);
  // Whether the store is given the pictures that its Keep asks for (at first: yes), from the next frame on.
  void store_pictures(bool on) { store_pictures_ = on; }
  // The display's: the next observation that it has not seen, until the next call; null when there is none yet.
  const Observation* next_seen() { return display_.next(); }
  bool running() const { return !done_; }     // false when all that was filmed is stored
  bool wait(std::chrono::milliseconds most);  // until then; running()
  int64_t frames() const { return frames_; }  // through core so far
  int64_t rounds() const {
    return rounds_;
  }  // of the core thread, ten a second at least, with frames or without: it lives
  int64_t not_stored() const { return not_stored_; }
  int64_t pictures_not_stored() const { return stored_.pictures_lost(); }
  int64_t not_shown() const { return not_shown_; }
  // Ends filming; what was filmed is stored. Throws what a thread has thrown.
  void finish();

 private:
  void run(LoopThread thread, const std::function<void()>& work);
  void guard(const std::function<void()>& work);
  void capture();
  void store();
  void hand_on();
  void answer();
  void join();

  Session& session_;
  Settings settings_;
  Store out_;
  CameraThread& camera_;
  Observer observer_;
  ObservationRing display_, stored_;
  std::mutex mutex_;  // of asked_ and failed_
  std::vector<std::function<void(Session&)>> asked_, answered_;
  std::exception_ptr failed_;
  std::condition_variable ended_;
  std::atomic<bool> stop_{false}, done_{false}, has_asked_{false}, store_pictures_{true};
  std::atomic<int64_t> frames_{0}, rounds_{0}, not_stored_{0}, not_shown_{0};
  std::thread core_thread_, store_thread_;
};

}  // namespace nt
