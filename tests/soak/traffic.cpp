// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/soak/traffic.hpp"

#include "proto/net/clock.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <stdexcept>
#include <string>
#include <utility>
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

std::string line(std::int64_t seconds, const Memory& memory)
{
    return fmt::format("  {:4} s  VmRSS {} KiB  VmData {} KiB\n", seconds, memory.resident,
                       memory.data);
}

void expect_flat(const std::vector<Memory>& memory)
{
    constexpr std::int64_t growth_max_kib = 1024;
    const std::size_t warm = std::min<std::size_t>(60, memory.size() / 5);
    ASSERT_GE(warm, 5U) << "too short to say anything: at least 25 s";
    const Memory& first = memory[warm - 1];
    Memory most = first;
    for (auto i = warm; i < memory.size(); ++i) {
        most.resident = std::max(most.resident, memory[i].resident);
        most.data = std::max(most.data, memory[i].data);
    }
    const auto seconds = static_cast<std::int64_t>(memory.size());
    fmt::print("{}{}  most    VmRSS +{} KiB  VmData +{} KiB\n",
               line(static_cast<std::int64_t>(warm), first), line(seconds, memory.back()),
               most.resident - first.resident, most.data - first.data);
    EXPECT_LT(most.resident - first.resident, growth_max_kib);
    EXPECT_LT(most.data - first.data, growth_max_kib);
}

Traffic::Traffic(std::size_t senders) : b_{any_port(), net::Load::bulk}
{
    for (std::size_t i = 0; i < senders; ++i) {
        a_.push_back(std::make_unique<net::UdpSocket>(any_port(), net::Load::bulk));
    }
}

Traffic::~Traffic() { stop(); }

void Traffic::start(std::int64_t per_second, std::vector<net::Endpoint> for_a,
                    std::vector<net::Endpoint> for_b)
{
    Target target{per_second, std::move(for_a), std::move(for_b)};
    target.answers = target.for_b.empty();
    thread_ = std::thread{[this, target = std::move(target)] { run(target); }};
}

void Traffic::stop()
{
    stop_ = true;
    if (thread_.joinable()) thread_.join();
}

void Traffic::run(Target target)
{
    const auto per_tick = target.per_second / 1000;
    const auto start = net::monotonic_now();
    for (auto tick = start; !stop_; tick += 1ms) {
        net::sleep_until(tick);
        const bool is_beginning = tick < start + beginning;
        const auto ticks = (tick - start) / 1ms + 1;
        const auto extra = (beginning_factor - 1) * std::min(ticks, beginning / 1ms);
        const auto behind = (ticks + extra) * per_tick - static_cast<std::int64_t>(number_);
        // A backlog after a pause is sent faster, but never faster than at the beginning.
        const auto most = (is_beginning ? beginning_factor : beginning_factor / 2) * per_tick;
        send(target, static_cast<std::uint64_t>(std::min(behind, most)));
        drain(target);
        tick = std::max(tick, net::monotonic_now() - 1ms);
    }
    for (int i = 0; i < 1000; ++i) {
        net::sleep_until(net::monotonic_now() + 1ms);
        drain(target);
    }
}

void Traffic::send(const Target& target, std::uint64_t count)
{
    std::array<std::span<const std::byte>, net::BatchSender::batch_max> batch;
    std::uint64_t taken = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
        batch[i] = payload_of(number_ + i);
        const auto turn = static_cast<std::size_t>(number_ + i);
        const auto& place = target.for_a[turn % target.for_a.size()];
        if (a_[turn % a_.size()]->send(place, batch[i]) == net::SendOutcome::sent) ++taken;
    }
    if (!target.for_b.empty()) {
        const auto& place =
            target.for_b[static_cast<std::size_t>(batches_++) % target.for_b.size()];
        for (const auto outcome : b_.send_batch(place, {batch.data(), count})) {
            if (outcome == net::SendOutcome::sent) ++taken;
        }
    }
    number_ += count;
    sent_.fetch_add(taken, std::memory_order_relaxed);
}

void Traffic::drain(Target& target)
{
    for (const auto& socket : a_) {
        while (!socket->receive().empty()) continue;
    }
    for (auto arrived = b_.receive(); !arrived.empty(); arrived = b_.receive()) {
        if (!target.answers) continue;
        for (const net::Received& datagram : arrived) {
            if (std::ranges::find(target.for_b, datagram.from) == target.for_b.end()) {
                target.for_b.push_back(datagram.from);
            }
        }
    }
}

} // namespace hapnet::soak
