// SPDX-License-Identifier: Apache-2.0
#include "app/frame_loop/capture_loop.h"

#include <utility>

namespace nt {
namespace {

constexpr std::size_t kDisplayRing = 4, kStoreRing = 256, kPictures = 4;
constexpr std::chrono::milliseconds kLook{100};  // between two looks at whether to end

}  // namespace

CaptureLoop::CaptureLoop(Session& session, const Settings& settings, Store store)
    : session_(session),
      settings_(settings),
      out_(std::move(store)),
      camera_(session.film_on_a_thread({settings.pace, settings.display.picture || settings.store.picture,
                                        settings.display.truth || settings.store.truth, settings.plan})),
      display_(settings.has_display ? kDisplayRing : 1, kPictures),
      stored_(kStoreRing, kPictures) {
  core_thread_ = std::thread([this] { run(LoopThread::core, [this] { capture(); }); });
  store_thread_ = std::thread([this] { run(LoopThread::store, [this] { this->store(); }); });
}

CaptureLoop::~CaptureLoop() { join(); }

void CaptureLoop::run(LoopThread thread, const std::function<void()>& work) {
  guard([&] { take_place(settings_.plan, thread), work(); });
  if (thread == LoopThread::core) {
    stored_.close();
    return;
  }
  guard(out_.end);
  const std::lock_guard lock(mutex_);
  done_ = true;
  ended_.notify_all();
}

// The first thing that is thrown on a thread ends them all.
void CaptureLoop::guard(const std::function<void()>& work) {
  try {
    work();
  } catch (...) {
    const std::lock_guard lock(mutex_);
    if (!failed_) failed_ = std::current_exception();
    stop_ = true;
  }
}

void CaptureLoop::capture() {
  for (; !stop_; ++rounds_) {
    answer();
    if (!camera_.wait_ready(kLook)) continue;
    if (!session_.step()) return;
    hand_on();
    ++frames_;
  }
}

void CaptureLoop::hand_on() {
  const Observation& seen =
      observer_.look(session_, settings_.display.picture || settings_.store.picture, settings_.display.masks);
  Keep store = settings_.store;
  store.picture = store.picture && store_pictures_;
  if (settings_.pace == Pace::every) {
    while (!stop_ && !(stored_.wait_free(kLook) && (!store.picture || stored_.wait_picture_free(kLook)))) {
    }
  }
  if (!stored_.add(seen, store)) ++not_stored_;
  if (settings_.has_display && !display_.add_newest(seen, settings_.display)) ++not_shown_;
}

void CaptureLoop::store() {
  for (bool last = false; !last;) {
    last = stored_.closed();  // asked first: what came before the end is taken below
    stored_.wait_filled(kLook);
    while (const Observation* seen = stored_.next()) {
      out_.write(*seen);
      stored_.let_go();
    }
  }
}

void CaptureLoop::ask(std::function<void(Session&)> what) {
  const std::lock_guard lock(mutex_);
  asked_.push_back(std::move(what));
  has_asked_ = true;
}

void CaptureLoop::answer() {
  if (!has_asked_) return;
  {
    const std::lock_guard lock(mutex_);
    std::swap(asked_, answered_);
    has_asked_ = false;
  }
  for (const auto& what : answered_) what(session_);
  answered_.clear();
}

void CaptureLoop::pause(bool on) { camera_.pause(on); }

bool CaptureLoop::wait(std::chrono::milliseconds most) {
  std::unique_lock lock(mutex_);
  ended_.wait_for(lock, most, [this] { return done_.load(); });
  return !done_;
}

void CaptureLoop::join() {
  session_.end_filming();
  camera_.stop();
  if (core_thread_.joinable()) core_thread_.join();
  if (store_thread_.joinable()) store_thread_.join();
}

void CaptureLoop::finish() {
  join();
  if (failed_) std::rethrow_exception(std::exchange(failed_, nullptr));
}

}  // namespace nt
