// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/falcon/kinematics.hpp"
#include "device/falcon/startup.hpp"
#include "tests/fuzz/fuzz_target.hpp"

#include <algorithm>

/// Accepted reports encode to themselves, and give a place whose angles are the reported ones, or
/// none. A start-up ends whatever it receives.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hapnet;
    using namespace device::falcon;
    const auto bytes = fuzz::bytes_of(data, size);
    PacketFinder finder;
    std::uint64_t found = 0;
    for (const std::byte byte : bytes) {
        const auto packet = finder.feed(byte);
        if (!packet) continue;
        ++found;
        if (const auto command = decode_command(*packet)) base::ensure(encode(*command) == *packet);
        const auto report = decode_report(*packet);
        if (!report) continue;
        base::ensure(encode(*report) == *packet);
        const auto place = forward(angles_of(report->encoders), {});
        if (!place) continue;
        base::ensure(base::is_finite(*place));
        base::ensure(encoders_at(inverse(*place).value()) == report->encoders);
    }
    base::ensure(finder.skipped() + found * packet_bytes <= bytes.size());

    Startup startup{{bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size / 2)}};
    auto rest = bytes.subspan(size / 2);
    for (int steps = 0; !std::holds_alternative<Ready>(startup.step()); ++steps) {
        if (std::holds_alternative<Refused>(startup.step())) break;
        base::ensure(steps < 200'000);
        if (!std::holds_alternative<Listen>(startup.step())) {
            startup.on_done();
            continue;
        }
        const auto piece = rest.first(std::min<std::size_t>(rest.size(), 5));
        startup.on_heard(piece);
        rest = rest.subspan(piece.size());
    }
    return 0;
}
