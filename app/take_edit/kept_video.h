// SPDX-License-Identifier: Apache-2.0
// The camera's pictures that were kept beside a take, shown again: the one that belongs to a frame.
//
// Path + frame of the recording -> its picture, rgb8. Decoding is a thread's of its own, so that a hand
// that scrubs is never waited for: want() only says what is wanted now, and what was wanted meanwhile is passed over.
// A file that is missing, cut short or no video is one line in problem(); nothing is thrown.
// Cost: a few milliseconds a picture in order; elsewhere all pictures from the key frame before it, two seconds at most.
#pragma once
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <string>
#include <thread>

#include "core/scene/scene.h"
#include "platform/sim/frame_source.h"

namespace nt {

class KeptVideo {
 public:
  // `first`: the recording's frame that the first picture shows; below 0 after a trim.
  KeptVideo(std::string path, int64_t first);
  ~KeptVideo();
  KeptVideo(const KeptVideo&) = delete;
  KeptVideo& operator=(const KeptVideo&) = delete;

  void want(int64_t frame);
  // The last picture that was ready, and the frame that it belongs to, -1 while there is none. Its pixels live until the next
  // call. Its id is the caller's to set.
  Picture picture();
  int64_t shown() const { return shown_; }
  std::string problem();  // why there is none of the frame wanted last; empty while all is well

 private:
  void work();
  void decode(int64_t frame);
  bool read_up_to(int64_t index);
  void tell(int64_t frame, const std::string& problem);

  std::string path_;
  int64_t first_;
  std::unique_ptr<FrameSource> source_;  // the thread's
  cv::Mat bgr_;                          // the thread's
  cv::Mat front_;                        // the caller's
  int64_t shown_ = -1;
  uint64_t revision_ = 0;
  std::mutex mutex_;  // of all below
  std::condition_variable wake_;
  bool stop_ = false;
  int64_t wanted_ = -1, done_ = -1, ready_ = -1;
  cv::Mat back_;  // of frame ready_
  bool fresh_ = false;
  std::string problem_;
  std::thread thread_;
};

}  // namespace nt
