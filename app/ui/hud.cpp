// SPDX-License-Identifier: Apache-2.0
#include "app/ui/hud.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <utility>
#include <vector>

#include "app/ui/pane.h"
#include "platform/camera.h"

namespace nt {
namespace {

constexpr int64_t kPeriod_ns = 500'000'000;
constexpr float kLinePx = 20, kMarginPx = 10;

std::string stage_times(const Statistics& statistics) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f ms:", statistics.total.quantile_ns(0.5) * 1e-6);
  std::string lines = text;
  for (std::size_t s = 0; s < kStages; ++s) {
    std::snprintf(text, sizeof text, " %.2f", statistics.stages[s].quantile_ns(0.5) * 1e-6);
    lines += std::string(s == kStages / 2 ? "\n " : " ") + kStageNames[s] + text;
  }
  return lines;
}

// The length of the name at the start of `text`, the % included.
std::size_t name_length(const std::string& text, std::size_t from) {
  std::size_t end = from + 1;
  while (end < text.size() && std::islower(static_cast<unsigned char>(text[end])) != 0) ++end;
  return end - from;
}

}  // namespace

std::string latency_text(const Statistics& statistics, const TimeHistogram* to_picture) {
  char text[64];
  std::snprintf(text, sizeof text, "%.1f ms to the pose, %.1f to the picture",
                statistics.latency.quantile_ns(0.5) * 1e-6,
                to_picture != nullptr ? to_picture->quantile_ns(0.5) * 1e-6 : 0.0);
  return text;
}

void check_info_text(const std::string& text) {
  for (std::size_t at = text.find('%'); at != std::string::npos; at = text.find('%', at + 1)) {
    const std::string name = text.substr(at, name_length(text, at));
    std::istringstream known(kInfoNames);
    bool found = false;
    for (std::string word; known >> word;) found = found || word == name;
    if (!found) throw UserError("--info-text: there is no '" + name + "' (there are: " + kInfoNames + ")", 2);
  }
}

Hud::Hud(const std::string& info_text) : info_text_(info_text), text_(kFirstTextPicture + 1) {
  for (std::size_t at = 0; (at = info_text_.find("\\n", at)) != std::string::npos;) info_text_.replace(at, 2, "\n");
}

void Hud::update(int64_t now_ns, const Statistics& statistics, const HudFacts& facts) {
  const double seconds = static_cast<double>(now_ns - last_ns_) * 1e-9;
  const auto rate = [&](int64_t count) { return std::to_string(std::lround(static_cast<double>(count) / seconds)); };
  const std::vector<std::pair<std::string, std::string>> values = {
      {"%fps", rate(statistics.frames - frames_)},
      {"%drawn", rate(drawn_ - drawn_before_)},
      {"%dropped", std::to_string(statistics.dropped)},
      {"%latency", latency_text(statistics, facts.to_picture)},
      {"%frame", std::to_string(statistics.frames - 1)},
      {"%state", facts.state},
      {"%character", facts.character},
      {"%times", stage_times(statistics)},
      {"%keys", facts.keys}};
  std::string text = info_text_;
  for (std::size_t at = text.find('%'); at != std::string::npos; at = text.find('%', at)) {
    const std::size_t length = name_length(text, at);
    const std::string name = text.substr(at, length);
    const auto value = std::find_if(values.begin(), values.end(), [&](const auto& v) { return v.first == name; });
    text.replace(at, length, value->second);
    at += value->second.size();
  }
  lines_ = 1 + static_cast<int>(std::count(text.begin(), text.end(), '\n'));
  text_.set(text);
  last_ns_ = now_ns, frames_ = statistics.frames, drawn_before_ = drawn_;
  due_ns_ = now_ns + kPeriod_ns;
}

void Hud::draw(Scene& scene) const {
  if (hidden_ || info_text_.empty()) return;
  text_.draw(scene, {8, static_cast<float>(scene.height()) - kMarginPx - kLinePx * static_cast<float>(lines_)});
}

}  // namespace nt
