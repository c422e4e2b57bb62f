// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/soak/traffic.hpp"

#include "proto/net/clock.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace hapnet::soak {

using namespace std::chrono_literals;

namespace {

constexpr std::array<std::byte, 1500> payload{};

std::span<const std::byte> payload_of(std::uint64_t number)
{
    const std::uint64_t place = number % 100;
    if (place == 99) return payload;
    return std::span{payload}.first(place % 11 == 10 ? 1000 : 100);
}

constexpr base::Duration beginning = 1s;
constexpr std::int64_t beginning_factor = 4;

net::Endpoint any_port() { return net::resolve({"127.0.0.1", 0}); }

} // namespace

std::int64_t setting(const char* name, std::int64_t usual)
{
    const char* text = std::getenv(name);
    return text != nullptr ? std::stoll(text) : usual;
}

Memory memory_of(pid_t pid)
{
    std::ifstream status{"/proc/" + std::to_string(pid) + "/status"};
    Memory memory;
    for (std::string line; std::getline(status, line);) {
        if (line.starts_with("VmRSS:")) memory.resident = std::stoll(line.substr(6));
        if (line.starts_with("VmData:")) memory.data = std::stoll(line.substr(7));
    }
    if (memory.resident == 0) throw std::runtime_error{"no program " + std::to_string(pid)};
    return memory;
}

Traffic::Traffic() : a_{any_port(), net::Load::bulk}, b_{any_port(), net::Load::bulk} {}

Traffic::~Traffic() { stop(); }

void Traffic::start(std::int64_t per_second, const net::Endpoint& for_a, const net::Endpoint& for_b)
{
    thread_ = std::thread{[this, target = Target{per_second, for_a, for_b}] { run(target); }};
}

void Traffic::stop()
{
    stop_ = true;
    if (thread_.joinable()) thread_.join();
}

void Traffic::run(const Target& target)
{
    const auto per_tick = target.per_second / 1000;
    const auto start = net::monotonic_now();
    for (auto tick = start; !stop_; tick += 1ms) {
        net::sleep_until(tick);
        const bool is_beginning = tick < start + beginning;
        const auto ticks = (tick - start) / 1ms + 1;
        const auto extra = (beginning_factor - 1) * std::min(ticks, beginning / 1ms);
        const auto behind = (ticks + extra) * per_tick - static_cast<std::int64_t>(number_);
        // What a pause left behind is made up for, but never faster than the beginning was.
        const auto most = (is_beginning ? beginning_factor : beginning_factor / 2) * per_tick;
        send(target, static_cast<std::uint64_t>(std::min(behind, most)));
        drain();
        tick = std::max(tick, net::monotonic_now() - 1ms);
    }
    for (int i = 0; i < 1000; ++i) {
        net::sleep_until(net::monotonic_now() + 1ms);
        drain();
    }
}

void Traffic::send(const Target& target, std::uint64_t count)
{
    std::array<std::span<const std::byte>, net::BatchSender::batch_max> batch;
    std::uint64_t taken = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
        batch[i] = payload_of(number_ + i);
        if (a_.send(target.for_a, batch[i]) == net::SendOutcome::sent) ++taken;
    }
    for (const auto outcome : b_.send_batch(target.for_b, {batch.data(), count})) {
        if (outcome == net::SendOutcome::sent) ++taken;
    }
    number_ += count;
    sent_.fetch_add(taken, std::memory_order_relaxed);
}

void Traffic::drain()
{
    while (!a_.receive().empty()) continue;
    while (!b_.receive().empty()) continue;
}

} // namespace hapnet::soak
