// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/service_notice.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace nt {
namespace {

// What systemd is to a service: a socket with an abstract address.
class Listener {
 public:
  Listener() : socket_(socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0)) {
    const std::string name = "neontetra-test-" + std::to_string(getpid());
    sockaddr_un at{};
    at.sun_family = AF_UNIX;
    std::memcpy(at.sun_path + 1, name.data(), name.size());
    const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
    EXPECT_EQ(bind(socket_, reinterpret_cast<sockaddr*>(&at), length), 0);
    setenv("NOTIFY_SOCKET", ("@" + name).c_str(), 1);
  }
  ~Listener() {
    close(socket_);
    for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) unsetenv(name);
  }
  std::vector<std::string> heard() const {
    std::vector<std::string> all;
    char text[64];
    for (ssize_t n = 0; (n = recv(socket_, text, sizeof text, 0)) >= 0;)
      all.emplace_back(text, static_cast<std::size_t>(n));
    return all;
  }

 private:
  int socket_;
};

TEST(ServiceNotice, SaysReadyOnceAndThenFeedsTheWatchdogInTime) {
  const Listener systemd;
  setenv("WATCHDOG_USEC", "30000000", 1);
  setenv("WATCHDOG_PID", std::to_string(getpid()).c_str(), 1);
  {
    ServiceNotice notice;
    EXPECT_TRUE(systemd.heard().empty());  // nothing before the first picture
    for (int second = 0; second <= 60; ++second) notice.alive(second * 1'000'000'000LL);
    const std::vector<std::string> heard = systemd.heard();
    ASSERT_EQ(heard.size(), 7u);  // ready, then one in ten seconds
    EXPECT_EQ(heard[0], "READY=1");
    for (std::size_t i = 1; i < heard.size(); ++i) EXPECT_EQ(heard[i], "WATCHDOG=1");
  }
  EXPECT_EQ(systemd.heard(), std::vector<std::string>{"STOPPING=1"});
}

TEST(ServiceNotice, TheWatchdogOfAnotherProcessIsNotFed) {
  const Listener systemd;
  setenv("WATCHDOG_USEC", "3000000", 1);
  setenv("WATCHDOG_PID", "1", 1);
  ServiceNotice notice;
  for (int second = 0; second <= 10; ++second) notice.alive(second * 1'000'000'000LL);
  EXPECT_EQ(systemd.heard(), std::vector<std::string>{"READY=1"});
}

TEST(ServiceNotice, WithoutSystemdNothingIsSaid) {
  ServiceNotice notice;
  notice.alive(0);
  setenv("NOTIFY_SOCKET", "/nonexistent/socket", 1);
  ServiceNotice nobody_listens;
  nobody_listens.alive(0);
  unsetenv("NOTIFY_SOCKET");
}

}  // namespace
}  // namespace nt
