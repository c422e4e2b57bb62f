// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/loss/loss.hpp"

#include <cstdint>
#include <string>

namespace hapnet::emulator::test {

inline Packet packet(std::uint64_t number, base::Duration spacing = std::chrono::milliseconds{1})
{
    return {number, 96, spacing * static_cast<base::Duration::rep>(number)};
}

/// The fates of datagrams that come 1 ms apart, as a text of 0 and 1.
inline std::string losses(LossProcess& process, std::uint64_t from, std::uint64_t count)
{
    std::string text;
    for (std::uint64_t n = from; n < from + count; ++n) {
        text += process.on_packet(packet(n)) ? '1' : '0';
    }
    return text;
}

inline std::string losses(const LossLaw& law, std::uint64_t count, std::uint64_t seed = 42)
{
    LossProcess process{law, base::Seed{seed}.stream("up/loss/" + std::string{name_of(law)})};
    return losses(process, 0, count);
}

inline base::RandomStream stream() { return base::Seed{42}.stream("up/loss"); }

/// The reason why the law is impossible; empty: it is possible.
inline std::string refusal(const LossLaw& law)
{
    const auto valid = validate(law);
    return valid ? "" : valid.error().message;
}

} // namespace hapnet::emulator::test
