// SPDX-License-Identifier: Apache-2.0
// Tells systemd that the program is up, and that it still is (Type=notify and WatchdogSec= of a unit).
//
// NOTIFY_SOCKET and WATCHDOG_USEC of the environment -> datagrams "READY=1", "WATCHDOG=1", as sd_notify(3) describes them;
// without these variables nothing at all. Cost: one system call every third of the watchdog's time.
#pragma once
#include <cstdint>
#include <string>

namespace nt {

class ServiceNotice {
 public:
  ServiceNotice();
  ~ServiceNotice();
  ServiceNotice(const ServiceNotice&) = delete;
  ServiceNotice& operator=(const ServiceNotice&) = delete;
  // Once a round of the frame loop: the first says that the service is ready.
  void alive(int64_t now_ns);

 private:
  void send(const std::string& text) const;

  int socket_ = -1;
  std::string address_;  // with a NUL in place of the "@" of an abstract one
  int64_t period_ns_ = 0, last_ns_ = 0;
  bool ready_ = false;
};

}  // namespace nt
