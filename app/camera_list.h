// SPDX-License-Identifier: Apache-2.0
// The cameras of this machine, for people and as JSON, and the option --list-cameras.
#pragma once
#include <CLI/Error.hpp>
#include <string>

#include "app/export/report.h"

namespace nt {

// Several lines, in the manner of rpicam-apps: number, name, how --camera spells it, formats with sizes and rates, controls.
std::string camera_list_text();
Json camera_list_json();

// Thrown while the command line is read, before anything is found missing in it.
struct ListCameras : CLI::Success {
  ListCameras() : CLI::Success("ListCameras", "", CLI::ExitCodes::Success) {}
};
void add_list_cameras(CLI::App& app);

}  // namespace nt
