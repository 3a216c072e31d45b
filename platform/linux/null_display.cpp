// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <iterator>

#include "platform/camera.h"
#include "platform/display.h"

namespace nt {
namespace {

class NullDisplay : public Display {
 public:
  NullDisplay(int width, int height) : size_{width, height} {}
  std::string name() const override { return "null"; }
  std::string renderer() const override { return "nothing is drawn"; }
  DisplaySize size() const override { return size_; }
  void draw_over(const Scene&, const std::function<void()>&) override {}

 private:
  DisplaySize size_;
};

}  // namespace

const char* to_string(DisplayKind kind) {
  constexpr const char* kNames[] = {"auto", "window", "kms", "egl", "null"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::unique_ptr<Display> open_null_display(int width, int height) {
  if (width <= 0 || height <= 0) throw UserError("a display needs at least 1x1 pixels");
  return std::make_unique<NullDisplay>(width, height);
}

}  // namespace nt
