// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/service_manager.hpp"

#include "proto/base/text.hpp"

#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>
#include <tuple>
#include <unistd.h>

namespace hapnet::net {

namespace {

/// Returns the value of a variable and removes it from the environment.
std::string taken(const char* name)
{
    const char* const value = std::getenv(name);
    std::string text{value != nullptr ? value : ""};
    unsetenv(name);
    return text;
}

/// Returns the time within which the manager expects a keep-alive message of this process; 0 if it
/// expects none.
base::Duration patience_of(const std::string& microseconds, const std::string& process)
{
    if (!process.empty() && process != std::to_string(getpid())) return {};
    constexpr std::uint64_t most = std::numeric_limits<std::int64_t>::max() / 1000;
    const auto count = base::parse_count(microseconds, most);
    return std::chrono::microseconds{count ? static_cast<std::int64_t>(*count) : 0};
}

} // namespace

ServiceManager::ServiceManager()
{
    const std::string place = taken("NOTIFY_SOCKET");
    const base::Duration patience = patience_of(taken("WATCHDOG_USEC"), taken("WATCHDOG_PID"));
    // The address is a path, or an abstract name after '@'. Other kinds are not supported.
    const bool is_known = place.starts_with('/') || (place.starts_with('@') && place.size() > 1);
    if (!is_known || place.size() >= sizeof manager_.sun_path) return;
    manager_.sun_family = AF_UNIX;
    std::memcpy(manager_.sun_path, place.data(), place.size());
    if (place.front() == '@') manager_.sun_path[0] = '\0';
    manager_length_ = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + place.size());
    socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    every_ = patience / 2;
    if (socket_ >= 0 && every_ > base::Duration{0}) next_ = base::TimePoint{};
}

ServiceManager::~ServiceManager()
{
    if (socket_ >= 0) close(socket_);
}

void ServiceManager::tell_alive(base::TimePoint now)
{
    if (!base::is_due(next_, now)) return;
    tell("WATCHDOG=1");
    next_ = now + every_;
}

void ServiceManager::tell(std::string_view message) const
{
    if (socket_ < 0) return;
    std::ignore = sendto(socket_, message.data(), message.size(), MSG_NOSIGNAL | MSG_DONTWAIT,
                         reinterpret_cast<const sockaddr*>(&manager_), manager_length_);
}

} // namespace hapnet::net
