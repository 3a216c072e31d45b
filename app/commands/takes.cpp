// SPDX-License-Identifier: Apache-2.0
// neontetra takes: what has been recorded; rename, trim, join, delete, repair.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/check_outputs.h"
#include "app/cli.h"
#include "app/export/png.h"
#include "app/export/report.h"
#include "app/take/take.h"
#include "app/text_file.h"

namespace nt {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExtension = ".take";
constexpr const char* kBin = ".deleted-takes";

struct Options {
  std::vector<std::string> paths;
  bool json = false, discard = false, repair = false;
  std::string name, tags, notes, trim, join, thumbnails;
};

// Folders stand for the takes in them.
std::vector<std::string> files_of(const std::vector<std::string>& paths) {
  std::vector<std::string> files;
  for (const std::string& path : paths) {
    if (!fs::is_directory(path)) {
      files.push_back(path);
      continue;
    }
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(path, error)) {
      if (entry.path().extension() == kExtension) files.push_back(entry.path().lexically_normal().string());
    }
    if (error) throw UserError(path + ": cannot look into the folder: " + error.message());
  }
  std::sort(files.begin(), files.end());
  return files;
}

Take open(const std::string& path, Take::Access access) {
  Take take = Take::open(path, access);
  if (take.recovered())
    std::fprintf(stderr, "%s: its recording was cut off; recovered, %.1f s are there\n", path.c_str(),
                 take.summary().seconds);
  return take;
}

Json video_json(const std::string& path, const TakeInfo& info) {
  const std::string video = video_beside(path, info);
  if (video.empty()) return nullptr;
  return {{"file", video}, {"there", fs::exists(video)}, {"first_frame", info.video_first}};
}

Json as_json(const std::string& path, const TakeSummary& take) {
  return {{"file", path},
          {"name", take.info.name},
          {"created", take.info.created},
          {"seconds", take.seconds},
          {"frames", take.frames},
          {"frames_with_pose", take.posed},
          {"fish", take.fish},
          {"camera", take.info.camera},
          {"working_size", {{"width", take.info.width}, {"height", take.info.height}}},
          {"fps", take.info.fps},
          {"character", take.info.character},
          {"px_per_mm", take.info.px_per_mm > 0 ? Json(take.info.px_per_mm) : Json(nullptr)},
          {"video", video_json(path, take.info)},
          {"tags", take.info.tags},
          {"notes", take.info.notes}};
}

void list(const std::vector<std::string>& files, bool json) {
  Json all = Json::array();
  std::string text, bad;
  for (const std::string& file : files) {
    TakeSummary take;
    try {
      take = open(file, Take::Access::read).summary();
    } catch (const UserError& error) {  // one bad file does not hide the others
      if (!bad.empty()) std::fprintf(stderr, "%s\n", bad.c_str());
      bad = error.what();
      continue;
    }
    if (json) {
      all.push_back(as_json(file, take));
      continue;
    }
    char line[160];
    std::snprintf(line, sizeof line, "  %7.1f s  %6lld frames, %lld with a pose  %d fish  %s", take.seconds,
                  static_cast<long long>(take.frames), static_cast<long long>(take.posed), take.fish,
                  take.info.created.c_str());
    const std::string video = video_beside(file, take.info);
    text += file + line + "  " + take.info.name + (take.info.tags.empty() ? "" : "  [" + take.info.tags + "]") +
            (video.empty() ? "" : (fs::exists(video) ? "  with video" : "  its video is missing")) + "\n";
  }
  write_text("-", json ? pretty(all) : text);
  if (!bad.empty()) throw UserError(bad);
}

void change_info(const std::vector<std::string>& files, const Options& options) {
  for (const std::string& file : files) {
    Take take = open(file, Take::Access::edit);
    TakeInfo info = take.info();
    if (!options.name.empty()) info.name = options.name;
    if (!options.tags.empty()) info.tags = options.tags;
    if (!options.notes.empty()) info.notes = options.notes;
    take.set_info(info);
  }
}

void trim(const std::vector<std::string>& files, const std::string& range) {
  long long first = 0, last = 0;
  char end = 0;
  if (std::sscanf(range.c_str(), "%lld:%lld%c", &first, &last, &end) != 2 || first < 0 || last < first)
    throw UserError("--trim: expected FIRST:LAST, frame numbers from 0, got '" + range + "'", 2);
  for (const std::string& file : files) {
    Take take = open(file, Take::Access::edit);
    const int64_t frames = take.summary().frames;
    if (first >= frames)
      throw UserError(file + ": has " + std::to_string(frames) + " frames; --trim " + range + " would leave none");
    const std::size_t edits = take.edits().size();
    if (edits > 0)  // they name frames by the numbers that would change
      throw UserError(file + ": has " + std::to_string(edits) +
                      " edits, which count its frames; trim it in the editor, or take the edits away first: neontetra "
                      "edit " +
                      file + " --clear");
    take.trim(first, last);
  }
}

void join(const std::vector<std::string>& files, const std::string& out) {
  if (files.size() < 2) throw UserError("--join: name at least two takes", 2);
  std::vector<TakeFrame> frames;
  TakeInfo info;
  int64_t next_frame = 0, next_time_ns = 0;
  for (const std::string& file : files) {
    Take take = open(file, Take::Access::read);
    if (frames.empty()) info = take.info();
    if (!take.edits().empty())
      std::fprintf(stderr, "%s: joined as it was recorded, without its %zu edits\n", file.c_str(), take.edits().size());
    if (take.info().width != info.width || take.info().height != info.height || take.info().u_num != info.u_num ||
        take.info().l_num != info.l_num)
      throw UserError(file + ": another working size or number of bones than " + files.front() +
                      "; they cannot be joined");
    const auto period_ns = static_cast<int64_t>(1e9 / take.info().fps);
    int64_t last_frame = next_frame, last_time_ns = next_time_ns;
    for (const int fish : take.fish()) {
      const std::vector<TakeFrame> more = take.frames(fish);
      for (TakeFrame frame : more) {
        if (!frame.recorded) continue;
        frame.motion.time_ns += next_time_ns - more.front().motion.time_ns;
        frame.frame += next_frame;
        last_frame = std::max(last_frame, frame.frame + 1);
        last_time_ns = std::max(last_time_ns, frame.motion.time_ns + period_ns);
        frames.push_back(frame);
      }
    }
    next_frame = last_frame, next_time_ns = last_time_ns;
  }
  info.video.clear();
  Take joined = Take::create(out, info);
  joined.append(frames);
  joined.close();
}

// To its take in the bin, under the take's name there.
void move_video(const std::string& video, const fs::path& take) {
  const fs::path to = take.string() + fs::path(video).extension().string();
  std::error_code error;
  fs::rename(video, to, error);
  if (error) throw UserError(video + ": cannot be moved to " + to.string() + ": " + error.message());
  Take moved = Take::open(take.string(), Take::Access::edit);
  TakeInfo info = moved.info();
  info.video = to.filename().string();
  moved.set_info(info);
  std::fprintf(stderr, "%s: moved to %s\n", video.c_str(), to.c_str());
}

// Into a folder beside it, from where it can be taken back.
void discard(const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    const std::string video = video_beside(file, open(file, Take::Access::edit).info());  // nobody is writing to it
    const fs::path bin = fs::path(file).parent_path() / kBin;
    std::error_code error;
    fs::create_directories(bin, error);
    if (error)
      throw UserError(bin.string() + ": cannot be created: " + error.message() + "; check the rights of its folder");
    fs::path to = bin / fs::path(file).filename();
    for (int n = 2; fs::exists(to); ++n)
      to = bin / (fs::path(file).stem().string() + "-" + std::to_string(n) + kExtension);
    fs::rename(file, to, error);
    if (error) throw UserError(file + ": cannot be moved to " + to.string() + ": " + error.message());
    std::fprintf(stderr, "%s: moved to %s\n", file.c_str(), to.c_str());
    if (!video.empty() && fs::exists(video)) move_video(video, to);
  }
}

void repair(const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    const std::string to = fs::path(file).replace_extension().string() + "-repaired" + kExtension;
    const int64_t frames = repair_take(file, to);
    std::fprintf(stderr, "%s: %lld frames saved to %s; the damaged file is left as it is\n", file.c_str(),
                 static_cast<long long>(frames), to.c_str());
  }
}

// All thumbnails side by side.
void write_thumbnails(const std::vector<std::string>& files, const std::string& out) {
  if (files.size() != 1) throw UserError("--thumbnails: of one take at a time", 2);
  check_outputs(files, {out});
  std::vector<ThumbnailPixels> pictures;
  for (const Thumbnail& thumbnail : open(files.front(), Take::Access::read).thumbnails()) {
    ThumbnailPixels pixels = thumbnail_pixels(thumbnail.bmp);
    if (!pixels.rgb.empty() && (pictures.empty() || pixels.height == pictures.front().height))
      pictures.push_back(std::move(pixels));
  }
  if (pictures.empty()) throw UserError(files.front() + ": there are no thumbnails in it");
  std::vector<uint8_t> rgb;
  int width = 0;
  for (const ThumbnailPixels& p : pictures) width += p.width;
  for (int y = 0; y < pictures.front().height; ++y) {
    for (const ThumbnailPixels& p : pictures)
      rgb.insert(rgb.end(), p.rgb.begin() + y * p.width * 3, p.rgb.begin() + (y + 1) * p.width * 3);
  }
  Picture sheet;
  sheet.pixels = rgb.data(), sheet.width = width, sheet.height = pictures.front().height, sheet.stride = 3 * width;
  sheet.format = PixelFormat::rgb8;
  write_png(out, sheet);
}

void takes(const Options& options) {
  const int actions = static_cast<int>(!options.thumbnails.empty()) + static_cast<int>(options.discard) +
                      static_cast<int>(options.repair) + static_cast<int>(!options.trim.empty()) +
                      static_cast<int>(!options.join.empty());
  if (actions > 1) throw UserError("takes: one of --trim, --join, --delete, --repair, --thumbnails at a time", 2);
  const bool changes = !options.name.empty() || !options.tags.empty() || !options.notes.empty();
  const bool lists = actions == 0 && !changes;
  if (options.paths.empty() && !lists) throw UserError("takes: say which: name the take that is to be changed", 2);
  const std::vector<std::string> files =
      files_of(options.paths.empty() ? std::vector<std::string>{"."} : options.paths);
  if (changes) change_info(files, options);
  if (!options.thumbnails.empty()) write_thumbnails(files, options.thumbnails);
  else if (options.discard) discard(files);
  else if (options.repair) repair(files);
  else if (!options.trim.empty()) trim(files, options.trim);
  else if (!options.join.empty()) join(options.paths, options.join);
  else if (lists) list(files, options.json);
}

}  // namespace

void add_takes(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("takes", "List what has been recorded; rename, trim, join, delete, repair");
  auto options = std::make_shared<Options>();
  command->add_option("paths", options->paths, "takes, or folders of them (a list's default: this folder)")
      ->type_name("FILE...");
  command->add_flag("--json", options->json, "the list for machines");
  command->add_option("--name", options->name, "give a take this name")->type_name("TEXT");
  command->add_option("--tags", options->tags, "its tags, separated by commas")->type_name("TEXT");
  command->add_option("--notes", options->notes, "its notes")->type_name("TEXT");
  command->add_option("--trim", options->trim, "keep these frames only")->type_name("FIRST:LAST");
  command->add_option("--join", options->join, "one after the other, in the order named, into a new take")
      ->type_name("FILE");
  command->add_option("--thumbnails", options->thumbnails, "the take's small pictures side by side in one picture")
      ->type_name("FILE.png");
  command->add_flag("--delete", options->discard, "move to the folder .deleted-takes beside them, with their videos");
  command->add_flag("--repair", options->repair, "save what can be read of a damaged take to FILE-repaired.take");
  command->footer("Example: neontetra takes --trim 30:600 noon.take");
  command->callback([&action, options] { action = [options] { takes(*options); }; });
}

}  // namespace nt
