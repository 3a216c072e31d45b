// SPDX-License-Identifier: Apache-2.0
// The lines at the window's lower edge: how fast it goes, what it does, which keys there are.
//
// `--info-text` says what they hold, with names for the figures (kInfoNames); an empty text hides them. Figures are renewed
// twice a second, and at once after a key. Cost when they are: 0.1 ms a line.
#pragma once
#include <cstdint>
#include <string>

#include "app/statistics.h"
#include "app/ui/text.h"
#include "core/scene/scene.h"

namespace nt {

inline constexpr const char* kInfoNames = "%fps %drawn %dropped %latency %frame %state %character %times %keys";
inline constexpr const char* kDefaultInfo =
    "%fps frames/s, %drawn drawn/s, %dropped dropped, %latency%state\n%times\n%keys";

struct HudFacts {
  std::string state;  // ", paused" and the like
  std::string character, keys;
  const TimeHistogram* to_picture = nullptr;  // from the camera's timestamp until the window shows the frame
};

class Hud {
 public:
  explicit Hud(const std::string& info_text);
  void toggle() { hidden_ = !hidden_; }
  void renew() { due_ns_ = 0; }  // with the next update
  bool due(int64_t now_ns) const { return !hidden_ && !info_text_.empty() && now_ns >= due_ns_; }
  void drawn() { ++drawn_; }  // a frame of the window
  void update(int64_t now_ns, const Statistics& statistics, const HudFacts& facts);
  void draw(Scene& scene) const;

 private:
  std::string info_text_;
  Text text_;
  int lines_ = 0;
  bool hidden_ = false;
  int64_t due_ns_ = 0, last_ns_ = 0, frames_ = 0, drawn_ = 0, drawn_before_ = 0;
};

// %latency: from the camera's timestamp to the pose and to the window, medians. Without a window's figures: null.
std::string latency_text(const Statistics& statistics, const TimeHistogram* to_picture);

// Throws UserError (exit code 2) for a %name that is not in kInfoNames.
void check_info_text(const std::string& text);

}  // namespace nt
