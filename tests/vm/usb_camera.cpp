// SPDX-License-Identifier: Apache-2.0
// usb_camera WIDTH HEIGHT FPS CLIP.yuyv: a USB camera (UVC 1.0, bulk transfers) in user space, on gadgetfs and dummy_hcd.
//
// The kernel's own uvcvideo driver finds it, so V4L2 programs and libcamera see a real camera that shows the clip's frames,
// one after another, from the first one each time it is started. Its exposure is automatic until it is told otherwise; what it is
// told is printed. SIGUSR1: it falls silent until it is started again; SIGUSR2: for good. Runs until it is killed: then the camera
// is unplugged.
// (The kernel's f_uvc gadget wants isochronous transfers, which dummy_hcd does not have.)
// Sources: USB Device Class Definition for Video Devices 1.0; linux/usb/gadgetfs.h.
#include <fcntl.h>
#include <linux/usb/ch9.h>
#include <linux/usb/gadgetfs.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

namespace {

using Bytes = std::vector<uint8_t>;

constexpr unsigned kPayload = 16384;    // bytes a transfer, header included
constexpr unsigned kControlBytes = 26;  // of a UVC 1.0 probe
constexpr uint8_t kSetCur = 0x01, kGetCur = 0x81, kGetMin = 0x82, kGetMax = 0x83, kGetRes = 0x84, kGetLen = 0x85,
                  kGetInfo = 0x86, kGetDef = 0x87;
constexpr uint8_t kProbe = 1, kCommit = 2;               // of the stream
constexpr uint8_t kExposureMode = 2, kExposureTime = 4;  // of the camera terminal
constexpr uint8_t kManual = 1, kAperturePriority = 8;    // exposure modes
constexpr unsigned kNever = ~0U;

std::atomic<bool> configured{false}, streaming{false};
std::atomic<unsigned> starts{0};        // how often the host started the stream
std::atomic<unsigned> silent_until{0};  // it shows nothing before that start

void put16(Bytes& to, unsigned value) {
  to.push_back(value & 255);
  to.push_back(value >> 8 & 255);
}
void put32(Bytes& to, unsigned value) {
  put16(to, value & 0xffff);
  put16(to, value >> 16);
}
// A descriptor: its first byte is its length.
void add(Bytes& to, Bytes descriptor) {
  descriptor[0] = static_cast<uint8_t>(descriptor.size());
  to.insert(to.end(), descriptor.begin(), descriptor.end());
}

struct Film {
  unsigned width = 0, height = 0, fps = 0;
  Bytes bytes;
  std::size_t frame_bytes() const { return std::size_t{2} * width * height; }
  std::size_t frames() const { return bytes.size() / frame_bytes(); }
  unsigned interval() const { return 10'000'000 / fps; }  // 100 ns
};

Bytes control_interface() {
  Bytes header{0, 0x24, 1};
  put16(header, 0x0100);
  put16(header, 0);  // the total length, below
  put32(header, 48'000'000);
  header.insert(header.end(), {1, 1});
  Bytes camera{0, 0x24, 2, 1};
  put16(camera, 0x0201);
  camera.insert(camera.end(), {0, 0, 0, 0, 0, 0, 0, 0, 3, 0x0a, 0, 0});
  Bytes output{0, 0x24, 3, 3};
  put16(output, 0x0101);
  output.insert(output.end(), {0, 1, 0});
  Bytes all;
  add(all, header);
  add(all, camera);
  add(all, output);
  all[5] = static_cast<uint8_t>(all.size());
  return all;
}

Bytes streaming_interface(const Film& film) {
  const auto frame_bytes = static_cast<unsigned>(film.frame_bytes());
  Bytes header{0, 0x24, 1, 1, 0, 0, 0x81, 0, 3, 0, 0, 0, 1, 0};
  const Bytes format{0, 0x24, 4,    1, 1,    'Y',  'U',  'Y', '2', 0, 0, 0x10, 0, 0x80,
                     0, 0,    0xaa, 0, 0x38, 0x9b, 0x71, 16,  1,   0, 0, 0,    0};
  Bytes frame{0, 0x24, 5, 1, 0};
  put16(frame, film.width);
  put16(frame, film.height);
  put32(frame, frame_bytes * 8);
  put32(frame, frame_bytes * 8 * film.fps);
  put32(frame, frame_bytes);
  put32(frame, film.interval());
  frame.push_back(1);
  put32(frame, film.interval());
  Bytes all;
  add(all, header);
  add(all, format);
  add(all, frame);
  add(all, {0, 0x24, 0x0d, 1, 1, 4});
  all[4] = static_cast<uint8_t>(all.size());
  return all;
}

Bytes configuration(const Film& film, unsigned packet) {
  Bytes all{9, 2, 0, 0, 2, 1, 0, 0xc0, 50};
  add(all, {0, 0x0b, 0, 2, 0x0e, 3, 0, 2});
  add(all, {0, 4, 0, 0, 0, 0x0e, 1, 0, 2});
  for (const uint8_t byte : control_interface()) all.push_back(byte);
  add(all, {0, 4, 1, 0, 1, 0x0e, 2, 0, 0});
  for (const uint8_t byte : streaming_interface(film)) all.push_back(byte);
  Bytes endpoint{0, 5, 0x81, 2};
  put16(endpoint, packet);
  endpoint.push_back(0);
  add(all, endpoint);
  all[2] = static_cast<uint8_t>(all.size()), all[3] = static_cast<uint8_t>(all.size() >> 8);
  return all;
}

int fail(const char* what) {
  std::perror(what);
  return -1;
}

int open_device(const Film& film) {
  const int fd = open("/dev/gadget/dummy_udc", O_RDWR);
  if (fd < 0) return fail("/dev/gadget/dummy_udc");
  Bytes all;
  put32(all, 0);
  for (const unsigned packet : {64u, 512u}) {  // full speed, high speed
    for (const uint8_t byte : configuration(film, packet)) all.push_back(byte);
  }
  Bytes device{18, 1};
  put16(device, 0x0200);
  device.insert(device.end(), {0xef, 2, 1, 64});
  put16(device, 0x1d6b);
  put16(device, 0x0102);
  put16(device, 0x0100);
  device.insert(device.end(), {1, 2, 3, 1});
  all.insert(all.end(), device.begin(), device.end());
  if (write(fd, all.data(), all.size()) != static_cast<ssize_t>(all.size())) return fail("descriptors");
  return fd;
}

int open_endpoint() {
  const int fd = open("/dev/gadget/ep1in-bulk", O_RDWR);
  if (fd < 0) return fail("/dev/gadget/ep1in-bulk");
  Bytes all;
  put32(all, 1);
  for (const unsigned packet : {64u, 512u}) {
    all.insert(all.end(), {7, 5, 0x81, 2});
    put16(all, packet);
    all.push_back(0);
  }
  if (write(fd, all.data(), all.size()) != static_cast<ssize_t>(all.size())) return fail("endpoint");
  return fd;
}

// One picture as payloads with the two-byte header of UVC.
void send(int fd, const uint8_t* picture, std::size_t bytes, uint8_t toggle, unsigned start, Bytes& payload) {
  for (std::size_t at = 0; at < bytes && streaming && starts == start;) {
    std::size_t part = std::min<std::size_t>(kPayload - 2, bytes - at);
    bool last = at + part == bytes;
    // A payload ends with a short packet or at its full size; one that would do neither is cut in two.
    if (last && (part + 2) % 512 == 0 && part + 2 != kPayload) part -= 100, last = false;
    payload[0] = 2, payload[1] = static_cast<uint8_t>(0x80 | toggle | (last ? 2 : 0));
    std::memcpy(&payload[2], picture + at, part);
    if (write(fd, payload.data(), part + 2) < 0) {
      if (errno == EINTR) continue;
      return;
    }
    at += part;
  }
}

void play(const Film& film) {
  using Clock = std::chrono::steady_clock;
  while (!configured) usleep(1000);
  const int fd = open_endpoint();
  if (fd < 0) std::_Exit(1);
  Bytes payload(kPayload);
  uint8_t toggle = 0;
  std::size_t frame = 0;
  unsigned start = 0;
  auto due = Clock::now();
  for (;;) {
    if (!streaming) {
      usleep(2000);
      continue;
    }
    if (starts != start) start = starts, frame = 0, due = Clock::now();
    if (start < silent_until) {
      usleep(2000);
      continue;
    }
    send(fd, &film.bytes[frame++ % film.frames() * film.frame_bytes()], film.frame_bytes(), toggle, start, payload);
    toggle ^= 1;
    // What was late is not made up for: where the host stops the machine for a while, that would be more at once than the ring holds.
    due = std::max(due + std::chrono::nanoseconds(1'000'000'000 / film.fps), Clock::now());
    std::this_thread::sleep_until(due);
  }
}

class ControlPipe {
 public:
  ControlPipe(int fd, const Film& film) : fd_(fd), probe_(kControlBytes) {
    const unsigned interval = film.interval(), payload = kPayload;
    const auto frame_bytes = static_cast<unsigned>(film.frame_bytes());
    probe_[2] = probe_[3] = 1;
    std::memcpy(&probe_[4], &interval, 4);
    std::memcpy(&probe_[18], &frame_bytes, 4);
    std::memcpy(&probe_[22], &payload, 4);
  }

  void serve() {
    for (;;) {
      usb_gadgetfs_event events[4];
      const ssize_t got = read(fd_, events, sizeof events);
      if (got < 0 && errno != EINTR && errno != EIDRM && errno != EL2HLT) std::_Exit(1);
      for (std::size_t i = 0; got > 0 && i < static_cast<std::size_t>(got) / sizeof events[0]; ++i) {
        if (events[i].type == GADGETFS_DISCONNECT) streaming = false;
        if (events[i].type == GADGETFS_SETUP) answer(events[i].u.setup);
      }
    }
  }

 private:
  void answer(const usb_ctrlrequest& request) {
    const unsigned kind = request.bRequestType & 0x60u, selector = request.wValue >> 8;
    if (kind == USB_TYPE_STANDARD) return answer_standard(request);
    const bool to_stream = kind == USB_TYPE_CLASS && (request.wIndex & 255) == 1;
    const bool to_terminal = kind == USB_TYPE_CLASS && request.wIndex == 0x0100;
    if (to_stream && (selector == kProbe || selector == kCommit)) return answer_stream(request, selector);
    if (to_terminal && selector == kExposureMode)
      return answer_control(request, mode_, {"exposure mode", 1, kAperturePriority, 0, 0, kManual | kAperturePriority});
    if (to_terminal && selector == kExposureTime)
      return answer_control(request, time_, {"exposure time", 4, 156, 1, 5000, 1});
    refuse(request);
  }

  void answer_standard(const usb_ctrlrequest& request) {
    static const char* const kTexts[] = {"", "Neontetra", "Simulated USB camera", "0001"};
    if (request.bRequest == USB_REQ_SET_CONFIGURATION) {
      acknowledge();
      if (request.wValue != 0) configured = true;
    } else if (request.bRequest == USB_REQ_SET_INTERFACE) {
      acknowledge();
    } else if (request.bRequest == USB_REQ_GET_INTERFACE) {
      give(request, {0});
    } else if (request.bRequest == USB_REQ_GET_DESCRIPTOR && request.wValue >> 8 == USB_DT_STRING) {
      const unsigned index = request.wValue & 255u;
      if (index >= std::size(kTexts)) return refuse(request);
      Bytes text{0, 3};
      if (index == 0) put16(text, 0x0409);
      for (const char* c = kTexts[index]; *c != '\0'; ++c) put16(text, static_cast<uint8_t>(*c));
      text[0] = static_cast<uint8_t>(text.size());
      give(request, text);
    } else {
      refuse(request);
    }
  }

  void answer_stream(const usb_ctrlrequest& request, unsigned selector) {
    uint8_t ignored[512];
    switch (request.bRequest) {
      case kGetCur:
      case kGetMin:
      case kGetMax:
      case kGetDef:
        return give(request, probe_);
      case kGetRes:
        return give(request, Bytes(kControlBytes));
      case kGetLen:
        return give(request, {kControlBytes, 0});
      case kGetInfo:
        return give(request, {3});
      case kSetCur:
        // There is one mode only, whatever is asked for. EIDRM: a newer request took this one's place.
        if (read(fd_, ignored, std::min<std::size_t>(request.wLength, sizeof ignored)) < 0) return;
        if (selector == kCommit) ++starts, streaming = true;
        return;
      default:
        refuse(request);
    }
  }

  struct Control {
    const char* name;
    unsigned bytes, usual, least, most, step;  // the step of a set of modes is all of them
  };
  void answer_control(const usb_ctrlrequest& request, unsigned& value, const Control& control) {
    switch (request.bRequest) {
      case kGetCur:
        return give(request, number(value, control.bytes));
      case kGetMin:
        return give(request, number(control.least, control.bytes));
      case kGetMax:
        return give(request, number(control.most, control.bytes));
      case kGetDef:
        return give(request, number(control.usual, control.bytes));
      case kGetRes:
        return give(request, number(control.step, control.bytes));
      case kGetInfo:
        return give(request, {3});
      case kSetCur:
        if (read(fd_, &value, std::min<std::size_t>(request.wLength, control.bytes)) < 0) return;
        std::printf("%s %u\n", control.name, value);
        std::fflush(stdout);
        return;
      default:
        refuse(request);
    }
  }
  static Bytes number(unsigned value, unsigned bytes) {
    Bytes all;
    put32(all, value);
    all.resize(bytes);
    return all;
  }

  void give(const usb_ctrlrequest& request, const Bytes& bytes) {
    if (write(fd_, bytes.data(), std::min<std::size_t>(bytes.size(), request.wLength)) < 0)
      std::perror("control write");
  }
  void acknowledge() {
    uint8_t nothing;
    if (read(fd_, &nothing, 0) < 0) std::perror("control acknowledge");
  }
  // A transfer in the wrong direction stalls the pipe.
  void refuse(const usb_ctrlrequest& request) {
    uint8_t nothing = 0;
    const bool to_host = (request.bRequestType & USB_DIR_IN) != 0;
    const ssize_t stalled = to_host ? read(fd_, &nothing, 0) : write(fd_, &nothing, 0);
    if (stalled < 0 && errno != EL2HLT) std::perror("control stall");
  }

  int fd_;
  Bytes probe_;
  unsigned mode_ = kAperturePriority, time_ = 156;  // 156: 15.6 ms
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) return 2;
  Film film;
  film.width = static_cast<unsigned>(std::atoi(argv[1])), film.height = static_cast<unsigned>(std::atoi(argv[2]));
  film.fps = static_cast<unsigned>(std::atoi(argv[3]));
  std::ifstream clip(argv[4], std::ios::binary);
  film.bytes.assign(std::istreambuf_iterator<char>(clip), {});
  if (film.fps == 0 || film.frames() == 0) return 2;
  const int fd = open_device(film);
  if (fd < 0) return 1;
  std::signal(SIGUSR1, [](int) { silent_until = starts + 1; });
  std::signal(SIGUSR2, [](int) { silent_until = kNever; });
  std::thread(play, std::cref(film)).detach();
  // gadgetfs acknowledges a control write before its data was read here; should the next request overtake it, the pipe
  // stalls. With real-time priority, on the machine's only processor, it never does.
  const sched_param priority{50};
  if (sched_setscheduler(0, SCHED_FIFO, &priority) < 0) std::perror("real-time priority");
  ControlPipe(fd, film).serve();
}
