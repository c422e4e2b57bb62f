// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/secure/noise_kk.hpp"
#include "tests/fuzz/fuzz_target.hpp"

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

namespace {

using namespace hapnet;
using secure::NoiseKk;
using secure::Role;

secure::Secret secret_of(std::uint8_t number)
{
    secure::Secret secret;
    std::ranges::fill(secret.bytes(), std::byte{number});
    return secret;
}

secure::StaticKeys keys_of(std::uint8_t own)
{
    const auto other = static_cast<std::uint8_t>(3 - own);
    return *secure::StaticKeys::from(secret_of(own), secure::public_key_of(secret_of(other)),
                                     secret_of(9));
}

const secure::StaticKeys& initiator_keys()
{
    static const secure::StaticKeys keys = keys_of(1);
    return keys;
}

const secure::StaticKeys& responder_keys()
{
    static const secure::StaticKeys keys = keys_of(2);
    return keys;
}

NoiseKk side_of(Role role)
{
    constexpr std::string_view prologue = "hapnet 2";
    const bool begins = role == Role::initiator;
    return {role, begins ? initiator_keys() : responder_keys(), std::as_bytes(std::span{prologue}),
            secret_of(begins ? 101 : 102)};
}

NoiseKk::Progress finish(NoiseKk& side)
{
    auto progress = side.step();
    for (int steps = 1; progress == NoiseKk::Progress::working; ++steps) {
        base::ensure(steps < 4);
        progress = side.step();
    }
    return progress;
}

std::vector<std::byte> written(NoiseKk& side, secure::Bytes payload)
{
    side.write(payload);
    base::ensure(finish(side) == NoiseKk::Progress::done);
    return {side.message().begin(), side.message().end()};
}

void expect_read(NoiseKk& side, secure::Bytes message, secure::Bytes payload)
{
    side.read(message);
    base::ensure(finish(side) == NoiseKk::Progress::done);
    base::ensure(std::ranges::equal(side.payload(), payload));
}

/// Offers messages that an attacker made of a genuine one. Only the genuine message is accepted,
/// before and after the others.
void expect_refused(NoiseKk side, secure::Bytes made_up, secure::Bytes genuine)
{
    if (std::ranges::equal(made_up, genuine)) return;
    side.read(made_up);
    base::ensure(finish(side) == NoiseKk::Progress::refused);
    side.read(genuine);
    base::ensure(finish(side) == NoiseKk::Progress::done);
}

} // namespace

/// Both messages of a handshake carry what was put into them, and any other message in the place of
/// either is refused. The first byte says how the rest is used: as payload, as the message itself,
/// or as a change of the genuine one, from the place that the second byte names.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const auto input = fuzz::bytes_of(data, size);
    if (input.size() < 2) return 0;
    const auto rest = input.subspan(2);
    const auto payload = rest.first(std::min(rest.size(), NoiseKk::payload_bytes_max));

    NoiseKk initiator = side_of(Role::initiator), responder = side_of(Role::responder);
    const auto first = written(initiator, payload);
    expect_read(responder, first, payload);
    const auto second = written(responder, payload);

    const auto made_up = [&](const std::vector<std::byte>& genuine) {
        if (input[0] == std::byte{0}) return std::vector<std::byte>{rest.begin(), rest.end()};
        std::vector<std::byte> changed = genuine;
        if (input[0] == std::byte{1}) { // cut off, or made longer
            changed.resize(std::to_integer<std::size_t>(input[1]));
            return changed;
        }
        const std::size_t from = std::to_integer<std::size_t>(input[1]) % genuine.size();
        for (std::size_t i = 0; i < rest.size() && from + i < changed.size(); ++i)
            changed[from + i] ^= rest[i];
        return changed;
    };
    expect_refused(side_of(Role::responder), made_up(first), first);
    {
        NoiseKk waiting = side_of(Role::initiator);
        base::ensure(written(waiting, payload) == first);
        expect_refused(std::move(waiting), made_up(second), second);
    }

    expect_read(initiator, second, payload);
    const auto here = initiator.split(), there = responder.split();
    base::ensure(here.handshake == there.handshake);
    base::ensure(std::ranges::equal(here.to_other.bytes(), there.from_other.bytes()));
    base::ensure(std::ranges::equal(here.from_other.bytes(), there.to_other.bytes()));
    return 0;
}
