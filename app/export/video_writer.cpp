// SPDX-License-Identifier: Apache-2.0
#include "app/export/video_writer.h"

namespace nt {

VideoWriter::VideoWriter(const std::string& path, int width, int height, double fps)
    : file_(codecs().open_video_file(path, width, height, fps)) {}

void VideoWriter::add(std::span<const uint8_t> rgb) { file_->add(rgb); }
void VideoWriter::finish() { file_->finish(); }
int64_t VideoWriter::frames_written() const { return file_->frames_written(); }
const char* VideoWriter::codec_name() const { return file_->codec_name(); }

}  // namespace nt
