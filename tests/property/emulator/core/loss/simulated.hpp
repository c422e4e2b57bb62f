// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/loss/loss.hpp"
#include "emulator/tools/verify/properties.hpp"

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

namespace hapnet::emulator::test {

inline constexpr base::Duration spacing = std::chrono::milliseconds{1};
inline constexpr double alpha = 1e-6; // the rate of false failures of each of some hundred tests

/// The number of virtual datagrams; more in a soak.
inline std::uint64_t packets()
{
    const char* text = std::getenv("HAPNET_SOAK_PACKETS");
    return text != nullptr ? std::stoull(text) : 1'000'000;
}

/// The losses of one law among datagrams that come 1 ms apart.
inline tools::LossRecord simulated(const LossLaw& law, std::uint64_t count, std::uint64_t seed = 42,
                                   const std::string& direction = "up")
{
    LossProcess process{law, base::Seed{seed}.stream(direction + "/loss")};
    tools::LossRecord record{.lost = {}, .states = {{}}};
    record.lost.reserve(count);
    record.states[0].reserve(count);
    for (std::uint64_t n = 0; n < count; ++n) {
        const auto cause =
            process.on_packet({n, 96, spacing * static_cast<base::Duration::rep>(n)});
        record.lost.push_back(cause ? 1 : 0);
        record.states[0].push_back(process.state());
    }
    return record;
}

} // namespace hapnet::emulator::test
