// SPDX-License-Identifier: Apache-2.0
// Off-screen display: EGL on Mesa's surfaceless platform, drawn by a GPU or by llvmpipe in software; needs no window system.
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl3.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "platform/camera.h"
#include "platform/display.h"
#include "platform/display/gles_renderer.h"

namespace nt {
namespace {

[[noreturn]] void fail(const std::string& missing) {
  throw UserError("no off-screen display: " + missing + "; install Mesa: apt install libegl-mesa0 libgl1-mesa-dri");
}

bool has_extension(const char* list, const char* name) { return list != nullptr && std::strstr(list, name) != nullptr; }

EGLDisplay open_surfaceless() {
  setenv("EGL_LOG_LEVEL", "fatal", 0);  // Mesa's warnings about absent GPUs are not for the user
  if (!has_extension(eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS), "EGL_MESA_platform_surfaceless")) {
    fail("EGL has no surfaceless platform (EGL_MESA_platform_surfaceless)");
  }
  const auto get_display =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
  if (get_display == nullptr) fail("EGL has no eglGetPlatformDisplayEXT");
  EGLDisplay display = get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE) {
    fail("EGL found no driver, not even the software one");
  }
  return display;
}

EGLContext create_context(EGLDisplay display) {
  eglBindAPI(EGL_OPENGL_ES_API);
  const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint found = 0;
  if (eglChooseConfig(display, wanted, &config, 1, &found) == EGL_FALSE || found == 0)
    fail("EGL offers no OpenGL ES 3");
  const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 0, EGL_NONE};
  EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, version);
  if (context == EGL_NO_CONTEXT) fail("EGL cannot create an OpenGL ES 3.0 context");
  return context;
}

// Owns the context. The EGLDisplay is the process's own and shared by all that open it, so it is not terminated.
class Context {
 public:
  Context() : display_(open_surfaceless()), context_(create_context(display_)) {
    if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE) {
      eglDestroyContext(display_, context_);
      fail("EGL cannot use a context without a surface");
    }
  }
  ~Context() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
  }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  void use() const { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_); }

 private:
  EGLDisplay display_;
  EGLContext context_;
};

class Framebuffer {
 public:
  Framebuffer(int width, int height) {
    glGenFramebuffers(1, &framebuffer_);
    glGenRenderbuffers(1, &colour_);
    glGenRenderbuffers(1, &depth_);
    glBindRenderbuffer(GL_RENDERBUFFER, colour_);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
    glBindRenderbuffer(GL_RENDERBUFFER, depth_);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT16, width, height);
    bind();
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
      throw UserError("no off-screen display of " + std::to_string(width) + "x" + std::to_string(height) +
                      " pixels: the driver refuses that size; make it smaller");
    }
  }
  ~Framebuffer() {
    glDeleteFramebuffers(1, &framebuffer_);
    glDeleteRenderbuffers(1, &colour_);
    glDeleteRenderbuffers(1, &depth_);
  }
  Framebuffer(const Framebuffer&) = delete;
  Framebuffer& operator=(const Framebuffer&) = delete;
  void bind() const { glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_); }

 private:
  unsigned framebuffer_ = 0, colour_ = 0, depth_ = 0;
};

class HeadlessDisplay : public Display {
 public:
  HeadlessDisplay(int width, int height)
      : width_(width),
        height_(height),
        framebuffer_(width, height),
        rgba_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4),
        rgb_(rgba_.size() / 4 * 3) {}
  ~HeadlessDisplay() override { context_.use(); }
  std::string name() const override { return "EGL surfaceless"; }
  std::string renderer() const override {
    context_.use();
    return GlesRenderer::description();
  }
  DisplaySize size() const override { return {width_, height_}; }
  void draw_over(const Scene& scene, const std::function<void()>& over) override {
    context_.use();
    framebuffer_.bind();
    renderer_.draw(scene, width_, height_, RowOrder::top_down);
    if (over) over();
  }
  std::span<const uint8_t> pixels() override {
    read_back();
    for (std::size_t from = 0, to = 0; from < rgba_.size(); from += 4, to += 3) {
      for (std::size_t k = 0; k < 3; ++k) rgb_[to + k] = rgba_[from + k];
    }
    return rgb_;
  }
  std::span<const uint8_t> pixels_with_alpha() override {
    read_back();
    for (std::size_t at = 0; at < rgba_.size(); at += 4) {
      const int alpha = rgba_[at + 3];
      if (alpha == 0 || alpha == 255) continue;
      for (std::size_t k = 0; k < 3; ++k)
        rgba_[at + k] = static_cast<uint8_t>(std::min(255, (rgba_[at + k] * 255 + alpha / 2) / alpha));
    }
    return rgba_;
  }

 private:
  void read_back() {
    context_.use();
    framebuffer_.bind();
    // RGBA is the one format that every GLES driver reads back.
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba_.data());
  }

  int width_, height_;
  Context context_;  // before everything that lives in it
  Framebuffer framebuffer_;
  GlesRenderer renderer_;
  std::vector<uint8_t> rgba_, rgb_;
};

}  // namespace

std::unique_ptr<Display> open_headless_display(int width, int height) {
  if (width <= 0 || height <= 0) throw UserError("an off-screen display needs at least 1x1 pixels");
  return std::make_unique<HeadlessDisplay>(width, height);
}

}  // namespace nt
