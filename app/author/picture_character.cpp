// SPDX-License-Identifier: Apache-2.0
#include "app/author/picture_character.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/aligned_block.h"
#include "app/author/character_file.h"
#include "app/author/figure.h"
#include "app/author/triangulate.h"
#include "core/base/arena.h"
#include "core/landmarks/landmarks.h"
#include "platform/camera.h"

namespace nt {
namespace {

// A belief that evidence from the shape does not overturn.
constexpr float kToldHead = 50.0f;
// A landmark group below this is named in the report.
constexpr float kUnsure = 0.5f;

Vec2 farthest(const std::vector<Vec2>& points, Vec2 from) {
  return *std::max_element(points.begin(), points.end(),
                           [&](Vec2 a, Vec2 b) { return length_sq(a - from) < length_sq(b - from); });
}

Vec2 outermost(const std::vector<Vec2>& points, Vec2 direction) {
  return *std::max_element(points.begin(), points.end(),
                           [&](Vec2 a, Vec2 b) { return dot(a, direction) < dot(b, direction); });
}

LandmarkHints hints_for(const Figure& figure, const std::optional<HeadSide>& head) {
  LandmarkHints hints;
  if (!head) return hints;
  hints.has_last = true;
  hints.head_log_odds = kToldHead;
  if (head->fraction) {
    hints.last_head = figure.picture_origin +
                      Vec2{head->fraction->x * figure.picture_size.x, head->fraction->y * figure.picture_size.y};
    hints.last_tail = farthest(figure.outline, hints.last_head);
  } else {
    hints.last_head = outermost(figure.outline, head->direction);
    hints.last_tail = outermost(figure.outline, head->direction * -1.0f);
  }
  return hints;
}

FishPose find_landmarks(const std::string& path, const Figure& figure, const PictureOptions& options) {
  Limits limits;
  limits.max_width = figure.rgba.cols;
  limits.max_height = figure.rgba.rows;
  limits.max_contour_points = std::max(limits.max_contour_points, static_cast<int>(figure.outline.size()));
  const LandmarkSettings settings{options.u_num, options.l_num, options.harmonics};
  Arena measure;
  Landmarks::create(measure, limits, settings);
  const AlignedBlock block(measure.used());
  Arena arena(block.bytes());
  Landmarks* landmarks = Landmarks::create(arena, limits, settings);
  FishPose pose;
  if (landmarks == nullptr || !landmarks->find(figure.outline, hints_for(figure, options.head), pose)) {
    throw UserError(path + ": the figure has no head and tail to be found; give a longer figure, or --head");
  }
  pose.status = PoseStatus::ok;
  return pose;
}

// Picture -> character: origin at the centre, x to the fish's right, y towards its head.
class CharacterFrame {
 public:
  explicit CharacterFrame(const FishPose& pose) : centre_(pose.centre), dir_(pose.dir), right_(right_of(pose.dir)) {}
  Vec2 operator()(Vec2 p) const { return {dot(p - centre_, right_), dot(p - centre_, dir_)}; }

 private:
  Vec2 centre_, dir_, right_;
};

ControlPoints control_points(const FishPose& pose, const CharacterFrame& local) {
  ControlPoints c;
  c.centre = local(pose.centre), c.head = local(pose.head), c.tail = local(pose.tail);
  for (int i = 0; i < pose.u_num; ++i) c.up_axis[i] = local(pose.up_axis[i]);
  for (int i = 0; i < pose.l_num; ++i) c.low_axis[i] = local(pose.low_axis[i]);
  c.fins[kLeftFin] = {pose.confidence.l_fin > 0, local(pose.jun_tl), local(pose.jun_bl), local(pose.l_fin)};
  c.fins[kRightFin] = {pose.confidence.r_fin > 0, local(pose.jun_tr), local(pose.jun_br), local(pose.r_fin)};
  return c;
}

std::string percent(float v) {
  char text[16];
  std::snprintf(text, sizeof text, "%d %%", static_cast<int>(std::lround(v * 100)));
  return text;
}

std::vector<std::string> notes_on(const Figure& figure, const FishPose& pose) {
  std::vector<std::string> notes;
  const PoseConfidence& c = pose.confidence;
  if (!figure.from_alpha) notes.push_back("no transparency: the figure was cut out by its edges; check the picture");
  if (figure.figures > 1)
    notes.push_back("several figures: the largest of " + std::to_string(figure.figures) + " was taken");
  if (!(c.l_fin > 0)) notes.push_back("left fin not seen: this character has none");
  if (!(c.r_fin > 0)) notes.push_back("right fin not seen: this character has none");
  const auto unsure = [&](const char* what, float v) {
    if (v > 0 && v < kUnsure) notes.push_back(std::string(what) + " is unsure (" + percent(v) + ")");
  };
  unsure("head end", c.head);
  unsure("tail end", c.tail);
  unsure("axis", c.axis);
  unsure("left fin", c.l_fin);
  unsure("right fin", c.r_fin);
  return notes;
}

Triangulation triangles_of(const std::string& path, const Figure& figure, int vertices) {
  try {
    return triangulate(figure.outline, vertices);
  } catch (const TriangulationError& e) {
    throw UserError(path + ": " + e.what() + "; draw it with thicker, separate parts");
  }
}

void check_options(const PictureOptions& o) {
  const auto need = [](bool ok, const char* line) {
    if (!ok) throw UserError(line, 2);
  };
  need(o.u_num >= 1 && o.u_num <= kMaxUpAxis, "u_num must be 1 to 8");
  need(o.l_num >= 1 && o.l_num <= kMaxLowAxis, "l_num must be 1 to 32");
  need(o.harmonics >= 1 && o.harmonics <= 64, "harmonics must be 1 to 64");
  need(o.vertices >= 100 && o.vertices <= 8000, "vertices must be 100 to 8000");
}

}  // namespace

HeadSide parse_head_side(const std::string& text) {
  HeadSide side;
  if (text == "left") return side.direction = {-1, 0}, side;
  if (text == "right") return side.direction = {1, 0}, side;
  if (text == "up") return side.direction = {0, -1}, side;
  if (text == "down") return side.direction = {0, 1}, side;
  Vec2 p;
  char rest = 0;
  const bool two = std::sscanf(text.c_str(), "%f,%f%c", &p.x, &p.y, &rest) == 2;
  if (!two || !(p.x >= 0 && p.x <= 1 && p.y >= 0 && p.y <= 1)) {
    throw UserError("head '" + text + "' is not left, right, up, down or X,Y with shares of the picture from 0 to 1",
                    2);
  }
  side.fraction = p;
  return side;
}

AuthoredCharacter author_picture(const std::string& path, const PictureOptions& options) {
  check_options(options);
  const Figure figure = load_figure(path);
  const FishPose pose = find_landmarks(path, figure, options);
  const CharacterFrame local(pose);
  Triangulation mesh = triangles_of(path, figure, options.vertices);

  std::vector<Vec2> vertices, texcoords;
  const float width = static_cast<float>(figure.rgba.cols), height = static_cast<float>(figure.rgba.rows);
  for (const Vec2 p : mesh.vertices) {
    vertices.push_back(local(p));
    // Texels have their centres at halves where pixels have them at integers.
    texcoords.push_back({std::clamp((p.x + 0.5f) / width, 0.0f, 1.0f), std::clamp((p.y + 0.5f) / height, 0.0f, 1.0f)});
  }
  // y turns over between the two frames: so does the sense of every triangle.
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) std::swap(mesh.triangles[i + 1], mesh.triangles[i + 2]);

  Character character;
  character.u_num = options.u_num;
  character.l_num = options.l_num;
  character.harmonics = options.harmonics;
  character.rest = control_points(pose, local);
  character.vertices = vertices;
  character.texcoords = texcoords;
  character.triangles = mesh.triangles;
  character.texture = {figure.rgba.data,
                       figure.rgba.cols,
                       figure.rgba.rows,
                       static_cast<int>(figure.rgba.step),
                       PixelFormat::rgba8,
                       0,
                       0};
  AuthoredCharacter out;
  out.bytes = character_bytes(character);
  out.report = {static_cast<int>(vertices.size()),
                static_cast<int>(mesh.triangles.size() / 3),
                figure.rgba.cols,
                figure.rgba.rows,
                figure.from_alpha,
                pose,
                notes_on(figure, pose)};
  return out;
}

}  // namespace nt
