// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/omni/tracker.hpp"
#include "device/omni1394/drive.hpp"
#include "device/omni1394/packet.hpp"
#include "device/omni1394/start_sequence.hpp"
#include "tests/fuzz/fuzz_target.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <string>

/// Packets to the device that are accepted encode to themselves; packets of the device that are
/// accepted, one after another, end in a sample whose numbers are finite; a start that is answered
/// with anything comes to an end; a profile is read or complained of.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hapnet;
    namespace omni1394 = device::omni1394;
    const auto bytes = fuzz::bytes_of(data, size);
    if (const auto packet = omni1394::decode_host(bytes)) {
        base::ensure(std::ranges::equal(omni1394::encode(*packet), bytes));
    }

    device::omni::Tracker tracker;
    base::TimePoint now{std::chrono::hours{1}};
    for (auto left = bytes; left.size() >= omni1394::device_packet_bytes_min;
         left = left.subspan(omni1394::device_packet_bytes_min)) {
        now += std::chrono::milliseconds{1};
        const auto packet = omni1394::decode_device(left.first(omni1394::device_packet_bytes_min));
        if (!packet) {
            tracker.on_nonsense();
        } else {
            base::ensure(omni1394::decode_device(omni1394::encode(*packet)) == packet);
            tracker.on_report(
                {packet->counts, packet->docked, packet->buttons, packet->message % 4}, now);
        }
        const device::Sample& sample = tracker.at(now);
        base::ensure(base::is_finite(sample.hip) && base::is_finite(sample.velocity));
    }

    omni1394::StartSequence sequence{{3, 5}, size % 2 == 0};
    auto left = bytes;
    for (int steps = 0; const auto access = sequence.next(); ++steps) {
        base::ensure(steps < 20);
        const auto answer = left.first(access->writes ? 0 : std::min(left.size(), access->size));
        left = left.subspan(answer.size());
        sequence.on_answer(answer);
    }
    base::ensure(sequence.is_done() == sequence.failure().empty());

    std::string text;
    for (const std::byte byte : bytes) text += std::to_integer<char>(byte);
    const auto profile = omni1394::parse_profile(text, "omni.toml");
    base::ensure(profile || !profile.error().message.empty());
    if (profile) {
        const omni1394::Drive drive{omni1394::use_of(*profile, true), *profile};
        const glm::ivec3 words = drive.motor_words({1.0, -2.0, 3.0});
        for (const int joint : {0, 1, 2}) base::ensure(std::abs(words[joint]) <= 2047);
    }
    return 0;
}
