// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <optional>
#include <string_view>
#include <sys/socket.h>
#include <sys/un.h>

namespace hapnet::net {

/// Reports the state of the program to the service manager that started it, by sd_notify(3):
/// systemd asks for this with Type=notify and WatchdogSec=. Does nothing if the environment names
/// no manager. Never blocks: a message that the manager has no room for is lost.
class ServiceManager {
public:
    /// Construct it before any thread is started. It removes the variables that it reads from the
    /// environment, so that programs started by this one do not report on its behalf.
    ServiceManager();
    ~ServiceManager();
    ServiceManager(const ServiceManager&) = delete;
    ServiceManager& operator=(const ServiceManager&) = delete;

    void tell_ready() const { tell("READY=1"); }
    /// Tells the manager that the program stops. The manager expects no more signs of life.
    void tell_stopping() const { tell("STOPPING=1"); }
    /// Reports that the critical loop has made progress. Sends a keep-alive message when one is
    /// due, which is twice in the interval that the manager asks for. It may be called at any rate.
    void tell_alive(base::TimePoint now);
    /// Returns the time of the next keep-alive message; nullopt if the manager expects none.
    [[nodiscard]] std::optional<base::TimePoint> next_deadline() const { return next_; }

private:
    void tell(std::string_view message) const;

    int socket_ = -1; // -1: no manager
    sockaddr_un manager_{};
    socklen_t manager_length_ = 0;
    base::Duration every_{};
    std::optional<base::TimePoint> next_;
};

} // namespace hapnet::net
