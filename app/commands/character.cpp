// SPDX-License-Identifier: Apache-2.0
// neontetra character: a picture of a fish -> a character file, with what was found in it.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <sstream>

#include <opencv2/imgproc.hpp>

#include "app/author/character_file.h"
#include "app/author/picture_character.h"
#include "app/check_outputs.h"
#include "app/cli.h"
#include "app/export/png.h"
#include "app/text_file.h"

namespace nt {
namespace {

struct Options {
  std::string picture, out, preview;
  PictureOptions author;
};

cv::Point pixel(Vec2 p) { return {static_cast<int>(std::lround(p.x)), static_cast<int>(std::lround(p.y))}; }

void draw_points(cv::Mat& picture, const Proposal& proposal) {
  const FishPose& pose = proposal.pose;
  const int radius = std::max(3, std::max(picture.cols, picture.rows) / 150);
  const auto point = [&](Vec2 at, cv::Scalar rgb) {
    cv::circle(picture, pixel(at), radius, rgb, cv::FILLED, cv::LINE_AA);
  };
  const cv::Scalar cyan(40, 220, 255), yellow(255, 215, 20), green(20, 210, 60);
  point(pose.centre, {255, 255, 255});
  for (int i = 0; i < pose.u_num; ++i) point(pose.up_axis[i], cyan);
  for (int i = 0; i < pose.l_num; ++i) point(pose.low_axis[i], cyan);
  for (const FinPoints& fin : proposal.fins) {
    if (fin.present) point(fin.tip, green), point(fin.top, yellow), point(fin.bottom, yellow);
  }
  point(pose.head, {240, 40, 30});
  point(pose.tail, {40, 90, 255});
}

// The drawing with its mesh and control points, in the colours of the overlay.
void write_preview(const std::string& path, const Character& character, const Proposal& proposal) {
  const Picture& texture = character.texture;
  const cv::Mat rgba(texture.height, texture.width, CV_8UC4, const_cast<uint8_t*>(texture.pixels),
                     static_cast<std::size_t>(texture.stride));
  cv::Mat picture;
  cv::cvtColor(rgba, picture, cv::COLOR_RGBA2RGB);
  cv::Mat alpha;
  cv::extractChannel(rgba, alpha, 3);
  picture.setTo(cv::Scalar(240, 240, 240), alpha < 8);
  const auto corner = [&](uint32_t i) {
    const Vec2 uv = character.texcoords[i];
    return pixel({uv.x * static_cast<float>(texture.width) - 0.5f, uv.y * static_cast<float>(texture.height) - 0.5f});
  };
  for (std::size_t t = 0; t + 2 < character.triangles.size(); t += 3) {
    const cv::Point a = corner(character.triangles[t]), b = corner(character.triangles[t + 1]),
                    c = corner(character.triangles[t + 2]);
    const std::vector<cv::Point> triangle = {a, b, c};
    cv::polylines(picture, triangle, true, {120, 120, 120}, 1, cv::LINE_AA);
  }
  draw_points(picture, proposal);
  Picture out;
  out.pixels = picture.data, out.width = picture.cols, out.height = picture.rows;
  out.stride = static_cast<int>(picture.step), out.format = PixelFormat::rgb8;
  write_png(path, out);
}

std::string found(const PictureReport& report) {
  std::ostringstream text;
  text << report.vertices << " vertices, " << report.triangles << " triangles, texture " << report.texture_width << "x"
       << report.texture_height << ", figure cut out by " << (report.from_alpha ? "transparency" : "its edges") << "\n";
  for (const std::string& note : report.notes) text << note << "\n";
  return text.str();
}

void make_character(const Options& options) {
  check_outputs({options.picture}, {options.out, options.preview});
  const AuthoredCharacter authored = author_picture(options.picture, options.author);
  const LoadedCharacter loaded(authored.bytes, options.out, Limits{});  // the same checks as when it is used
  write_character_file(options.out, authored.bytes);
  if (!options.preview.empty()) write_preview(options.preview, loaded.character(), authored.report.proposal);
  write_text("-", options.out + ": " + found(authored.report));
}

}  // namespace

void add_character(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("character", "Turn a picture into a character that can swim");
  auto options = std::make_shared<Options>();
  PictureOptions& author = options->author;
  command->add_option("picture", options->picture, "a fish from above, best with a transparent ground (PNG)")
      ->type_name("PICTURE")
      ->required();
  command->add_option("-o,--out", options->out, "the character file")->type_name("FILE.ntchar")->required();
  command
      ->add_option_function<std::string>(
          "--head", [options](const std::string& s) { options->author.head = parse_head_side(s); },
          "where the head is: left, right, up, down, or X,Y in shares of the picture (0.9,0.5)")
      ->type_name("SIDE");
  command->add_option("--vertices", author.vertices, "of the mesh (default 2500)")
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
