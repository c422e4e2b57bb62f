// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/cli/options.hpp"
#include "peer/loop/servo.hpp"
#include "peer/monitor/device_news.hpp"
#include "peer/monitor/watcher.hpp"
#include "proto/control/server.hpp"

#include <optional>
#include <string>

namespace hapnet::peer {

/// Answers those who are connected to the control socket. The loop does the same whether anybody
/// is: it leaves how it stands every 50 ms, and all else is done here, by the thread that watches
/// it.
class Reception {
public:
    /// All outlive it.
    struct Parts {
        control::Server& server;
        Servo& servo;
        const Options& options;
        const Journal& journal;
        const Watcher& watcher;
        std::string device; // its description
        WaysBack ways_back{};
    };

    explicit Reception(Parts parts);
    ~Reception() = default;
    Reception(const Reception&) = delete;
    Reception& operator=(const Reception&) = delete;

    /// Call it this often. Clients are not looked at in between, so that none can keep the thread
    /// busy: 800 requests a second are answered, whoever asks.
    void serve(base::TimePoint now);
    static constexpr base::Duration every{std::chrono::milliseconds{10}};
    /// A line is ample for what may be asked.
    static constexpr control::Server::Limits limits{.line_bytes = std::size_t{16} << 10,
                                                    .answers = 8};

private:
    [[nodiscard]] control::Subject subject();

    Parts parts_;
    control::Subject subject_;
    std::optional<Standing> standing_; // the newest
    std::optional<base::TimePoint> next_question_;
};

} // namespace hapnet::peer
