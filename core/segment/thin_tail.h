// SPDX-License-Identifier: Apache-2.0
// A tail that grows too thin for the mask -> its pixels, followed along its ridge.
//
// A larva's tail is one or two pixels wide and fades into the noise, so no threshold on single pixels keeps it. Its mean along
// some pixels of its own direction still stands out: from what the outline has, the line goes on to where the picture
// differs from the ground more than beside it, step by step, until nothing stands out.
// luma, background estimate, a place on the tail and its direction -> bits set in the mask (box coordinates). Not in [F], whose fish have broad
// tails: where the tail is broad, its sides differ as much as its middle and nothing is added.
// Cost: some 200 pixels a step; one step, about 1 us, where there is no such tail.
#pragma once
#include "core/base/image_view.h"
#include "core/base/vec2.h"
#include "core/segment/blobs.h"

namespace nt {

struct ThinTail {
  Vec2 from;  // frame pixels: on the tail's middle, a little before the outline ends, which noise may have bent aside
  Vec2 direction;  // of unit length, out of the body
  float most_px;   // how far it may be followed
};

// How far it went on from there, pixels; 0 where nothing stands out by more than the noise's chance.
float follow_thin_tail(LumaView luma, LumaView ground, float noise_sigma, const ThinTail& tail, const Box& box,
                       const BitMask& mask);

}  // namespace nt
