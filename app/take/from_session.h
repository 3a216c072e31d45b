// SPDX-License-Identifier: Apache-2.0
// What a take keeps of a session: its description, and a row for a fish in an observation; its frame is the camera's own count.
#pragma once
#include "app/observation.h"
#include "app/take/take.h"

namespace nt {

TakeInfo take_info(const Session& session, const std::string& name);  // created: now
TakeFrame take_frame(const Observation& seen, int fish);

}  // namespace nt
