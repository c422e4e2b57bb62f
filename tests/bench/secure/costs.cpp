// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/secure/costs.hpp"

#include "proto/secure/key_file.hpp"
#include "tests/bench/common/timing.hpp"
#include "tests/bench/secure/circle.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>

namespace hapnet::bench {

namespace {

using namespace std::chrono_literals;

using lab::virtual_time::Setting;
using Bytes = Circle::Bytes;

Setting setting_of(bool is_keyed)
{
    Setting setting;
    setting.length = 24h;
    if (is_keyed) {
        for (auto& player : setting.players) player.circle = base::Seed{1};
    }
    return setting;
}

/// Two associations that share a circle, for the costs of a side besides its turns.
secure::StaticKeys keys_of(const secure::KeyFile& file)
{
    return file.keys_with(file.others.front());
}

std::array<std::unique_ptr<secure::Association>, 2> associations(std::uint8_t seed)
{
    secure::prepare();
    std::array<std::unique_ptr<secure::Association>, 2> both;
    secure::Entropy entropy{secure::Secret{}};
    const auto files = secure::make_circle("bench", 2, entropy);
    for (const std::size_t side : {0U, 1U}) {
        secure::Association::Config config;
        config.own_id = files[side].id;
        config.other_id = files[side].others.front().id;
        config.run = static_cast<std::uint32_t>(side + 1);
        config.place = secure::Place{};
        config.session_of = wire::session_number;
        secure::Secret secret;
        secret.bytes()[0] = std::byte{seed};
        secret.bytes()[1] = static_cast<std::byte>(side);
        both.at(side) =
            std::make_unique<secure::Association>(config, keys_of(files[side]), std::move(secret));
    }
    return both;
}

struct HandshakeCost {
    double all_ns = 0.0;
    double longest_tick_ns = 0.0;
};

/// Runs both sides until both have a key, and times their calls.
HandshakeCost handshake(std::uint8_t seed)
{
    auto both = associations(seed);
    HandshakeCost cost;
    base::TimePoint now{1000s};
    for (int tick = 0; tick < 200 && both[1]->counts().handshakes == 0; ++tick, now += 1ms) {
        for (const std::size_t side : {0U, 1U}) {
            secure::Association& here = *both.at(side);
            const std::int64_t begin = clock_ns();
            here.tick({now, now.time_since_epoch().count()});
            std::vector<secure::HandshakeFrame> frames;
            while (const auto out = here.poll()) frames.push_back(out->frame);
            const auto took = static_cast<double>(clock_ns() - begin);
            cost.all_ns += took;
            cost.longest_tick_ns = std::max(cost.longest_tick_ns, took);
            for (const auto& frame : frames) {
                Bytes bytes{frame.bytes().begin(), frame.bytes().end()};
                std::ignore = both.at(1 - side)->on_datagram(bytes, {}, now);
            }
            if (!here.has_key(now)) continue;
            wire::Hello hello;
            hello.nonce = static_cast<std::uint32_t>(side + 1);
            hello.peer_id = 1;
            hello.task = wire::TaskName::from_text("P1").value();
            const wire::Datagram plain = wire::encode(hello);
            Bytes room{plain.bytes().begin(), plain.bytes().end()};
            room.resize(room.size() + secure::control_overhead);
            if (const auto size = here.seal(room, plain.bytes().size(), now))
                std::ignore = both.at(1 - side)->on_datagram(std::span{room}.first(*size), {}, now);
        }
    }
    return cost;
}

/// Sealing and opening a state with one body, ns.
std::vector<double> times_of_a_state(int count)
{
    secure::Sealer sealer{secure::Secret{}};
    secure::Opener opener{secure::Secret{}};
    wire::State state;
    state.bodies.add({});
    std::vector<double> times;
    for (int i = 1; i <= count; ++i) {
        state.sequence = static_cast<std::uint32_t>(i);
        const wire::Datagram plain = wire::encode(state);
        Bytes room{plain.bytes().begin(), plain.bytes().end()};
        room.resize(room.size() + secure::control_overhead);
        const std::int64_t begin = clock_ns();
        const auto size = secure::seal_frame(room, plain.bytes().size(), 7, 0, sealer);
        std::ignore = secure::open_frame(std::span{room}.first(*size), opener);
        times.push_back(static_cast<double>(clock_ns() - begin));
    }
    return times;
}

/// The time to reject a changed state with a key in use and an acceptable number, ns.
std::vector<double> times_of_a_forgery(int count)
{
    Circle pair{setting_of(true)};
    for (int i = 0; i < 2000; ++i) std::ignore = pair.turn();
    std::ignore = pair.turn();
    Bytes forged = pair.newest();
    std::vector<double> times;
    for (int i = 0; i < count; ++i) {
        forged.back() = static_cast<std::byte>(i);
        forged[9] = static_cast<std::byte>(i / 7 + 100); // of its number: far ahead
        const std::int64_t begin = clock_ns();
        pair.measured().receive(0, forged, pair.now());
        times.push_back(static_cast<double>(clock_ns() - begin));
    }
    return times;
}

Row row_of(std::string name, std::string metric, double value, std::optional<double> target)
{
    return {.name = std::move(name),
            .subject = "proto/secure",
            .baseline = "",
            .metric = std::move(metric),
            .value = value,
            .baseline_value = std::nullopt,
            .target = target};
}

void add_turns(std::vector<Row>& rows, int blocks, double clock)
{
    Circle keyed{setting_of(true)}, plain{setting_of(false)};
    std::vector<double> with, without;
    for (int i = 0; i < 2000; ++i) { // the session begins
        std::ignore = keyed.turn();
        std::ignore = plain.turn();
    }
    for (int block = 0; block < blocks; ++block) {
        for (int i = 0; i < turns_a_block; ++i) with.push_back(keyed.turn());
        for (int i = 0; i < turns_a_block; ++i) without.push_back(plain.turn());
    }
    const double p50 = quantile(with, 0.5), p50_plain = quantile(without, 0.5);
    rows.push_back({.name = "a turn of one side, P1",
                    .subject = "with a key",
                    .baseline = "without",
                    .metric = "p50_us",
                    .value = 1e-3 * (p50 - clock),
                    .baseline_value = 1e-3 * (p50_plain - clock),
                    .target = std::nullopt});
    rows.push_back(row_of("what a key adds to a turn", "p50_us", 1e-3 * (p50 - p50_plain), 10.0));
    rows.push_back(row_of("what a key adds to a turn", "p999_us",
                          1e-3 * (quantile(with, 0.999) - quantile(without, 0.999)), 60.0));
}

} // namespace

std::vector<Row> measure_costs_of_keys(int blocks)
{
    const double clock = clock_cost_ns();
    const int many = blocks * turns_a_block;
    std::vector<Row> rows;
    auto states = times_of_a_state(many);
    rows.push_back(row_of("seal and open a state with a body", "p50_us",
                          1e-3 * (quantile(states, 0.5) - clock), 1.5));
    add_turns(rows, blocks, clock);
    auto forgeries = times_of_a_forgery(many);
    rows.push_back(
        row_of("refuse a forged state", "p50_us", 1e-3 * (quantile(forgeries, 0.5) - clock), 1.0));
    rows.push_back(
        row_of("refuse a forged state", "p99_us", 1e-3 * (quantile(forgeries, 0.99) - clock), 1.0));
    std::vector<double> all, longest;
    for (int i = 0; i < std::clamp(blocks, 5, 200); ++i) {
        const HandshakeCost cost = handshake(static_cast<std::uint8_t>(i));
        all.push_back(cost.all_ns);
        longest.push_back(cost.longest_tick_ns);
    }
    rows.push_back(row_of("a handshake, both sides", "p50_us", 1e-3 * quantile(all, 0.5), 1000.0));
    rows.push_back(
        row_of("a handshake, its longest tick", "p50_us", 1e-3 * quantile(longest, 0.5), 120.0));
    return rows;
}

} // namespace hapnet::bench
