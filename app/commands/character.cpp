// SPDX-License-Identifier: Apache-2.0
// neontetra character: a picture of a fish -> a character file, with what was found in it.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>
#include <sstream>

#include <opencv2/core.hpp>

#include "app/author/character_file.h"
#include "app/author/mesh_character.h"
#include "app/author/mesh_file.h"
#include "app/author/picture_character.h"
#include "app/author/preview.h"
#include "app/check_outputs.h"
#include "app/cli.h"
#include "app/export/png.h"
#include "app/text_file.h"
#include "platform/camera.h"

namespace nt {
namespace {

struct Options {
  std::string picture, out, preview;
  PictureOptions author;
  std::string head, up;
  std::optional<int> vertices;
};

void write_preview(const std::string& path, const Character& character, const Proposal& proposal) {
  const cv::Mat picture = draw_preview(character, proposal);
  Picture out;
  out.pixels = picture.data, out.width = picture.cols, out.height = picture.rows;
  out.stride = static_cast<int>(picture.step), out.format = PixelFormat::rgb8;
  write_png(path, out);
}

std::string found(const PictureReport& report) {
  std::ostringstream text;
  text << report.vertices << " vertices, " << report.triangles << " triangles, texture " << report.texture_width << "x"
       << report.texture_height << ", " << report.made_from << "\n";
  for (const std::string& note : report.notes) text << note << "\n";
  return text.str();
}

AuthoredCharacter author(const Options& options) {
  if (!is_mesh_file(options.picture)) {
    if (!options.up.empty()) throw UserError("--up is for meshes; a picture's head is told by --head", 2);
    PictureOptions picture = options.author;
    if (options.vertices) picture.vertices = *options.vertices;
    if (!options.head.empty()) picture.head = parse_head_side(options.head);
    return author_picture(options.picture, picture);
  }
  MeshOptions mesh;
  mesh.u_num = options.author.u_num, mesh.l_num = options.author.l_num, mesh.harmonics = options.author.harmonics;
  mesh.vertices = options.vertices.value_or(0);
  if (!options.head.empty()) mesh.told.head = parse_axis("--head", options.head);
  if (!options.up.empty()) mesh.told.up = parse_axis("--up", options.up);
  return author_mesh(options.picture, mesh);
}

void make_character(const Options& options) {
  check_outputs({options.picture}, {options.out, options.preview});
  const AuthoredCharacter authored = author(options);
  const LoadedCharacter loaded(authored.bytes, options.out, Limits{});  // the same checks as when it is used
  write_character_file(options.out, authored.bytes);
  if (!options.preview.empty()) write_preview(options.preview, loaded.character(), authored.report.proposal);
  write_text("-", options.out + ": " + found(authored.report));
}

}  // namespace

void add_character(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("character", "Turn a picture or a 3D mesh into a character that can swim");
  auto options = std::make_shared<Options>();
  PictureOptions& author = options->author;
  command
      ->add_option("picture", options->picture,
                   "a figure, best with a transparent ground (PNG), or a mesh (GLB, glTF, OBJ, PLY)")
      ->type_name("PICTURE|MESH")
      ->required();
  command->add_option("-o,--out", options->out, "the character file")->type_name("FILE.ntchar")->required();
  command
      ->add_option("--head", options->head,
                   "where the head is: left, right, up, down, or X,Y in shares of the picture (0.9,0.5); "
                   "of a mesh an axis of its file (+x, -x, +y, -y, +z, -z)")
      ->type_name("SIDE");
  command->add_option("--up", options->up, "which axis of a mesh's file is up, away from its belly (+x ... -z)")
      ->type_name("AXIS");
  command
      ->add_option("--vertices", options->vertices,
                   "of the triangles (default 2500 for a picture; a mesh keeps its own, at most 8192)")
      ->type_name("N")
      ->check(CLI::Range(100, 8000));
  command->add_option("--u-num", author.u_num, "axis points centre to head (default 3)")
      ->type_name("N")
      ->check(CLI::Range(1, kMaxUpAxis));
  command->add_option("--l-num", author.l_num, "axis points centre to tail (default 15)")
      ->type_name("N")
      ->check(CLI::Range(1, kMaxLowAxis));
  command->add_option("--harmonics", author.harmonics, "elliptic Fourier harmonics of the outline (default 5)")
      ->type_name("N")
      ->check(CLI::Range(1, 16));
  command->add_option("--preview", options->preview, "the picture with mesh and control points")->type_name("FILE.png");
  command->footer("Example: neontetra character carp.png --out carp.ntchar --preview carp-check.png");
  command->callback([&action, options] { action = [options] { make_character(*options); }; });
}

}  // namespace nt
