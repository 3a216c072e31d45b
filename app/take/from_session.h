// SPDX-License-Identifier: Apache-2.0
// What a take keeps of a session: its description, and one row of the step just taken; its frame is the camera's own count.
#pragma once
#include "app/session.h"
#include "app/take/take.h"

namespace nt {

TakeInfo take_info(const Session& session, const std::string& name);  // created: now
TakeFrame take_frame(Session& session, int fish);

}  // namespace nt
