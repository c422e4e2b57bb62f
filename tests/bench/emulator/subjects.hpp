// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/net/endpoint.hpp"

#include <spdlog/fmt/fmt.h>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::bench {

/// The places of the compared programs, and the allowed time.
struct Plan {
    std::string emulator; // the path of hapnet-emulator
    std::string self;     // path of this program, which contains the baselines
    bool quick = false;   // ends within a minute; the tails then rest on few datagrams
};

/// A relay under test.
struct Subject {
    std::string_view name;
    std::string_view timing; // timing option of hapnet-emulator; "" for a baseline
    std::string_view relay;  // baseline in this program
};

inline constexpr Subject eco{"hapnet-emulator eco", "eco", ""};
inline constexpr Subject precise{"hapnet-emulator precise", "precise", ""};
inline constexpr Subject spin{"hapnet-emulator spin", "spin", ""};
inline constexpr Subject poll_relay{"poll-relay", "", "poll"};
inline constexpr Subject timerfd_relay{"timerfd-relay", "", "timerfd"};

struct Ends {
    net::Endpoint a;
    net::Endpoint b;
};

/// Returns the command that runs the relay between two ends.
[[nodiscard]] inline std::vector<std::string> command_of(const Subject& subject, const Plan& plan,
                                                         const Ends& ends, base::Duration delay)
{
    const std::vector<std::string> common{"--a",     ends.a.to_text(),
                                          "--b",     ends.b.to_text(),
                                          "--delay", fmt::format("{}ns", delay.count())};
    std::vector<std::string> words =
        subject.timing.empty()
            ? std::vector<std::string>{plan.self, "--relay", std::string{subject.relay}}
            : std::vector<std::string>{plan.emulator,
                                       "--listen-a",
                                       "127.0.0.1:0",
                                       "--listen-b",
                                       "127.0.0.1:0",
                                       "--timing",
                                       std::string{subject.timing}};
    words.insert(words.end(), common.begin(), common.end());
    return words;
}

} // namespace hapnet::bench
