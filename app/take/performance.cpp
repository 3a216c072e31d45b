// SPDX-License-Identifier: Apache-2.0
#include "app/take/performance.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/take/reshape.h"
#include "core/motion/inbetween.h"
#include "platform/camera.h"

namespace nt {
namespace {

constexpr double kMostFrames = 10e6;
constexpr double kLoopBlend_s = 0.5;

// Motions of which every one can be shown, and whether the fish was seen there.
struct Filled {
  std::vector<Motion> motions;
  std::vector<bool> seen;
};

Filled fill(const std::vector<Motion>& motions, double fps) {
  Filled filled{motions, std::vector<bool>(motions.size(), false)};
  const auto bridge = static_cast<std::size_t>(std::max(1.0, kBridge_s * fps));
  std::size_t last = motions.size();  // with a pose, so far
  for (std::size_t i = 0; i < motions.size(); ++i) {
    if (motions[i].status != PoseStatus::ok) {
      if (last < i) filled.motions[i] = motions[last], filled.motions[i].status = motions[i].status;
      continue;
    }
    filled.seen[i] = true;
    const bool first = last == motions.size();
    for (std::size_t k = first ? 0 : last + 1; k < i; ++k) {
      if (first) filled.motions[k] = motions[i], filled.motions[k].status = motions[k].status;
      if (first || i - last > bridge) continue;
      filled.motions[k] =
          in_between(motions[last], motions[i], static_cast<float>(k - last) / static_cast<float>(i - last));
      filled.motions[k].status = motions[k].status;
      filled.seen[k] = true;
    }
    last = i;
  }
  return filled;
}

Moments::Range range_of(const EditedTake& take, const Moments& moments) {
  const int64_t frames = static_cast<int64_t>(take.clip.motions.size());
  if (frames == 0) throw UserError("the edits leave not one frame of the take");
  const Moments::Range range = moments.range.value_or(Moments::Range{0, frames - 1});
  if (range.first < 0 || range.last < range.first || range.last >= frames)
    throw UserError("--range: the take has frames 0 to " + std::to_string(frames - 1), 2);
  return range;
}

template <class T>
std::vector<T> cut(const std::vector<T>& frames, Moments::Range range) {
  const auto first = static_cast<std::ptrdiff_t>(range.first), last = static_cast<std::ptrdiff_t>(range.last);
  return {frames.begin() + first, frames.begin() + last + 1};
}

Seam close(Filled& filled, Moments::Range range, double fps) {
  const auto frames = static_cast<std::size_t>(range.last - range.first + 1);
  const auto blend = std::min(frames / 4, static_cast<std::size_t>(kLoopBlend_s * fps));
  if (blend < 1) throw UserError("--loop: fewer than four frames cannot be closed", 2);
  return make_loop(filled.motions, static_cast<std::size_t>(range.first), static_cast<std::size_t>(range.last), blend);
}

// At `position` frames; after the last one comes the first, or nothing.
Sighting at(const Filled& filled, double position, float init_len) {
  const std::size_t count = filled.motions.size();
  const auto i = std::min(static_cast<std::size_t>(position), count - 1);
  const auto t = static_cast<float>(position - static_cast<double>(i));
  const std::size_t next = (i + 1) % count;
  constexpr float kOnTheFrame = 1e-4f;  // of a frame: rounding of the rate
  if (t < kOnTheFrame) return {filled.seen[i], init_len, filled.motions[i]};
  if (t > 1 - kOnTheFrame) return {filled.seen[next], init_len, filled.motions[next]};
  if (!filled.seen[i] || !filled.seen[next]) return {filled.seen[i], init_len, filled.motions[i]};
  return {true, init_len, in_between(filled.motions[i], filled.motions[next], t)};
}

}  // namespace

Moments::Range parse_range(const std::string& option, const std::string& text) {
  long long first = 0, last = 0;
  char end = 0;
  if (std::sscanf(text.c_str(), "%lld:%lld%c", &first, &last, &end) != 2 || first < 0 || last < first)
    throw UserError(option + ": expected FIRST:LAST, frame numbers from 0, got '" + text + "'", 2);
  return {first, last};
}

Performance performance(const EditedTake& take, const Moments& moments) {
  const double recorded_fps = take.info.fps;
  const Moments::Range range = range_of(take, moments);
  Filled filled = fill(take.clip.motions, recorded_fps);
  Performance result;
  result.fps = moments.rate.value_or(recorded_fps);
  result.loop = moments.loop;
  if (moments.loop) result.seam = close(filled, range, recorded_fps);
  else filled.motions = cut(filled.motions, range);
  filled.seen = cut(filled.seen, range);
  const double step = recorded_fps * moments.speed / result.fps;  // recorded frames a drawn one
  const auto count = static_cast<double>(filled.motions.size());
  const double drawn =
      moments.loop ? std::max(1.0, std::round(count / step)) : std::floor((count - 1) / step + 1e-6) + 1;
  if (drawn > kMostFrames)
    throw UserError("that makes more than ten million frames; ask for a lower rate or a range", 2);
  result.frames.reserve(static_cast<std::size_t>(drawn));
  for (double i = 0; i < drawn; ++i)
    result.frames.push_back(at(filled, moments.loop ? i * count / drawn : i * step, take.init_len));
  return result;
}

bool has_pose(const Performance& performance) {
  return std::any_of(performance.frames.begin(), performance.frames.end(),
                     [](const Sighting& sighting) { return sighting.seen; });
}

void perform(Actor& actor, const Performance& performance, const Pane& pane, Before before,
             const std::function<void(std::size_t)>& frame) {
  const auto dt_s = static_cast<float>(1 / performance.fps);
  if (before == Before::first_pose) {
    Sighting first = performance.frames.front();
    first.seen = true;
    actor.see(first);
    actor.pose(1, dt_s, pane);
  }
  for (int round = performance.loop ? 0 : 1; round < 2; ++round) {
    for (std::size_t i = 0; i < performance.frames.size(); ++i) {
      actor.see(performance.frames[i]);
      actor.pose(1, dt_s, pane);
      if (round == 1) frame(i);
    }
  }
}

}  // namespace nt
