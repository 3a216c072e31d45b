// SPDX-License-Identifier: Apache-2.0
// The table that libneontetra_codecs.so hands out; see platform/codecs.h.
#include <cstdint>  // libav wants it first

extern "C" {
#include <libavutil/avutil.h>
}

#include <opencv2/imgcodecs.hpp>

#include "app/author/mesh_file.h"
#include "app/author/triangle_mesh.h"
#include "app/codecs/gltf_file.h"
#include "app/codecs/joint_file.h"
#include "app/codecs/libav_video.h"
#include "platform/codecs.h"
#include "platform/sim/decoded_files.h"
#include "platform/sim/quiet_stderr.h"

namespace {

cv::Mat read_picture(const std::string& path, int imread_flags) {
  const nt::QuietStderr quiet;
  return cv::imread(path, imread_flags);
}

bool encode_png(const cv::Mat& bgr, std::vector<uint8_t>& bytes) { return cv::imencode(".png", bgr, bytes); }

}  // namespace

extern "C" __attribute__((visibility("default"))) const nt::Codecs* neontetra_codecs() {
  static constexpr nt::Codecs kTable{nt::open_decoded_files, nt::open_libav_video, read_picture, encode_png,
                                     nt::h264_encoder_name,  av_version_info};
  return &kTable;
}

extern "C" __attribute__((visibility("default"))) void neontetra_read_mesh(const std::string& path,
                                                                           const nt::ToldAxes& told,
                                                                           nt::SourceMesh& mesh) {
  mesh = nt::read_mesh_file(path, told);
}

extern "C" __attribute__((visibility("default"))) void neontetra_read_triangles(const std::string& path,
                                                                                nt::TriangleMesh& mesh) {
  mesh = nt::read_triangles_file(path);
}

extern "C" __attribute__((visibility("default"))) void neontetra_read_joints(const std::string& path,
                                                                             nt::SkeletonSpec& skeleton) {
  skeleton = nt::read_joint_file(path);
}

extern "C" __attribute__((visibility("default"))) void neontetra_write_glb(const nt::SkinnedModel& model,
                                                                           std::vector<uint8_t>& bytes) {
  bytes = nt::write_glb_bytes(model);
}
