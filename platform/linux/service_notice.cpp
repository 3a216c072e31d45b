// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/service_notice.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>

namespace nt {

ServiceNotice::ServiceNotice() {
  const char* address = std::getenv("NOTIFY_SOCKET");
  if (address == nullptr || (address[0] != '/' && address[0] != '@')) return;
  address_ = address;
  if (address_.size() >= sizeof(sockaddr_un{}.sun_path)) return;
  if (address_[0] == '@') address_[0] = '\0';
  socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  // Meant for another process of the service where it names one.
  const char* pid = std::getenv("WATCHDOG_PID");
  const char* watchdog_us = std::getenv("WATCHDOG_USEC");
  if (watchdog_us != nullptr && (pid == nullptr || std::atol(pid) == getpid()))
    period_ns_ = std::atoll(watchdog_us) * 1000 / 3;
}

ServiceNotice::~ServiceNotice() {
  if (socket_ < 0) return;
  if (ready_) send("STOPPING=1");
  close(socket_);
}

void ServiceNotice::alive(int64_t now_ns) {
  if (socket_ < 0) return;
  if (!ready_) send("READY=1");
  else if (period_ns_ > 0 && now_ns - last_ns_ >= period_ns_) send("WATCHDOG=1");
  else return;
  ready_ = true;
  last_ns_ = now_ns;
}

void ServiceNotice::send(const std::string& text) const {
  sockaddr_un to{};
  to.sun_family = AF_UNIX;
  std::memcpy(to.sun_path, address_.data(), address_.size());
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + address_.size());
  // systemd that does not listen is no reason to stop showing fish.
  (void)sendto(socket_, text.data(), text.size(), MSG_NOSIGNAL, reinterpret_cast<const sockaddr*>(&to), length);
}

}  // namespace nt
