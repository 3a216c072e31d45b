// SPDX-License-Identifier: Apache-2.0
// tinygltf's side of app/export/skinned_model.h; part of libneontetra_codecs.so.
#pragma once
#include "app/export/skinned_model.h"

namespace nt {

std::vector<uint8_t> write_glb_bytes(const SkinnedModel& model);

}  // namespace nt
