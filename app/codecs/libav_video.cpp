// SPDX-License-Identifier: Apache-2.0
#include "app/codecs/libav_video.h"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "app/export/output_file.h"
#include "platform/camera.h"

namespace nt {
namespace {

constexpr int kIoBufferBytes = 1 << 16;
constexpr int64_t kReserveStep = 1 << 20;
// What a container's index and trailer take: a few tables of 4 to 16 bytes a frame, and a header.
constexpr int64_t kIndexBytesPerFrame = 64;
constexpr int64_t kIndexBytesFixed = 1 << 16;
constexpr int kThreads = 2;

struct Container {
  const char* extension;
  const char* format;
  std::vector<const char*> encoders;  // best first
};

// Encoders by name: by codec, libav may pick one for hardware that is not there.
const std::vector<Container>& containers() {
  static const std::vector<const char*> usual = {"libx264", "libopenh264", "mpeg4"};
  static const std::vector<Container> all = {{".mp4", "mp4", usual},
                                             {".mov", "mov", usual},
                                             {".mkv", "matroska", usual},
                                             {".avi", "avi", usual},
                                             {".webm", "webm", {"libvpx-vp9", "libvpx"}}};
  return all;
}

const Container& container_for(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::string known;
  for (const Container& container : containers()) {
    if (extension == container.extension) return container;
    known += (known.empty() ? "" : " ") + std::string(container.extension);
  }
  throw UserError("cannot write " + path + ": a video's name must end in one of " + known, 2);
}

const AVCodec* encoder_for(const Container& container, const std::string& path) {
  for (const char* name : container.encoders) {
    if (const AVCodec* codec = avcodec_find_encoder_by_name(name)) return codec;
  }
  throw UserError("cannot write " + path + ": FFmpeg here has no encoder for " + container.extension +
                  "; use .mp4 or .mkv");
}

// Television rates are n * 1000/1001 and are usually given rounded (29.97, 23.98).
AVRational rate_of(double fps) {
  const double whole = std::round(fps);
  if (std::abs(fps - whole) < 1e-6) return {static_cast<int>(whole), 1};
  const double ntsc = std::round(fps * 1.001);
  if (std::abs(fps * 1.001 - ntsc) < 0.005) return {static_cast<int>(ntsc) * 1000, 1001};
  return av_d2q(fps, 100000);
}

std::string av_text(int code) {
  char text[AV_ERROR_MAX_STRING_SIZE] = {};
  av_strerror(code, text, sizeof text);
  return text;
}

struct Freer {
  void operator()(AVFrame* p) const { av_frame_free(&p); }
  void operator()(AVPacket* p) const { av_packet_free(&p); }
  void operator()(AVCodecContext* p) const { avcodec_free_context(&p); }
  void operator()(AVFormatContext* p) const { avformat_free_context(p); }
  void operator()(SwsContext* p) const { sws_freeContext(p); }
  void operator()(AVIOContext* p) const {
    av_freep(&p->buffer);
    avio_context_free(&p);
  }
};
template <class T>
using Owned = std::unique_ptr<T, Freer>;

// libav's view of an OutputFile.
struct Sink {
  OutputFile file;
  int64_t at = 0;
  explicit Sink(const std::string& path) : file(path) {}
  static int write(void* self, uint8_t* bytes, int count) {
    auto& sink = *static_cast<Sink*>(self);
    if (!sink.file.write_at(sink.at, {bytes, static_cast<std::size_t>(count)})) return AVERROR(sink.file.error());
    sink.at += count;
    return count;
  }
  static int64_t seek(void* self, int64_t offset, int whence) {
    auto& sink = *static_cast<Sink*>(self);
    const int how = whence & ~AVSEEK_FORCE;
    if (how == AVSEEK_SIZE) return sink.file.size();
    if (how == SEEK_CUR) offset += sink.at;
    if (how == SEEK_END) offset += sink.file.size();
    return offset < 0 ? AVERROR(EINVAL) : (sink.at = offset);
  }
};

struct LibavVideo final : VideoFile {
  std::string path;
  int width, height;
  const Container& container;
  const AVCodec* codec;
  Sink sink;
  Owned<AVIOContext> io;
  Owned<AVFormatContext> format;
  Owned<AVCodecContext> encoder;
  Owned<AVFrame> picture;
  Owned<AVPacket> packet;
  Owned<SwsContext> scaler;
  AVStream* stream = nullptr;  // the format's
  int64_t added = 0, written = 0;
  bool open = false;
  std::string failure;

  LibavVideo(const std::string& name, int w, int h, double fps)
      : path(name),
        width(w),
        height(h),
        container(container_for(name)),
        codec(encoder_for(container, name)),
        sink(checked(name, w, h, fps)) {
    av_log_set_level(AV_LOG_QUIET);
    open_encoder(fps);
    open_container();
    open = true;
  }

  static const std::string& checked(const std::string& name, int w, int h, double fps) {
    const std::string cannot = "cannot write " + name + ": ";
    if (w < 2 || h < 2 || w > 16384 || h > 16384) {
      throw UserError(cannot + "a video of " + std::to_string(w) + "x" + std::to_string(h) +
                      " pixels cannot be; use 2x2 to 16384x16384");
    }
    if (!(fps >= 0.01 && fps <= 10000)) throw UserError(cannot + "the frame rate must lie between 0.01 and 10000");
    return name;
  }

  [[noreturn]] void cannot_open(const std::string& what, int code) const {
    throw UserError("cannot write " + path + ": " + what + " (" + av_text(code) + ")");
  }

  void open_encoder(double fps) {
    const AVRational rate = rate_of(fps);
    encoder.reset(avcodec_alloc_context3(codec));
    encoder->width = width & ~1;
    encoder->height = height & ~1;
    encoder->pix_fmt = AV_PIX_FMT_YUV420P;
    encoder->framerate = rate;
    encoder->time_base = av_inv_q(rate);
    encoder->gop_size = std::clamp(static_cast<int>(std::lround(2 * fps)), 2, 250);
    encoder->max_b_frames = 0;  // AVI has no place for reordered times, and a cut file then ends at a whole frame
    encoder->thread_count = kThreads;
    encoder->color_range = AVCOL_RANGE_MPEG;
    encoder->colorspace = AVCOL_SPC_SMPTE170M;
    set_quality();
    // The header must carry the stream's parameters in these containers.
    if (std::string(container.format) != "avi") encoder->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    const int code = avcodec_open2(encoder.get(), codec, nullptr);
    if (code < 0) cannot_open(std::string(codec->name) + " does not take these frames", code);
    picture.reset(av_frame_alloc());
    picture->format = encoder->pix_fmt;
    picture->width = encoder->width;
    picture->height = encoder->height;
    packet.reset(av_packet_alloc());
    scaler.reset(sws_getContext(encoder->width, encoder->height, AV_PIX_FMT_RGB24, encoder->width, encoder->height,
                                encoder->pix_fmt, SWS_BICUBIC | SWS_ACCURATE_RND, nullptr, nullptr, nullptr));
    if (av_frame_get_buffer(picture.get(), 0) < 0 || !scaler)
      cannot_open("there is no memory for a frame", AVERROR(ENOMEM));
  }

  // Sharp thin lines at a rate that two cores keep up with.
  void set_quality() {
    const std::string name = codec->name;
    if (name == "mpeg4" || name == "libopenh264") {
      encoder->flags |= AV_CODEC_FLAG_QSCALE;
      encoder->global_quality = FF_QP2LAMBDA * 3;
      encoder->bit_rate = static_cast<int64_t>(encoder->width) * encoder->height * 8;
    } else if (name == "libx264") {
      av_opt_set(encoder->priv_data, "preset", "veryfast", 0);
      av_opt_set(encoder->priv_data, "crf", "18", 0);
    } else {
      av_opt_set(encoder->priv_data, "crf", "20", 0);
      av_opt_set(encoder->priv_data, "deadline", "realtime", 0);
      av_opt_set(encoder->priv_data, "cpu-used", "6", 0);
    }
  }

  void open_container() {
    const std::string url =
        "file:" + std::filesystem::absolute(path).string();  // faststart opens it a second time, to read
    AVFormatContext* raw = nullptr;
    const int made = avformat_alloc_output_context2(&raw, nullptr, container.format, url.c_str());
    if (made < 0) cannot_open("FFmpeg here cannot write " + std::string(container.extension), made);
    format.reset(raw);
    auto* buffer = static_cast<uint8_t*>(av_malloc(kIoBufferBytes));
    io.reset(avio_alloc_context(buffer, kIoBufferBytes, 1, &sink, nullptr, &Sink::write, &Sink::seek));
    format->pb = io.get();
    format->flags |= AVFMT_FLAG_CUSTOM_IO;
    stream = avformat_new_stream(format.get(), nullptr);
    stream->time_base = encoder->time_base;
    stream->avg_frame_rate = stream->r_frame_rate = encoder->framerate;
    avcodec_parameters_from_context(stream->codecpar, encoder.get());
    AVDictionary* options = nullptr;
    av_dict_set(&options, "movflags", "+faststart", 0);
    int code = avformat_write_header(format.get(), &options);
    av_dict_free(&options);
    avio_flush(io.get());
    if (code >= 0 && io->error < 0) code = io->error;
    if (sink.file.error() != 0) throw UserError(sink.file.error_line() + "; no frame was written");
    if (code < 0) cannot_open("its header was refused", code);
  }

  void add(std::span<const uint8_t> rgb) override {
    if (!failure.empty()) throw UserError(failure);
    if (!open) throw UserError("cannot write " + path + ": it is finished already");
    if (rgb.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3) {
      throw UserError("cannot write " + path + ": a frame is not " + std::to_string(width) + "x" +
                      std::to_string(height));
    }
    if (av_frame_make_writable(picture.get()) < 0) fail("out of memory");
    const uint8_t* const planes[] = {rgb.data()};
    const int strides[] = {width * 3};
    sws_scale(scaler.get(), planes, strides, 0, encoder->height, picture->data, picture->linesize);
    picture->pts = added++;
    picture->quality = encoder->global_quality;
    encode(picture.get());
  }

  // Null drains the encoder.
  void encode(const AVFrame* frame) {
    int code = avcodec_send_frame(encoder.get(), frame);
    if (code < 0) fail(av_text(code));
    while ((code = avcodec_receive_packet(encoder.get(), packet.get())) >= 0) write_packet();
    if (code != AVERROR(EAGAIN) && code != AVERROR_EOF) fail(av_text(code));
  }

  void write_packet() {
    const int64_t needed = std::max(sink.file.size(), avio_tell(io.get())) + packet->size + kIndexBytesFixed +
                           kIndexBytesPerFrame * (written + 1);
    if (!sink.file.reserve((needed / kReserveStep + 1) * kReserveStep) && !sink.file.reserve(needed)) fail("");
    packet->stream_index = stream->index;
    packet->duration = 1;
    av_packet_rescale_ts(packet.get(), encoder->time_base, stream->time_base);
    const int code = av_write_frame(format.get(), packet.get());
    av_packet_unref(packet.get());
    if (code < 0 || sink.file.error() != 0) fail(av_text(code < 0 ? code : AVERROR(sink.file.error())));
    ++written;
  }

  // Closes the file as well as it can be closed, then tells.
  [[noreturn]] void fail(const std::string& what) {
    const std::string line = sink.file.error() != 0 ? sink.file.error_line() : "cannot write " + path + ": " + what;
    failure = line + "; " + std::to_string(written) + " frames were written, the file is cut there";
    open = false;
    av_write_trailer(format.get());
    avio_flush(io.get());
    sink.file.close();
    throw UserError(failure);
  }

  ~LibavVideo() override {
    try {
      finish();
    } catch (const UserError&) {  // who wanted to know called finish()
    }
  }
  int64_t frames_written() const override { return written; }
  const char* codec_name() const override { return codec->name; }

  void finish() override {
    if (!open) return;
    encode(nullptr);
    open = false;
    const int code = av_write_trailer(format.get());
    avio_flush(io.get());
    if (code >= 0 && sink.file.error() == 0 && sink.file.close()) return;
    const std::string line =
        sink.file.error() != 0 ? sink.file.error_line() : "cannot write " + path + ": " + av_text(code);
    sink.file.close();
    failure = line + "; its index is missing after " + std::to_string(written) + " frames, and it may not play";
    throw UserError(failure);
  }
};

}  // namespace

std::unique_ptr<VideoFile> open_libav_video(const std::string& path, int width, int height, double fps) {
  return std::make_unique<LibavVideo>(path, width, height, fps);
}

const char* h264_encoder_name() {
  const AVCodec* found = avcodec_find_encoder(AV_CODEC_ID_H264);
  return found != nullptr ? found->name : nullptr;
}

}  // namespace nt
