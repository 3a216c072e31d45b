// SPDX-License-Identifier: Apache-2.0
// A window by SDL2 (X11 or Wayland), or a whole screen (KMS), with an OpenGL ES 3.0 context.
#include <SDL.h>

#include <algorithm>
#include <optional>

#include "platform/camera.h"
#include "platform/display.h"
#include "platform/display/gles_renderer.h"
#include "platform/display/rotation.h"
#include "platform/display/turned_target.h"

namespace nt {
namespace {

[[noreturn]] void fail(const std::string& what, DisplayKind kind) {
  const std::string said = what + " (SDL: " + SDL_GetError() + "); ";
  if (kind == DisplayKind::kms)
    throw UserError(
        "no screen by KMS: " + said +
        "end the desktop or start from a text console, and be a member of the groups video, render and input");
  throw UserError("no window: " + said + "start from a desktop session or a text console, " +
                  "or use a command that needs no window");
}

class SdlVideo {
 public:
  explicit SdlVideo(DisplayKind kind) {
    // A driver that the user names (SDL_VIDEODRIVER) goes before what is usual, but not before what is forced.
    if (kind == DisplayKind::kms) SDL_SetHintWithPriority(SDL_HINT_VIDEODRIVER, "KMSDRM", SDL_HINT_OVERRIDE);
    if (kind == DisplayKind::window) SDL_SetHintWithPriority(SDL_HINT_VIDEODRIVER, "x11,wayland", SDL_HINT_NORMAL);
    // Without the hint SDL asks GLX for the context, and desktop drivers then may not offer ES.
    SDL_SetHint(SDL_HINT_OPENGL_ES_DRIVER, "1");
    SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
    // Fingers come as fingers, not once more as a mouse.
    SDL_SetHint(SDL_HINT_TOUCH_MOUSE_EVENTS, "0");
    if (SDL_InitSubSystem(SDL_INIT_VIDEO) != 0) fail("there is no display", kind);
    kms_ = std::string(SDL_GetCurrentVideoDriver()) == "KMSDRM";
    // On a screen of its own the pointer is not seen until somebody moves it.
    if (kms_) SDL_ShowCursor(SDL_DISABLE);
  }
  ~SdlVideo() { SDL_QuitSubSystem(SDL_INIT_VIDEO); }
  SdlVideo(const SdlVideo&) = delete;
  SdlVideo& operator=(const SdlVideo&) = delete;
  bool kms() const { return kms_; }

 private:
  bool kms_ = false;
};

class SdlWindow {
 public:
  SdlWindow(const std::string& title, int width, int height, WindowMode mode, DisplayKind kind) {
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_PROFILE_MASK, SDL_GL_CONTEXT_PROFILE_ES);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, 3);
    SDL_GL_SetAttribute(SDL_GL_CONTEXT_MINOR_VERSION, 0);
    Uint32 flags = SDL_WINDOW_OPENGL | SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI;
    SDL_GL_SetAttribute(SDL_GL_DEPTH_SIZE, 16);  // for characters that are solid
    SDL_Rect screen{};
    const bool known = SDL_GetDisplayUsableBounds(0, &screen) == 0 && screen.w > 0 && screen.h > 0;
    const bool small = known && mode == WindowMode::large && (screen.w <= width || screen.h <= height);
    int place = SDL_WINDOWPOS_CENTERED;
    if (small || mode == WindowMode::full_screen) {
      flags |= SDL_WINDOW_FULLSCREEN_DESKTOP;
      // Where no window manager makes it fill the screen it does so from the start.
      if (known) width = screen.w, height = screen.h, place = 0;
    } else if (known) {
      // No larger than the screen, frame of the window included; the canvas keeps its aspect inside.
      const double fit = std::min({1.0, 0.95 * screen.w / width, 0.9 * screen.h / height});
      width = std::max(static_cast<int>(width * fit), 1);
      height = std::max(static_cast<int>(height * fit), 1);
    }
    window_ = SDL_CreateWindow(title.c_str(), place, place, width, height, flags);
    if (window_ == nullptr) fail("it cannot be opened", kind);
    context_ = SDL_GL_CreateContext(window_);
    if (context_ == nullptr) {
      SDL_DestroyWindow(window_);
      fail("the display has no OpenGL ES 3.0", kind);
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
  SdlDisplay(const std::string& title, DisplaySize wanted, const WindowSettings& settings)
      : video_(settings.kind),
        window_(title, wanted.width, wanted.height, video_.kms() ? WindowMode::full_screen : settings.mode,
                settings.kind),
        rotation_deg_(settings.rotation_deg) {
    if (rotation_deg_ != 0) turned_.emplace(rotation_deg_);
  }
  ~SdlDisplay() override { window_.use(); }
  std::string name() const override {
    if (video_.kms()) return "SDL2 screen (KMS)";
    return std::string("SDL2 window (") + SDL_GetCurrentVideoDriver() + ")";
  }
  std::string renderer() const override {
    window_.use();
    return GlesRenderer::description();
  }
  DisplaySize size() const override { return upright(screen(), rotation_deg_); }
  void draw_over(const Scene& scene, const std::function<void()>& over) override {
    window_.use();
    const DisplaySize shown = size();
    if (turned_) turned_->begin(screen());
    renderer_.draw(scene, shown.width, shown.height, RowOrder::bottom_up);
    canvas_width_ = scene.width(), canvas_height_ = scene.height();
    if (over) over();
    if (turned_) turned_->show(screen());
    SDL_GL_SwapWindow(window_.get());
  }
  void poll(std::vector<InputEvent>& events) override {
    events.clear();
    SDL_Event event;
    while (SDL_PollEvent(&event) != 0) translate(event, events);
  }

 private:
  DisplaySize screen() const {
    DisplaySize size;
    SDL_GL_GetDrawableSize(window_.get(), &size.width, &size.height);
    return size;
  }

  void translate(const SDL_Event& event, std::vector<InputEvent>& events) const {
    InputEvent out;
    switch (event.type) {
      case SDL_QUIT:
        out.kind = InputEvent::Kind::quit;
        break;
      case SDL_KEYDOWN:
        if (!translate_key(event.key, out)) return;
        break;
      case SDL_MOUSEBUTTONDOWN:
      case SDL_MOUSEBUTTONUP:
        if (event.button.button != SDL_BUTTON_LEFT) return;
        out.kind = event.type == SDL_MOUSEBUTTONDOWN ? InputEvent::Kind::click : InputEvent::Kind::release;
        if (!to_scene(static_cast<float>(event.button.x), static_cast<float>(event.button.y), out)) return;
        break;
      case SDL_MOUSEMOTION:
        if (video_.kms()) SDL_ShowCursor(SDL_ENABLE);
        out.kind = InputEvent::Kind::move;
        if (!to_scene(static_cast<float>(event.motion.x), static_cast<float>(event.motion.y), out)) return;
        break;
      case SDL_FINGERDOWN:
      case SDL_FINGERUP:
      case SDL_FINGERMOTION:
        if (!translate_finger(event.tfinger, out)) return;
        break;
      default:
        return;
    }
    events.push_back(out);
  }

  static bool translate_key(const SDL_KeyboardEvent& key, InputEvent& out) {
    out.kind = InputEvent::Kind::key;
    out.ctrl = (key.keysym.mod & KMOD_CTRL) != 0;
    out.shift = (key.keysym.mod & KMOD_SHIFT) != 0;
    switch (key.keysym.sym) {
      case SDLK_LEFT:
        out.key = kKeyLeft;
        return true;
      case SDLK_RIGHT:
        out.key = kKeyRight;
        return true;
      case SDLK_UP:
        out.key = kKeyUp;
        return true;
      case SDLK_DOWN:
        out.key = kKeyDown;
        return true;
      default:
        out.key = key.keysym.sym;  // SDL's key codes are lower-case ASCII where ASCII has the key
        return key.repeat == 0 && out.key < 128;
    }
  }

  bool translate_finger(const SDL_TouchFingerEvent& finger, InputEvent& out) const {
    out.kind = finger.type == SDL_FINGERDOWN ? InputEvent::Kind::click
               : finger.type == SDL_FINGERUP ? InputEvent::Kind::release
                                             : InputEvent::Kind::move;
    out.finger = true, out.finger_id = finger.fingerId;
    int width = 0, height = 0;
    SDL_GetWindowSize(window_.get(), &width, &height);
    return to_scene(finger.x * static_cast<float>(width), finger.y * static_cast<float>(height), out);
  }

  // Window units are not display pixels on a high-density screen. False for a click in the bars beside the canvas.
  bool to_scene(float x, float y, InputEvent& out) const {
    int window_width = 0, window_height = 0;
    SDL_GetWindowSize(window_.get(), &window_width, &window_height);
    const DisplaySize pixels = screen(), shown = size();
    if (window_width <= 0 || window_height <= 0) return false;
    const CanvasFit fit = fit_canvas(canvas_width_, canvas_height_, shown.width, shown.height);
    const float density_x = static_cast<float>(pixels.width) / static_cast<float>(window_width);
    const float density_y = static_cast<float>(pixels.height) / static_cast<float>(window_height);
    const Vec2 at = to_upright({x * density_x, y * density_y}, pixels, rotation_deg_);
    out.at.x = (at.x - static_cast<float>(fit.x)) / fit.scale;
    out.at.y = (at.y - static_cast<float>(fit.y)) / fit.scale;
    return out.kind != InputEvent::Kind::click ||
           (out.at.x >= 0 && out.at.y >= 0 && out.at.x < static_cast<float>(canvas_width_) &&
            out.at.y < static_cast<float>(canvas_height_));
  }

  SdlVideo video_;
  SdlWindow window_;
  int rotation_deg_;
  GlesRenderer renderer_;
  std::optional<TurnedTarget> turned_;
  int canvas_width_ = 0, canvas_height_ = 0;
};

}  // namespace

std::unique_ptr<Display> open_sdl_display(const std::string& title, int width, int height,
                                          const WindowSettings& settings) {
  if (width <= 0 || height <= 0) throw UserError("a window needs at least 1x1 pixels");
  return std::make_unique<SdlDisplay>(title, upright({width, height}, settings.rotation_deg), settings);
}

}  // namespace nt
