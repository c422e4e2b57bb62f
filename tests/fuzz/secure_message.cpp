// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/bytes.hpp"
#include "proto/secure/association.hpp"
#include "tests/fuzz/fuzz_target.hpp"

#include <algorithm>
#include <memory>
#include <vector>

namespace {

using namespace hapnet;
using namespace std::chrono_literals;

secure::Secret secret_of(std::uint8_t number)
{
    secure::Secret secret;
    std::ranges::fill(secret.bytes(), std::byte{number});
    return secret;
}

std::unique_ptr<secure::Association> association(std::uint8_t id)
{
    const auto other = static_cast<std::uint8_t>(3 - id);
    auto keys = secure::StaticKeys::from(secret_of(id), secure::public_key_of(secret_of(other)),
                                         secret_of(9));
    secure::Association::Config config;
    config.own_id = id;
    config.other_id = other;
    config.run = id;
    config.place.emplace();
    config.session_of = [](std::uint32_t low, std::uint32_t high) { return low * 100 + high; };
    return std::make_unique<secure::Association>(config, std::move(*keys), secret_of(id + 100));
}

} // namespace

/// An association with a live key opens nothing that was not sealed for it. The first byte says how
/// the rest is used: as a datagram, or as changes of a genuine message.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const auto input = fuzz::bytes_of(data, size);
    if (input.empty()) return 0;
    const auto a = association(1), b = association(2);
    base::TimePoint now;
    std::vector<std::vector<std::byte>> genuine; // to b
    for (int i = 0; i < 40; ++i, now += 1ms) {
        a->tick({now, 1});
        b->tick({now, 2});
        while (const auto out = a->poll()) {
            genuine.emplace_back(out->frame.bytes().begin(), out->frame.bytes().end());
            auto copy = genuine.back();
            b->on_datagram(copy, {}, now);
        }
        while (const auto out = b->poll()) {
            std::vector<std::byte> copy(out->frame.bytes().begin(), out->frame.bytes().end());
            a->on_datagram(copy, {}, now);
        }
        std::vector<std::byte> hello(101 + secure::control_overhead);
        base::ByteWriter head{hello};
        head.u16(secure::magic);
        head.u8(secure::version);
        head.u8(1);
        if (const auto sealed = a->seal(hello, 101, now)) {
            hello.resize(*sealed);
            genuine.push_back(hello);
            b->on_datagram(hello, {}, now);
        }
    }
    base::ensure(b->has_key(now));
    std::vector<std::byte> datagram{input.begin() + 1, input.end()};
    const auto kind = std::to_integer<std::size_t>(input[0]);
    if (kind % 2 == 1) {
        auto changed = genuine[kind / 2 % genuine.size()];
        for (std::size_t i = 0; i < datagram.size() && i < changed.size(); ++i)
            changed[i] ^= datagram[i];
        datagram = changed;
    }
    const auto opened = b->on_datagram(datagram, {}, now);
    base::ensure(!opened); // what was left as it was has come before
    for (int i = 0; i < 5; ++i) b->tick({now += 1ms, 2});
    return 0;
}
