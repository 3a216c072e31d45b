// SPDX-License-Identifier: Apache-2.0
// Panel by Dear ImGui, and the function by which libneontetra_panel.so hands it out.
#include <imgui.h>
#include <imgui_impl_opengl3.h>

#include <algorithm>
#include <cfloat>
#include <filesystem>
#include <system_error>

#include "app/ui/panel.h"
#include "app/ui/theme.h"

namespace nt {
namespace {

constexpr const char* kFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
constexpr float kTextShare = 0.40f;  // of a button's height
constexpr float kRounding = 0.18f;
constexpr float kLeastShrink = 0.6f;

ImVec4 im(Colour c) { return {c.r, c.g, c.b, c.a}; }
ImU32 packed(Colour c) { return ImGui::ColorConvertFloat4ToU32(im(c)); }
ImVec2 im(Vec2 p) { return {p.x, p.y}; }

struct Looks {
  Colour face, pressed, words;
};

Looks looks(Panel::Look look) {
  switch (look) {
    case Panel::Look::on:
      return {kAccent, kAccentDark, kOnAccent};
    case Panel::Look::main:
      return {kMain, kMainDark, kOnAccent};
    case Panel::Look::off:
      return {kFaceOff, kFaceOff, kInkFaint};
    case Panel::Look::plain:
      break;
  }
  return {kFace, kFaceDark, kInk};
}

class ImguiPanel final : public Panel {
 public:
  ImguiPanel();
  ~ImguiPanel() override;
  ImguiPanel(const ImguiPanel&) = delete;
  ImguiPanel& operator=(const ImguiPanel&) = delete;

  void begin(int width, int height, float dt_s, const PointerState& pointer, float unit) override;
  void end() override;
  void draw() const override;
  void fill(const Area& area, Colour colour, float rounding) override;
  void dot(Vec2 at, float diameter, Colour colour, Colour rim) override;
  void text(const Area& area, const std::string& words, Colour colour, Align align) override;
  void tag(Vec2 at, const std::string& words, const Area& within) override;
  bool button(const Area& area, const std::string& words, Look look) override;
  bool number(const Area& area, const char* words, int& value, int least, int most) override;

 private:
  void build_font(float pixels);
  float unit_ = 0;
  bool own_font_ = false;  // DejaVu Sans
};

ImguiPanel::ImguiPanel() {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // nothing is written beside the user's files
  io.ConfigFlags |= ImGuiConfigFlags_NoMouseCursorChange;
  ImGui_ImplOpenGL3_Init("#version 300 es");
}

ImguiPanel::~ImguiPanel() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext();
}

void ImguiPanel::build_font(float pixels) {
  ImGuiIO& io = ImGui::GetIO();
  io.Fonts->Clear();
  std::error_code unused;
  static constexpr ImWchar kLetters[] = {0x20, 0xFF, 0x2212, 0x2212, 0};  // Latin, and a minus as wide as the plus
  own_font_ = std::filesystem::exists(kFont, unused) &&
              io.Fonts->AddFontFromFileTTF(kFont, pixels, nullptr, kLetters) != nullptr;
  if (!own_font_) {
    ImFontConfig config;
    config.SizePixels = pixels;
    io.Fonts->AddFontDefault(&config);
  }
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
}

void ImguiPanel::begin(int width, int height, float dt_s, const PointerState& pointer, float unit) {
  ImGui_ImplOpenGL3_NewFrame();
  if (unit != unit_) {
    unit_ = unit;
    build_font(std::max(10.0f, unit * kTextShare));
    ImGuiStyle& style = ImGui::GetStyle();
    style.FrameRounding = style.GrabRounding = unit * kRounding;
    style.WindowBorderSize = 0;
    style.GrabMinSize = 0.5f * unit;
    style.WindowPadding = style.ItemSpacing = ImVec2(0, 0);
  }
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = ImVec2(static_cast<float>(width), static_cast<float>(height));
  io.DeltaTime = std::max(dt_s, 1e-4f);
  io.MousePos = pointer.over ? im(pointer.at) : ImVec2(-FLT_MAX, -FLT_MAX);
  io.MouseDown[0] = pointer.down;
  ImGui::NewFrame();
  ImGui::SetNextWindowPos(ImVec2(0, 0));
  ImGui::SetNextWindowSize(io.DisplaySize);
  ImGui::Begin("panel", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoScrollWithMouse |
                   ImGuiWindowFlags_NoBringToFrontOnFocus);
}

void ImguiPanel::end() {
  ImGui::End();
  ImGui::Render();
}

void ImguiPanel::draw() const { ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData()); }

void ImguiPanel::fill(const Area& area, Colour colour, float rounding) {
  ImGui::GetWindowDrawList()->AddRectFilled(im(area.corner), im(area.corner + area.size), packed(colour), rounding);
}

void ImguiPanel::dot(Vec2 at, float diameter, Colour colour, Colour rim) {
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddCircleFilled(im(at), 0.5f * diameter + 0.03f * unit_, packed(rim));
  list->AddCircleFilled(im(at), 0.5f * diameter, packed(colour));
}

void ImguiPanel::text(const Area& area, const std::string& words, Colour colour, Align align) {
  ImVec2 size = ImGui::CalcTextSize(words.c_str());
  // Words that are too long for their place are set smaller, down to where they can be read.
  const float shrink = std::clamp(area.size.x / std::max(size.x, 1.0f), kLeastShrink, 1.0f);
  size = ImVec2(size.x * shrink, size.y * shrink);
  const float free = align == Align::middle ? std::max(0.0f, 0.5f * (area.size.x - size.x)) : 0.0f;
  const Vec2 at{area.corner.x + free, area.corner.y + 0.5f * (area.size.y - size.y)};
  const ImVec4 clip(area.corner.x, area.corner.y, area.corner.x + area.size.x, area.corner.y + area.size.y);
  ImGui::GetWindowDrawList()->AddText(ImGui::GetFont(), ImGui::GetFontSize() * shrink, im(at), packed(colour),
                                      words.c_str(), nullptr, 0, &clip);
}

void ImguiPanel::tag(Vec2 at, const std::string& words, const Area& within) {
  const ImVec2 size = ImGui::CalcTextSize(words.c_str());
  const Vec2 pad{0.22f * unit_, 0.12f * unit_};
  const Vec2 full{size.x + 2 * pad.x, size.y + 2 * pad.y};
  const Vec2 last = within.corner + within.size - full;
  const Vec2 corner{std::clamp(at.x - 0.5f * full.x, within.corner.x, std::max(last.x, within.corner.x)),
                    std::clamp(at.y, within.corner.y, std::max(last.y, within.corner.y))};
  fill({corner, full}, kPlate, unit_ * kRounding);
  text({corner + pad, {size.x + 1, size.y}}, words, kOnAccent, Align::left);
}

bool ImguiPanel::button(const Area& area, const std::string& words, Look look) {
  const Looks colours = looks(look);
  ImGui::SetCursorPos(im(area.corner));
  ImGui::PushStyleColor(ImGuiCol_Button, im(colours.face));
  ImGui::PushStyleColor(ImGuiCol_ButtonHovered, im(colours.face));
  ImGui::PushStyleColor(ImGuiCol_ButtonActive, im(colours.pressed));
  ImGui::PushStyleColor(ImGuiCol_Text, im(colours.words));
  ImGui::BeginDisabled(look == Look::off);
  ImGui::PushStyleVar(ImGuiStyleVar_DisabledAlpha, 1.0f);
  const bool pressed = ImGui::Button(words.c_str(), im(area.size));
  ImGui::PopStyleVar();
  ImGui::EndDisabled();
  ImGui::PopStyleColor(4);
  return pressed && look != Look::off;
}

bool ImguiPanel::number(const Area& area, const char* words, int& value, int least, int most) {
  const float side = area.size.y, gap = 0.08f * unit_;
  const int before = value;
  const Vec2 size{side, side};
  const std::string id = std::string("##") + words;
  if (button({area.corner, size}, (own_font_ ? "\u2212" : "-") + id, value > least ? Look::plain : Look::off)) --value;
  const Vec2 plus{area.corner.x + area.size.x - side, area.corner.y};
  if (button({plus, size}, "+" + id, value < most ? Look::plain : Look::off)) ++value;
  ImGui::SetCursorPos({area.corner.x + side + gap, area.corner.y});
  ImGui::SetNextItemWidth(area.size.x - 2 * (side + gap));
  const float text_height = ImGui::GetTextLineHeight();
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(0, 0.5f * (side - text_height)));
  for (const ImGuiCol slot : {ImGuiCol_FrameBg, ImGuiCol_FrameBgHovered, ImGuiCol_FrameBgActive})
    ImGui::PushStyleColor(slot, im(kTrack));
  ImGui::PushStyleColor(ImGuiCol_SliderGrab, im(kGrab));
  ImGui::PushStyleColor(ImGuiCol_SliderGrabActive, im(kGrabDark));
  ImGui::PushStyleColor(ImGuiCol_Text, im(kInk));
  const std::string format = std::string(words) + "  %d";
  ImGui::SliderInt(id.c_str(), &value, least, most, format.c_str(),
                   ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput);
  ImGui::PopStyleColor(6);
  ImGui::PopStyleVar();
  return value != before;
}

}  // namespace
}  // namespace nt

extern "C" __attribute__((visibility("default"))) void neontetra_make_panel(std::unique_ptr<nt::Panel>& panel) {
  panel = std::make_unique<nt::ImguiPanel>();
}
