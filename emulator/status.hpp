// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/net/program.hpp"

#include <chrono>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <unistd.h>

namespace hapnet::emulator {

/// The status line of a terminal; nothing elsewhere.
class Status {
public:
    explicit Status(base::TimePoint now)
        : next_{isatty(STDERR_FILENO) != 0 ? std::optional{now} : std::nullopt}
    {}

    [[nodiscard]] std::optional<base::TimePoint> next_deadline() const { return next_; }

    /// `line` gives the line, when it is time for one.
    void show(const auto& line, base::TimePoint now)
    {
        if (!base::is_due(next_, now)) return;
        next_ = now + std::chrono::milliseconds{500};
        net::tell(fmt::format("\r{}\x1b[K", line()));
    }

    /// Makes room for another line.
    void clear() const
    {
        if (next_) net::tell("\r\x1b[K");
    }

private:
    std::optional<base::TimePoint> next_;
};

} // namespace hapnet::emulator
