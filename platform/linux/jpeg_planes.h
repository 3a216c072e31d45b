// SPDX-License-Identifier: Apache-2.0
// A JPEG picture -> its luma and chroma planes, as they are coded: no conversion of colours.
//
// Bytes -> planes of the picture's size (full range), chroma of its own size, or none. Pictures without Huffman tables, as
// cameras send them in MJPEG, are read with the standard ones. Nothing is allocated after the first picture of a size,
// unless one is damaged. The library behind it (libjpeg-turbo) is loaded with the first decoder: a late module.
// Cost: decoding, some 3 ms at 960x544.
#pragma once
#include <cstdint>
#include <memory>
#include <span>

#include "core/base/image_view.h"

namespace nt {

class JpegPlanes {
 public:
  virtual ~JpegPlanes() = default;
  // False where the bytes are no whole, undamaged picture of this size; the planes are then of no use.
  virtual bool decode(std::span<const uint8_t> jpeg, int width, int height) = 0;
  virtual bool to_rgb(uint8_t* rgb) const = 0;  // of the last picture, width x height x 3
  LumaView luma() const { return planes_[0]; }
  LumaView cb() const { return planes_[1]; }  // empty in a grey picture
  LumaView cr() const { return planes_[2]; }

 protected:
  LumaView planes_[3];
};

// Throws UserError where the module is missing.
std::unique_ptr<JpegPlanes> open_jpeg_planes();

}  // namespace nt
