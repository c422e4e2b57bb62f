// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/net/clock.hpp"
#include "proto/net/terminal_line.hpp"

#include <cstdio>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <string_view>
#include <unistd.h>

namespace hapnet::bench {

/// Prints the progress of a long bench on stderr: on a terminal one line that changes with each
/// detail, otherwise one line per stage.
class Stages {
public:
    Stages(std::string_view program, int stages) : program_{program}, stages_{stages} {}
    ~Stages() { clear(); }
    Stages(const Stages&) = delete;
    Stages& operator=(const Stages&) = delete;

    void begin(std::string_view stage)
    {
        stage_ = stage;
        ++number_;
        if (line_.is_terminal())
            detail({});
        else
            fmt::print(stderr, "{}\n", text({}));
    }
    /// Prints the next detail of the stage.
    void detail(std::string_view what)
    {
        if (!line_.is_terminal()) return;
        std::fputs(line_.shown(text(what)).c_str(), stderr);
        std::fflush(stderr);
    }

    /// Makes room for other text.
    void clear() { std::fputs(line_.room().c_str(), stderr); }

private:
    [[nodiscard]] std::string text(std::string_view what) const
    {
        const std::chrono::duration<double> elapsed = net::monotonic_now() - start_;
        return fmt::format("{}: {:.0f} s, {}/{}: {}{}{}", program_, elapsed.count(), number_,
                           stages_, stage_, what.empty() ? "" : ", ", what);
    }

    std::string program_;
    int stages_;
    int number_ = 0;
    std::string stage_;
    net::TerminalLine line_{STDERR_FILENO};
    decltype(net::monotonic_now()) start_ = net::monotonic_now();
};

} // namespace hapnet::bench
