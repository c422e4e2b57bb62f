// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/status.hpp"

#include "proto/base/visible.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/wait.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

void Status::say(std::string_view message)
{
    const std::scoped_lock guard{lock_};
    screen_.put(fmt::format("{}hapnet-emulator: {}\n", line_.room(), base::visible_lines(message)));
}

void Status::finish()
{
    if (const auto room = line_.room(); !room.empty()) screen_.put(room);
    const auto last = net::monotonic_now() + std::chrono::seconds{1};
    while (!screen_.is_done() && net::monotonic_now() < last) {
        net::wait_readable({}, net::monotonic_now() + std::chrono::milliseconds{1});
    }
}

} // namespace hapnet::emulator
