// SPDX-License-Identifier: Apache-2.0
#include "app/bench/lattice_table.h"

#include <cstdio>
#include <functional>

namespace nt {
namespace {

std::string cell(const char* format, double value) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string padded(const std::string& text, std::size_t width) {
  return text.size() < width ? std::string(width - text.size(), ' ') + text : text;
}

struct Row {
  const char* name;
  const char* format;
  std::function<double(const LatticeFigures&)> ours;
  std::function<double(const PaperFigures&)> paper;  // none: not reported there
};

std::vector<Row> rows() {
  using F = const LatticeFigures&;
  using P = const PaperFigures&;
  const auto d = [](auto v) { return static_cast<double>(v); };
  return {
      {"mesh vertices", "%.0f", [d](F f) { return d(f.mesh_vertices); }, [](P p) { return p.mesh_vertices; }},
      {"mesh triangles", "%.0f", [d](F f) { return d(f.mesh_triangles); }, [](P p) { return p.mesh_triangles; }},
      {"lattice vertices", "%.0f", [d](F f) { return d(f.vertices); }, [](P p) { return p.vertices; }},
      {"tetrahedra", "%.0f", [d](F f) { return d(f.tetrahedra); }, [](P p) { return p.tetrahedra; }},
      {"joints", "%.0f", [d](F f) { return d(f.joints); }, {}},
      {"markers", "%.0f", [d](F f) { return d(f.markers); }, {}},
      {"order, pattern, weights, ms", "%.1f", [](F f) { return f.order_ms; }, {}},
      {"factorise, us", "%.0f", [](F f) { return f.factorise_us; }, [](P p) { return p.factorise_s * 1e6; }},
      {"iteration, us", "%.1f", [](F f) { return f.iteration_us; }, [](P p) { return p.update_s * 1e6; }},
      {"frame of 10, us", "%.0f", [](F f) { return f.frame_us; }, {}},
      {"memcpy of the mesh, us", "%.1f", [](F f) { return f.memcpy_us; }, {}},
      {"embedding, linear, us", "%.1f", [](F f) { return f.linear_us; }, {}},
      {"embedding, Phong (Green), us", "%.1f", [](F f) { return f.phong_us; }, [](P p) { return p.embed_s * 1e6; }},
      {"solver, bytes", "%.0f", [d](F f) { return d(f.solver_bytes); }, {}},
      {"frames", "%.0f", [d](F f) { return d(f.frames); }, {}},
      {"RRMS_E, mean", "%.3f", [](F f) { return f.rrms; }, [](P p) { return p.rrms; }},
      {"RRMS_E, worst frame", "%.3f", [](F f) { return f.worst_rrms; }, {}},
      {"RE_V, mean", "%.3f", [](F f) { return f.volume; }, [](P p) { return p.volume; }},
      {"RE_V, worst frame", "%.3f", [](F f) { return f.worst_volume; }, {}},
      {"E_ED, sum over edges, mean", "%.1e", [](F f) { return f.bone_sum; }, [](P p) { return p.bone_sum; }},
      {"longest bone edge's error", "%.1e", [](F f) { return f.worst_bone; }, {}},
      {"inverted tetrahedra, worst", "%.0f", [d](F f) { return d(f.worst_inverted); }, {}},
      {"largest step / diagonal", "%.4f", [](F f) { return f.largest_step; }, {}},
  };
}

}  // namespace

std::string lattice_table(const std::vector<LatticeColumn>& columns, bool with_paper) {
  constexpr std::size_t kName = 30, kColumn = 14;
  const auto line = [&](const std::string& name, const std::function<std::string(const LatticeColumn&)>& ours,
                        const std::function<std::string(const PaperFigures&)>& paper) {
    std::string text = name + std::string(kName > name.size() ? kName - name.size() : 0, ' ');
    for (const LatticeColumn& c : columns) text += padded(ours(c), kColumn);
    for (const PaperFigures& p : kPaperTable) {
      if (with_paper) text += padded(paper(p), kColumn);
    }
    return text + "\n";
  };
  std::string text = line(
      "", [](const LatticeColumn& c) { return c.name; },
      [](const PaperFigures& p) { return std::string("[L] ") + p.name; });
  for (const Row& row : rows()) {
    text += line(
        row.name, [&](const LatticeColumn& c) { return cell(row.format, row.ours(c.figures)); },
        [&](const PaperFigures& p) { return row.paper ? cell(row.format, row.paper(p)) : std::string("-"); });
  }
  return text;
}

Json lattice_json(const LatticeColumn& column) {
  Json json{{"name", column.name}};
  for (const Row& row : rows()) json[row.name] = row.ours(column.figures);
  return json;
}

}  // namespace nt
