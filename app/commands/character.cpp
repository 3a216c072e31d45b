// SPDX-License-Identifier: Apache-2.0
// neontetra character: a picture or a mesh -> a character file, with what was found in it; a character file -> a corrected one.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>
#include <sstream>
#include <utility>

#include "app/author/character_file.h"
#include "app/author/mesh_character.h"
#include "app/author/mesh_file.h"
#include "app/author/picture_character.h"
#include "app/check_outputs.h"
#include "app/cli.h"
#include "app/commands/character_corrections.h"
#include "app/commands/lattice_options.h"
#include "app/text_file.h"
#include "platform/camera.h"

namespace nt {
namespace {

struct Options {
  std::string input, out, preview;
  std::string head, up;
  std::optional<int> vertices;
  CorrectionOptions correct;
  LatticeRequest lattice;
};

// A character before it is corrected, what is to be said of it, and where its mesh lies in its figure.
struct Proposed {
  LoadedCharacter file;
  std::string found;
  std::optional<FigureFromFile> figure_from_file;
};

std::string found(const PictureReport& report) {
  std::ostringstream text;
  text << report.vertices << " vertices, " << report.triangles << " triangles, texture " << report.texture_width << "x"
       << report.texture_height << ", " << report.made_from << "\n";
  for (const std::string& note : report.notes) text << note << "\n";
  return text.str();
}

bool is_character(const std::string& path) { return path.ends_with(".ntchar"); }

// Numbers that corrections ask for are those that the points are found with.
template <class T>
T with_numbers(T options, const Corrections& corrections) {
  options.u_num = corrections.u_num.value_or(options.u_num);
  options.l_num = corrections.l_num.value_or(options.l_num);
  options.harmonics = corrections.harmonics.value_or(options.harmonics);
  return options;
}

AuthoredCharacter author(const Options& options, const Corrections& corrections) {
  if (!is_mesh_file(options.input)) {
    if (!options.up.empty()) throw UserError("--up is for meshes; a picture's head is told by --head", 2);
    PictureOptions picture = with_numbers(PictureOptions{}, corrections);
    if (options.vertices) picture.vertices = *options.vertices;
    if (!options.head.empty()) picture.head = parse_head_side(options.head);
    return author_picture(options.input, picture);
  }
  MeshOptions mesh = with_numbers(MeshOptions{}, corrections);
  mesh.vertices = options.lattice.wanted ? 0 : options.vertices.value_or(0);
  if (!options.head.empty()) mesh.told.head = parse_axis("--head", options.head);
  if (!options.up.empty()) mesh.told.up = parse_axis("--up", options.up);
  return author_mesh(options.input, mesh);
}

// Where the character goes: --out, or the character file itself that was named. "" for a mere --list.
std::string output_of(const Options& options) {
  if (!options.out.empty()) return options.out;
  const bool changes =
      options.correct.edit || !options.correct.set.empty() || !options.correct.file.empty() || options.lattice.wanted;
  return is_character(options.input) && changes ? options.input : "";
}

void check_options(const Options& options, const std::string& out) {
  if (options.lattice.by_markers() && !options.lattice.wanted)
    throw UserError("character: --skeleton and --markers are a lattice's; add --lattice", 2);
  if (options.lattice.wanted && options.vertices.value_or(0) > Limits{}.max_lattice_vertices) {
    throw UserError("character: --vertices with --lattice are the lattice's, " +
                        std::to_string(Limits{}.max_lattice_vertices) + " at most",
                    2);
  }
  if (options.lattice.wanted && options.correct.edit)
    throw UserError("character: --edit first, then --lattice: it is made for the corrected points", 2);
  const bool vertices = options.vertices && !options.lattice.wanted;
  if (is_character(options.input) && (!options.head.empty() || !options.up.empty() || vertices))
    throw UserError(
        "character: --head, --up and --vertices are for pictures and meshes; say --set head_end=left or X,Y", 2);
  if (out.empty() && !options.correct.list && options.preview.empty())
    throw UserError("character: say where it goes with --out FILE.ntchar, or --list, or --preview", 2);
  if (!out.empty() && !is_character(out)) throw UserError("character: --out must end in .ntchar, not '" + out + "'", 2);
  std::vector<std::string> inputs;
  if (!is_character(options.input)) inputs.push_back(options.input);
  inputs.insert(inputs.end(), {options.lattice.skeleton, options.lattice.markers});
  check_outputs(inputs, {out, options.preview});
}

// What the input holds before it is corrected.
Proposed proposal_of(const Options& options, const std::string& out, const Corrections& corrections) {
  if (is_character(options.input)) return {LoadedCharacter(options.input, Limits{}), "", {}};
  const AuthoredCharacter authored = author(options, corrections);
  const std::string& name = out.empty() ? options.input : out;
  return {LoadedCharacter(authored.bytes, name, Limits{}), name + ": " + found(authored.report),
          authored.figure_from_file};
}

// The lattice that is asked for, or a swimmer's that the input had: it is made anew for the corrected points.
std::optional<LatticeAsset> lattice_of(const Options& options, const Proposed& proposed, const Character& corrected) {
  LatticeRequest request = options.lattice;
  request.vertices = options.vertices;
  const CharacterLattice& had = proposed.file.character().lattice;
  if (!request.wanted && had.present() && had.drive == LatticeDrive::markers) {
    std::fprintf(stderr, "neontetra: the lattice is left out: make it again from the mesh with --lattice\n");
  }
  if (!request.wanted && had.present() && had.drive == LatticeDrive::landmarks) {
    request.wanted = true;
    request.stacked = had.view.form == LatticeForm::stacked;
    request.vertices = static_cast<int>(had.view.vertices.size());
  }
  if (!request.wanted) return std::nullopt;
  const FigureFromFile* place = proposed.figure_from_file ? &*proposed.figure_from_file : nullptr;
  return lattice_for(corrected, request, options.input, place);
}

void make_character(const Options& options) {
  const std::string out = output_of(options);
  check_options(options, out);
  const Corrections corrections = corrections_for(options.correct, out.empty() ? options.input : out);
  Proposed proposal = proposal_of(options, out, corrections);
  const RiggedFigure figure(proposal.file.character());
  const Rig rig = corrected(figure.found_for(corrections), corrections);
  const RiggedCharacter made = figure.with(rig);
  if (!options.preview.empty()) write_preview(options.preview, made.character);
  if (options.correct.list) write_text("-", list_of_points(rig, options.correct.json));
  // Standard output is the list's, where one is asked for; the editor has saved what it saved, whoever listens.
  const auto say = [&](const std::string& text) {
    if (options.correct.list || options.correct.edit) std::fputs(text.c_str(), stderr);
    else write_text("-", text);
  };
  // What the editor saves gets its lattice, too. What is said of a character is said of one that was saved.
  const auto save = [&](const Character& character, const Corrections& by) {
    Character whole = character;
    const std::optional<LatticeAsset> lattice = lattice_of(options, proposal, character);
    if (lattice) whole.lattice = lattice->view();
    save_character(out, whole, by);
    say(std::exchange(proposal.found, "") + (lattice ? describe(*lattice) + "\n" : ""));
  };
  const bool fresh = !is_character(options.input) || !options.correct.set.empty();
  if (!out.empty() && (fresh || !options.correct.edit)) save(made.character, corrections);
  else say(proposal.found);
  if (options.correct.edit) edit_character(out, made.character, corrections, options.correct, save);
}

}  // namespace

void add_character(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("character", "Turn a picture or a 3D mesh into a character that can swim");
  auto options = std::make_shared<Options>();
  command
      ->add_option("input", options->input,
                   "a figure, best with a transparent ground (PNG), or a mesh (GLB, glTF, OBJ, PLY), or a character")
      ->type_name("PICTURE|MESH|FILE.ntchar")
      ->required();
  command->add_option("-o,--out", options->out, "the character file")->type_name("FILE.ntchar");
  command
      ->add_option("--head", options->head,
                   "where the head is: left, right, up, down, or X,Y in shares of the picture (0.9,0.5); "
                   "of a mesh an axis of its file (+x, -x, +y, -y, +z, -z)")
      ->type_name("SIDE");
  command->add_option("--up", options->up, "which axis of a mesh's file is up, away from its belly (+x ... -z)")
      ->type_name("AXIS");
  command
      ->add_option("--vertices", options->vertices,
                   "of the triangles (default 2500 for a picture; a mesh keeps its own, at most 8192); with "
                   "--lattice of the lattice (default 450)")
      ->type_name("N")
      ->check(CLI::Range(100, 8000));
  add_correction_options(*command, options->correct);
  add_lattice_options(*command, options->lattice);
  command->add_option("--preview", options->preview, "the picture with mesh and control points")->type_name("FILE.png");
  command->footer(
      "Example: neontetra character carp.png --out carp.ntchar --preview carp-check.png\n"
      "         neontetra character --edit carp.ntchar");
  command->callback([&action, options] { action = [options] { make_character(*options); }; });
}

}  // namespace nt
