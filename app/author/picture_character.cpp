// SPDX-License-Identifier: Apache-2.0
#include "app/author/picture_character.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/author/assemble.h"
#include "app/author/character_file.h"
#include "app/author/figure.h"
#include "app/author/triangulate.h"
#include "core/outline/fourier.h"
#include "platform/camera.h"

namespace nt {
namespace {

std::optional<ToldHead> told_head(const Figure& figure, const std::optional<HeadSide>& head) {
  if (!head) return std::nullopt;
  ToldHead told;
  told.direction = head->direction;
  if (head->fraction) {
    told.point = figure.picture_origin +
                 Vec2{head->fraction->x * figure.picture_size.x, head->fraction->y * figure.picture_size.y};
  }
  return told;
}

std::vector<std::string> notes_on(const Figure& figure, const Proposal& proposal) {
  std::vector<std::string> notes;
  if (figure.paper) notes.push_back("no transparency: the figure was cut out of its paper; check the picture");
  else if (!figure.from_alpha)
    notes.push_back("no transparency: the figure was cut out by its edges; check the picture");
  if (figure.figures > 1)
    notes.push_back("several figures: the largest of " + std::to_string(figure.figures) + " was taken");
  for (const std::string& doubt : doubts_about(proposal)) notes.push_back(doubt);
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
  need(o.harmonics >= 1 && o.harmonics <= kMaxHarmonics, "harmonics must be 1 to 16");
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
  const LandmarkSettings settings{options.u_num, options.l_num, options.harmonics};
  const Proposal proposal =
      propose_landmarks(path, figure.mask, figure.rgba, figure.outline, told_head(figure, options.head), settings);
  const CharacterFrame local(proposal.pose);
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

  Character character = character_of(proposal, local, settings);
  character.vertices = vertices;
  character.texcoords = texcoords;
  character.triangles = mesh.triangles;
  character.texture = picture_of(figure.rgba);
  AuthoredCharacter out;
  out.bytes = character_bytes(character);
  out.report.vertices = static_cast<int>(vertices.size());
  out.report.triangles = static_cast<int>(mesh.triangles.size() / 3);
  out.report.texture_width = figure.rgba.cols, out.report.texture_height = figure.rgba.rows;
  out.report.from_alpha = figure.from_alpha;
  out.report.made_from = figure.from_alpha ? "figure cut out by transparency"
                         : figure.paper    ? "figure cut out of its paper"
                                           : "figure cut out by its edges";
  out.report.proposal = proposal;
  out.report.notes = notes_on(figure, proposal);
  return out;
}

}  // namespace nt
