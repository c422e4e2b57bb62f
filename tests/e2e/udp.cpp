// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/e2e/udp.hpp"

#include "proto/base/bytes.hpp"
#include "proto/base/ensure.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/wait.hpp"

#include <array>
#include <string>

namespace hapnet::e2e {

namespace {

constexpr std::size_t numbered_bytes = 100;

} // namespace

net::Endpoint endpoint_of(std::string_view text)
{
    return net::resolve(net::parse_host_port(text).value());
}

net::Endpoint endpoint_in(std::string_view ready_line, std::string_view key)
{
    const auto begin = ready_line.find(' ' + std::string{key} + '=');
    base::ensure(begin != std::string_view::npos);
    const auto value = ready_line.substr(begin + key.size() + 2);
    return endpoint_of(value.substr(0, value.find(' ')));
}

Host::Host(std::string_view local) : socket_{endpoint_of(local)} {}

void Host::send(const net::Endpoint& to, std::uint64_t number)
{
    std::array<std::byte, numbered_bytes> buffer{};
    base::ByteWriter out{buffer};
    out.u64(number);
    out.i64(net::monotonic_now().time_since_epoch().count());
    send_bytes(to, buffer);
}

void Host::send_bytes(const net::Endpoint& to, std::span<const std::byte> bytes)
{
    base::ensure(socket_.send(to, bytes) == net::SendOutcome::sent);
}

const std::vector<Arrival>& Host::arrivals()
{
    for (auto batch = socket_.receive(); !batch.empty(); batch = socket_.receive()) {
        for (const net::Received& datagram : batch) {
            if (datagram.bytes.size() != numbered_bytes) continue;
            base::ByteReader in{datagram.bytes};
            const auto number = in.u64();
            const base::TimePoint sent{base::Duration{in.i64()}};
            arrivals_.push_back({number, datagram.at - sent});
        }
    }
    return arrivals_;
}

const std::vector<Arrival>& Host::receive(std::size_t count, std::chrono::milliseconds quiet)
{
    const std::array descriptors{socket_.descriptor()};
    for (;;) {
        const auto before = arrivals_.size();
        if (arrivals().size() >= count) return arrivals_;
        if (arrivals_.size() > before) continue;
        net::wait_readable(descriptors, net::monotonic_now() + quiet);
        if (arrivals().size() == before) return arrivals_;
    }
}

void stream(Host& from, const net::Endpoint& to, std::uint64_t count, base::Duration spacing)
{
    const auto start = net::monotonic_now();
    for (std::uint64_t number = 0; number < count; ++number) {
        net::sleep_until(start + static_cast<std::int64_t>(number) * spacing);
        from.send(to, number);
    }
}

std::vector<std::uint64_t> numbers_of(const std::vector<Arrival>& arrivals)
{
    std::vector<std::uint64_t> numbers;
    for (const Arrival& arrival : arrivals) numbers.push_back(arrival.number);
    return numbers;
}

} // namespace hapnet::e2e
