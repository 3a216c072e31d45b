// SPDX-License-Identifier: Apache-2.0
// bench_instructions [--check FILE] [--json]
// Instructions that capture executes per frame, counted by valgrind's callgrind: the same on any machine, so that a
// slow-down shows where times scatter. --check compares with the pinned counts in FILE (lines `WxH COUNT`), 2 % either way.
//
// The program films the tank into a file, then runs itself under callgrind to replay it; only counted_step() is counted,
// and only for the last kCounted frames (tests/bench/counted_film.h), in which the fish is there.
#include <sys/wait.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>

#include "core/base/simd_target.h"
#include "core/pipeline/pipeline.h"
#include "tests/bench/counted_film.h"
#include "tests/support/block.h"
#include "tests/support/temp_dir.h"

namespace {

constexpr double kTolerance = 0.02;

// What callgrind counts: its name is given to --toggle-collect.
__attribute__((noinline)) bool counted_step(nt::Capture& capture, const nt::Frame& frame) {
  return capture.step(frame).status == nt::PoseStatus::ok;
}

int replay(const std::string& path, nt::FilmSize size) {
  nt::Limits limits;
  limits.max_width = size.width, limits.max_height = size.height;
  const nt::CaptureSettings settings;
  const nt::test::Block block(nt::Capture::bytes_needed(limits, settings));
  auto made = nt::Capture::create(block.span(), limits, settings, size.width, size.height);
  if (!made.ok()) throw std::runtime_error(made.status().message);
  nt::FilmReader film(path, size);
  int poses = 0;
  for (int n = 0; n < nt::kBefore + nt::kCounted; ++n) {
    const nt::Frame frame = film.next();
    if (n < nt::kBefore) made.value()->step(frame);
    else poses += counted_step(*made.value(), frame);
  }
  std::printf("poses %d\n", poses);
  return poses >= nt::kCounted - 1 ? 0 : 1;  // a run without poses would count little
}

int64_t count(const std::string& self, nt::FilmSize size) {
  const nt::TempDir folder;
  const std::string path = folder / "film.raw";
  nt::shoot_film(path, size);
  const std::string command =
      "valgrind --tool=callgrind --callgrind-out-file=/dev/null '--toggle-collect=*counted_step*' '" + self +
      "' --replay '" + path + "' " + std::to_string(size.width) + " " + std::to_string(size.height) + " 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot start valgrind");
  std::string said;
  int64_t collected = 0;
  char line[512];
  while (std::fgets(line, sizeof line, pipe) != nullptr) {
    said += line;
    if (const char* at = std::strstr(line, "Collected :")) collected = std::atoll(at + 11);
  }
  const int status = pclose(pipe);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || collected <= 0)
    throw std::runtime_error("valgrind did not count (is it installed?): " + said.substr(0, 300));
  return collected / nt::kCounted;
}

std::map<std::string, int64_t> pinned(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::map<std::string, int64_t> counts;
  for (std::string line; std::getline(file, line);) {
    char name[32];
    long long value = 0;
    if (std::sscanf(line.c_str(), "%31s %lld", name, &value) == 2 && name[0] != '#') counts[name] = value;
  }
  return counts;
}

// True when the count is what was pinned.
bool check(const std::string& name, int64_t counted, const std::map<std::string, int64_t>& counts) {
  const auto at = counts.find(name);
  if (at == counts.end()) throw std::runtime_error("no count is pinned for " + name);
  const double ratio = static_cast<double>(counted) / static_cast<double>(at->second);
  const bool kept = std::abs(ratio - 1) <= kTolerance;
  std::printf("%s: pinned %lld, now %+.2f %%%s\n", name.c_str(), static_cast<long long>(at->second), 100 * (ratio - 1),
              kept ? "" : "  <-- more than 2 %");
  return kept;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc == 5 && std::strcmp(argv[1], "--replay") == 0)
    return replay(argv[2], {std::atoi(argv[3]), std::atoi(argv[4])});
  const bool json = argc == 2 && std::strcmp(argv[1], "--json") == 0;
  const bool checks = argc == 3 && std::strcmp(argv[1], "--check") == 0;
  if (argc != 1 && !json && !checks) {
    std::fprintf(stderr, "usage: bench_instructions [--check FILE] [--json]\n");
    return 2;
  }
  const std::string self = std::filesystem::canonical("/proc/self/exe");
  bool kept = true;
  if (json) std::printf("{\"simd\": \"%s\", \"compiler\": \"g++ %s\"", nt::simd_target(), __VERSION__);
  for (const nt::FilmSize size : {nt::FilmSize{960, 544}, nt::FilmSize{320, 180}}) {
    const int64_t counted = count(self, size);
    if (json) std::printf(", \"%s\": %lld", size.name().c_str(), static_cast<long long>(counted));
    else std::printf("%s %lld instructions a frame\n", size.name().c_str(), static_cast<long long>(counted));
    if (checks) kept = check(size.name(), counted, pinned(argv[2])) && kept;
  }
  if (json) std::printf("}\n");
  return kept ? 0 : 1;
} catch (const std::exception& e) {
  std::fprintf(stderr, "bench_instructions: %s\n", e.what());
  return 1;
}
