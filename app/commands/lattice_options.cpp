// SPDX-License-Identifier: Apache-2.0
#include "app/commands/lattice_options.h"

#include <CLI/CLI.hpp>

#include "app/author/figure_frame.h"
#include "app/author/marker_places.h"
#include "app/author/skeleton_file.h"
#include "app/author/triangle_mesh.h"
#include "app/mocap/registration.h"
#include "platform/camera.h"

namespace nt {
namespace {

// The markers of a recording's frame, registered to the mesh; in the mesh file's axes.
std::vector<MarkerSpec> recorded_markers(const LatticeRequest& request, const TriangleMesh& mesh) {
  const MarkerFile file = read_recording(request.markers, request.choice);
  std::vector<Vec3> seen;
  std::vector<MarkerSpec> out;
  for (const std::size_t m : chosen_markers(file, request.choice)) {
    const Vec3 p = file.frame(static_cast<std::size_t>(request.choice.frame))[m];
    if (!is_seen(p))
      throw UserError("marker '" + file.names[m] + "' is not seen in that --frame; leave it out by --only");
    seen.push_back(p);
    out.push_back({file.names[m], p});
  }
  std::vector<Quat> turns;
  if (!request.choice.axes.empty()) turns = {parse_axes(request.choice.axes)};
  const Registration registration = register_markers(seen, cleaned(mesh).positions, turns);
  for (MarkerSpec& m : out) m.position = registration(m.position);
  return out;
}

}  // namespace

void add_lattice_options(CLI::App& command, LatticeRequest& request) {
  command.add_flag("--lattice", request.wanted,
                   "give a 3D character a lattice of tetrahedra, for --deformer lattice and `neontetra markers`; "
                   "--vertices then are the lattice's (default 450)");
  command
      .add_option("--skeleton", request.skeleton,
                  "its joints: text (docs/FORMATS.md), a glTF skin, a BVH, or auto: curves along its limbs; "
                  "default: a swimmer's midline")
      ->type_name("FILE|auto");
  command
      .add_option("--markers", request.markers,
                  "what will move it: a recording, of which one frame is laid on the mesh, or text (docs/FORMATS.md)")
      ->type_name("FILE");
  add_marker_choice(command, request.choice);
  command.add_flag("--stacked", request.stacked, "the lattice's factor for the paper's stacked equations");
}

LatticeAsset lattice_for(const Character& character, const LatticeRequest& request, const std::string& mesh,
                         const FigureFromFile* figure_from_file) {
  LatticeOptions options;
  options.vertices = request.vertices.value_or(kFishLatticeVertices);
  options.form = request.stacked ? LatticeForm::stacked : LatticeForm::arap;
  if (!request.by_markers()) return fish_lattice(character, options);
  if (figure_from_file == nullptr) {
    throw UserError("--skeleton and --markers are in a mesh file's axes; give the mesh, not the character", 2);
  }
  const auto place = [&](Vec3 p) {
    const Vec3 f = (*figure_from_file)(p);
    const Vec2 at = to_character(character.figure, {f.x, f.y});
    return Vec3{at.x, at.y, f.z};
  };
  const TriangleMesh triangles = read_triangles(mesh);
  SkeletonSpec skeleton = skeleton_for(request.skeleton, triangles);
  for (auto& joint : skeleton.joints) joint.position = place(joint.position);
  std::vector<MarkerSpec> markers;
  if (!request.markers.empty()) {
    markers = is_marker_places(request.markers) ? read_marker_places(request.markers, triangles)
                                                : recorded_markers(request, triangles);
  }
  for (MarkerSpec& m : markers) m.position = place(m.position);
  return LatticeAsset(character, skeleton, markers, LatticeDrive::markers, options);
}

}  // namespace nt
