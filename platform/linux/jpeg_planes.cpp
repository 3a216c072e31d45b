// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/jpeg_planes.h"

#include <turbojpeg.h>

#include <new>
#include <vector>

namespace nt {
namespace {

class TurboPlanes : public JpegPlanes {
 public:
  TurboPlanes() { renew(); }
  ~TurboPlanes() override { tjDestroy(decoder_); }
  TurboPlanes(const TurboPlanes&) = delete;
  TurboPlanes& operator=(const TurboPlanes&) = delete;

  bool decode(std::span<const uint8_t> jpeg, int width, int height) override {
    if (try_decode(jpeg, width, height)) return true;
    renew();
    return false;
  }
  bool to_rgb(uint8_t* rgb) const override;

 private:
  bool try_decode(std::span<const uint8_t> jpeg, int width, int height);

  // libjpeg-turbo 2.1.5 leaves a decoder whose header was damaged in a state in which it refuses sound pictures too.
  void renew() {
    tjDestroy(decoder_);
    decoder_ = tjInitDecompress();
    if (decoder_ == nullptr) throw std::bad_alloc();
  }

  tjhandle decoder_ = nullptr;
  int subsampling_ = -1;
  std::vector<uint8_t> memory_;
};

bool TurboPlanes::try_decode(std::span<const uint8_t> jpeg, int width, int height) {
  const auto bytes = static_cast<unsigned long>(jpeg.size());
  int w = 0, h = 0, subsampling = 0, colours = 0;
  if (tjDecompressHeader3(decoder_, jpeg.data(), bytes, &w, &h, &subsampling, &colours) != 0) return false;
  if (w != width || h != height || (colours != TJCS_YCbCr && colours != TJCS_GRAY)) return false;
  const int count = subsampling == TJSAMP_GRAY ? 1 : 3;
  std::size_t at[4] = {};
  for (int i = 0; i < count; ++i) {
    const unsigned long size = tjPlaneSizeYUV(i, w, 0, h, subsampling);
    if (size == static_cast<unsigned long>(-1)) return false;
    at[i + 1] = at[i] + size;
  }
  memory_.resize(at[count]);
  subsampling_ = subsampling;
  unsigned char* planes[3] = {};
  int strides[3] = {};
  for (int i = 0; i < 3; ++i) {
    planes_[i] = {};
    if (i >= count) continue;
    planes[i] = memory_.data() + at[i];
    strides[i] = tjPlaneWidth(i, w, subsampling);
    planes_[i] = {planes[i], i == 0 ? w : strides[i], i == 0 ? h : tjPlaneHeight(i, h, subsampling), strides[i]};
  }
  // A picture that is cut short or has bad codes in it is filled up by the library, with a warning: not good enough here.
  return tjDecompressToYUVPlanes(decoder_, jpeg.data(), bytes, planes, w, strides, h, 0) == 0;
}

bool TurboPlanes::to_rgb(uint8_t* rgb) const {
  const unsigned char* planes[3] = {planes_[0].data, planes_[1].data, planes_[2].data};
  int strides[3];
  for (int i = 0; i < 3; ++i) strides[i] = static_cast<int>(planes_[i].stride);
  return tjDecodeYUVPlanes(decoder_, planes, strides, subsampling_, rgb, planes_[0].width, 0, planes_[0].height,
                           TJPF_RGB, 0) == 0;
}

}  // namespace
}  // namespace nt

extern "C" __attribute__((visibility("default"))) nt::JpegPlanes* neontetra_jpeg_planes() {
  return new nt::TurboPlanes;
}
