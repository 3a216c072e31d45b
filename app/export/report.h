// SPDX-License-Identifier: Apache-2.0
// The report of a run as JSON and as one line; keys are documented in docs/FORMATS.md and do not change without a new
// number in "format".
#pragma once
#include <string>

#include <nlohmann/json.hpp>

#include "app/session.h"

namespace nt {

using Json = nlohmann::ordered_json;

inline constexpr int kReportFormat = 1;

Json report_json(Session& session);
// Of a latency: median, p99 and most in milliseconds and frame times; null where none was measured.
Json latency_json(const TimeHistogram& latency, double fps);
Json stage_times_json(const Statistics& statistics);
std::string pretty(const Json& json);  // indented, with a line end

// "120 frames, 118 with a pose (98 %); 0.71 ms a frame"
// From the camera's timestamp to the motion, in milliseconds and frame times, for the terminal.
std::string latency_line(const Statistics& statistics, double fps);
std::string summary_line(const Statistics& statistics);

}  // namespace nt
