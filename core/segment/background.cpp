// SPDX-License-Identifier: Apache-2.0
#include "core/segment/background.h"

#include "core/segment/backlit.h"
#include "core/segment/still.h"
#include "core/segment/vibe.h"
#include "core/segment/vibe_colour.h"

namespace nt {

Result<Background*> Background::create(Arena& arena, const Limits& limits, const BackgroundSettings& settings,
                                       int width, int height, uint64_t seed) {
  if (width < 1 || height < 1 || width > limits.max_width || height > limits.max_height)
    return Status{StatusCode::bad_argument, "the frame does not fit Limits::max_width x max_height: raise them"};
  Background* model = nullptr;
  switch (settings.kind) {
    case BackgroundKind::vibe:
      model = Vibe::create(arena, settings, width, height, seed);
      break;
    case BackgroundKind::vibe_colour:
      model = VibeColour::create(arena, settings, width, height, seed);
      break;
    case BackgroundKind::still:
      model = Still::create(arena, settings, width, height);
      break;
    case BackgroundKind::backlit:
      model = Backlit::create(arena, settings, width, height);
      break;
  }
  if (model == nullptr && !arena.measuring())
    return Status{StatusCode::out_of_memory, "the memory handed to core is smaller than bytes_needed()"};
  return model;
}

}  // namespace nt
