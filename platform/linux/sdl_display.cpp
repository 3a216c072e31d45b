// SPDX-License-Identifier: Apache-2.0
// A window by SDL2 (X11, Wayland or KMS, whichever there is) with an OpenGL ES 3.0 context.
#include <SDL.h>

#include <algorithm>

#include "platform/camera.h"
#include "platform/display.h"
#include "platform/linux/gles_renderer.h"

namespace nt {
namespace {

[[noreturn]] void fail(const std::string& what) {
  throw UserError("no window: " + what + " (SDL: " + SDL_GetError() +
                  "); start from a desktop session or a text console, " + "or use a command that needs no window");
}

class SdlVideo {
 public:
  SdlVideo() {
    // Without the hint SDL asks GLX for the context, and desktop drivers then may not offer ES.
    SDL_SetHint(SDL_HINT_OPENGL_ES_DRIVER, "1");
    SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
    if (SDL_InitSubSystem(SDL_INIT_VIDEO) != 0) fail("there is no display");
  }
  ~SdlVideo() { SDL_QuitSubSystem(SDL_INIT_VIDEO); }
  SdlVideo(const SdlVideo&) = delete;
  SdlVideo& operator=(const SdlVideo&) = delete;
};

class SdlWindow {
 public:
  SdlWindow(const std::string& title, int width, int height) {
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_PROFILE_MASK, SDL_GL_CONTEXT_PROFILE_ES);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, 3);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MINOR_VERSION, 0);
    // No larger than the screen, frame of the window included; the canvas keeps its aspect inside.
    SDL_Rect screen{};
    if (SDL_GetDisplayUsableBounds(0, &screen) == 0 && screen.w > 0 && screen.h > 0) {
      const double fit = std::min({1.0, 0.95 * screen.w / width, 0.9 * screen.h / height});
      width = std::max(static_cast<int>(width * fit), 1);
      height = std::max(static_cast<int>(height * fit), 1);
    }
    const Uint32 flags = SDL_WINDOW_OPENGL | SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI;
    window_ = SDL_CreateWindow(title.c_str(), SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, width, height, flags);
    if (window_ == nullptr) fail("it cannot be opened");
    context_ = SDL_GL_CreateContext(window_);
    if (context_ == nullptr) {
      SDL_DestroyWindow(window_);
      fail("the display has no OpenGL ES 3.0");
    }
    SDL_GL_SetSwapInterval(1);
  }
  ~SdlWindow() {
    SDL_GL_DeleteContext(context_);
    SDL_DestroyWindow(window_);
  }
  SdlWindow(const SdlWindow&) = delete;
  SdlWindow& operator=(const SdlWindow&) = delete;
  SDL_Window* get() const { return window_; }
  // SDL does nothing when it believes the context to be current, and it does not see that an off-screen display took over
  // (live records through one): let go first.
  void use() const {
    SDL_GL_MakeCurrent(nullptr, nullptr);
    SDL_GL_MakeCurrent(window_, context_);
  }

 private:
  SDL_Window* window_ = nullptr;
  SDL_GLContext context_ = nullptr;
};

class SdlDisplay : public Display {
 public:
  SdlDisplay(const std::string& title, int width, int height) : window_(title, width, height) {}
  ~SdlDisplay() override { window_.use(); }
  std::string name() const override { return std::string("SDL2 window (") + SDL_GetCurrentVideoDriver() + ")"; }
  std::string renderer() const override {
    window_.use();
    return GlesRenderer::description();
  }
  void draw(const Scene& scene) override {
    window_.use();
    int width = 0, height = 0;
    SDL_GL_GetDrawableSize(window_.get(), &width, &height);
    renderer_.draw(scene, width, height, RowOrder::bottom_up);
    canvas_width_ = scene.width(), canvas_height_ = scene.height();
    SDL_GL_SwapWindow(window_.get());
  }
  void poll(std::vector<InputEvent>& events) override {
    events.clear();
    SDL_Event event;
    while (SDL_PollEvent(&event) != 0) translate(event, events);
  }

 private:
  void translate(const SDL_Event& event, std::vector<InputEvent>& events) const {
    InputEvent out;
    if (event.type == SDL_QUIT) {
      out.kind = InputEvent::Kind::quit;
    } else if (event.type == SDL_KEYDOWN && event.key.repeat == 0 && event.key.keysym.sym < 128) {
      out.kind = InputEvent::Kind::key;
      out.key = event.key.keysym.sym;  // SDL's key codes are lower-case ASCII where ASCII has the key
    } else if (event.type == SDL_MOUSEBUTTONDOWN && event.button.button == SDL_BUTTON_LEFT) {
      out.kind = InputEvent::Kind::click;
      if (!to_scene(event.button.x, event.button.y, out.at)) return;
    } else {
      return;
    }
    events.push_back(out);
  }

  // Window units are not display pixels on a high-density screen. False in the bars beside the canvas.
  bool to_scene(int x, int y, Vec2& at) const {
    int window_width = 0, window_height = 0, width = 0, height = 0;
    SDL_GetWindowSize(window_.get(), &window_width, &window_height);
    SDL_GL_GetDrawableSize(window_.get(), &width, &height);
    if (window_width <= 0 || window_height <= 0) return false;
    const CanvasFit fit = fit_canvas(canvas_width_, canvas_height_, width, height);
    const float density_x = static_cast<float>(width) / static_cast<float>(window_width);
    const float density_y = static_cast<float>(height) / static_cast<float>(window_height);
    at.x = (static_cast<float>(x) * density_x - static_cast<float>(fit.x)) / fit.scale;
    at.y = (static_cast<float>(y) * density_y - static_cast<float>(fit.y)) / fit.scale;
    return at.x >= 0 && at.y >= 0 && at.x < static_cast<float>(canvas_width_) &&
           at.y < static_cast<float>(canvas_height_);
  }

  SdlVideo video_;
  SdlWindow window_;
  GlesRenderer renderer_;
  int canvas_width_ = 0, canvas_height_ = 0;
};

}  // namespace

std::unique_ptr<Display> open_sdl_display(const std::string& title, int width, int height) {
  if (width <= 0 || height <= 0) throw UserError("a window needs at least 1x1 pixels");
  return std::make_unique<SdlDisplay>(title, width, height);
}

}  // namespace nt
