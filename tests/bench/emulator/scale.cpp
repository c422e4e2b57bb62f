// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/emulator/scale.hpp"

#include "proto/base/random.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/udp_socket.hpp"
#include "proto/net/wait.hpp"
#include "tests/bench/emulator/lateness.hpp"
#include "tests/bench/emulator/machine.hpp"
#include "tests/bench/emulator/probe.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <memory>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <tuple>

namespace hapnet::bench {

namespace {

using namespace std::chrono_literals;

constexpr base::Duration path_delay = 10ms;
constexpr double rate_of_one = 1000.0; // datagrams per second
constexpr std::size_t clients_most = 64;
constexpr std::size_t links_most = 28; // a mesh of eight peers

net::UdpSocket open_anywhere(net::Load load)
{
    return net::UdpSocket{net::resolve({"127.0.0.1", 0}), load};
}

/// The endpoint after NAME= in a ready line; of two with a comma the first.
net::Endpoint endpoint_after(const std::string& name, const std::string& ready)
{
    const auto begin = ready.find(" " + name + "=") + name.size() + 2;
    const auto place =
        net::parse_host_port(ready.substr(begin, ready.find_first_of(" ,", begin) - begin));
    return net::resolve(place.value());
}

/// One or many senders, and the end that receives all of their datagrams.
class Crowd {
public:
    explicit Crowd(std::size_t senders)
    {
        for (std::size_t i = 0; i < senders; ++i) {
            senders_.push_back(std::make_unique<net::UdpSocket>(open_anywhere(net::Load::stream)));
        }
    }

    [[nodiscard]] net::Endpoint end() const { return end_.local(); }

    /// Aims the n-th sender at the n-th place. A single sender aims at all places, and a single
    /// place is the aim of all.
    void aim(std::vector<net::Endpoint> places) { places_ = std::move(places); }

    /// Sends single datagrams to each place in turn for `duration`, and returns their sorted
    /// lateness.
    std::vector<base::Duration> lateness(double rate, base::Duration duration)
    {
        const auto count = static_cast<std::uint64_t>(base::to_seconds(duration) * rate);
        late_.clear();
        const auto phase = base::Seed{1}.stream("bench/phase");
        auto when = net::monotonic_now() + 1ms;
        constexpr std::uint64_t sent_between = 8; // receiving costs more than it finds
        for (std::uint64_t i = 0; i < count; ++i) {
            when += base::from_seconds((0.5 + phase.uniform(i)) / rate);
            net::sleep_until(when);
            send(i);
            if (i % sent_between == 0) receive();
        }
        receive_until(net::monotonic_now() + path_delay + 60ms);
        std::ranges::sort(late_);
        return late_;
    }

    /// Sends batches to each place in turn for a duration, and returns how many datagrams came out.
    std::uint64_t flood(double rate, base::Duration duration)
    {
        const std::array<std::byte, payload_bytes> payload{};
        const std::vector<std::span<const std::byte>> batch(net::BatchSender::batch_max, payload);
        arrived_ = 0;
        const auto start = net::monotonic_now();
        std::uint64_t sent = 0;
        for (auto now = start; now - start < duration; now = net::monotonic_now()) {
            if (static_cast<double>(sent) > rate * base::to_seconds(now - start)) {
                receive();
                net::sleep_until(now + 50us);
                continue;
            }
            const auto turn = static_cast<std::size_t>(sent / batch.size());
            std::ignore =
                senders_[turn % senders_.size()]->send_batch(places_[turn % places_.size()], batch);
            sent += batch.size();
            receive();
        }
        receive_until(net::monotonic_now() + path_delay + 60ms);
        return arrived_;
    }

private:
    void send(std::uint64_t number)
    {
        std::array<std::byte, payload_bytes> payload{};
        const auto now = net::monotonic_now();
        std::memcpy(payload.data(), &now, sizeof now);
        std::ignore =
            senders_[number % senders_.size()]->send(places_[number % places_.size()], payload);
    }

    void receive()
    {
        for (const net::Received& datagram : end_.receive()) {
            base::TimePoint sent_at;
            std::memcpy(&sent_at, datagram.bytes.data(), sizeof sent_at);
            ++arrived_;
            late_.push_back(datagram.at - sent_at - path_delay);
        }
    }

    void receive_until(base::TimePoint end)
    {
        while (net::monotonic_now() < end) {
            net::wait_readable(std::array{end_.descriptor()}, net::monotonic_now() + 1ms);
            receive();
        }
    }

    net::UdpSocket end_ = open_anywhere(net::Load::bulk);
    std::vector<std::unique_ptr<net::UdpSocket>> senders_;
    std::vector<net::Endpoint> places_;
    std::vector<base::Duration> late_;
    std::uint64_t arrived_ = 0;
};

double median(std::vector<double> values)
{
    std::ranges::sort(values);
    return values[values.size() / 2];
}

std::vector<std::string> with_common(const Plan& plan, std::vector<std::string> words)
{
    words.insert(words.begin(), plan.emulator);
    words.insert(words.end(), {"--delay", fmt::format("{}ns", path_delay.count())});
    return words;
}

/// Returns the options for links of a mesh between one place and another.
std::vector<std::string> links(std::size_t count, const net::Endpoint& end)
{
    std::vector<std::string> words;
    for (std::size_t i = 0; i < count; ++i) {
        words.insert(words.end(),
                     {"--link", fmt::format("l{}=127.0.0.1:0,127.0.0.1:0,,{}", i, end.to_text())});
    }
    return words;
}

std::vector<net::Endpoint> places_of_links(std::size_t count, const std::string& ready)
{
    std::vector<net::Endpoint> places;
    for (std::size_t i = 0; i < count; ++i) {
        places.push_back(endpoint_after(fmt::format("l{}", i), ready));
    }
    return places;
}

/// Returns the lateness of `clients` clients of a server, together at this rate.
double late_clients(const Plan& plan, std::size_t clients, double rate, Standing standing)
{
    Crowd crowd{clients};
    const RelayProcess relay{
        with_common(plan, {"--listen", "127.0.0.1:0", "--upstream", crowd.end().to_text()}),
        standing};
    crowd.aim({endpoint_after("listen", relay.ready())});
    std::ignore = crowd.lateness(rate, 50ms); // gives each client its socket and its path
    return quantile_us(crowd.lateness(rate, plan.quick ? 200ms : 1s), 0.99);
}

/// As late_clients(), for links.
double late_links(const Plan& plan, std::size_t count, double rate, Standing standing)
{
    Crowd crowd{1};
    const RelayProcess relay{with_common(plan, links(count, crowd.end())), standing};
    crowd.aim(places_of_links(count, relay.ready()));
    std::ignore = crowd.lateness(rate, 50ms);
    return quantile_us(crowd.lateness(rate, plan.quick ? 200ms : 1s), 0.99);
}

Row row(std::string name, std::string subject, std::string baseline, std::string metric)
{
    return {.name = std::move(name),
            .subject = std::move(subject),
            .baseline = std::move(baseline),
            .metric = std::move(metric),
            .value = 0.0,
            .baseline_value = std::nullopt,
            .target = std::nullopt};
}

/// `measure(count)` measures with that number of paths.
Row compare_lateness(const std::string& paths, std::size_t count, int rounds, const auto& measure)
{
    std::vector<double> many;
    std::vector<double> one;
    for (int round = 0; round < rounds; ++round) {
        fmt::print(stderr, "scale: round {} of {}: {} {}\n", round + 1, rounds, count, paths);
        many.push_back(measure(count));
        one.push_back(measure(1));
    }
    Row result = row(fmt::format("{} {} x 1 kpps, {} ms", count, paths, path_delay / 1ms),
                     fmt::format("{} {}", count, paths), "one at their rate", "p99_ratio");
    result.value = median(many);
    result.baseline_value = median(one);
    // The ratio is baseline / value: at most 1.5 times as late.
    result.target = 1.0 / 1.5;
    result.direction = Direction::at_least;
    return result;
}

/// Datagrams for each second of processor time that the relay uses, of all its threads.
double datagrams_per_second(const Plan& plan, int threads, Standing standing)
{
    constexpr std::size_t count = 4;
    constexpr double rate = 200'000.0;
    Crowd crowd{1};
    auto words = links(count, crowd.end());
    words.insert(words.end(), {"--threads", std::to_string(threads), "--timing", "eco"});
    const RelayProcess relay{with_common(plan, words), standing};
    crowd.aim(places_of_links(count, relay.ready()));
    std::ignore = crowd.flood(rate, 20ms);
    const auto used = relay.used();
    const auto arrived = crowd.flood(rate, plan.quick ? 200ms : 1s);
    return static_cast<double>(arrived) / base::to_seconds(relay.used() - used);
}

Row compare_threads(const Plan& plan, int rounds, Standing standing)
{
    std::vector<double> two;
    std::vector<double> one;
    for (int round = 0; round < rounds; ++round) {
        fmt::print(stderr, "scale: round {} of {}: two threads\n", round + 1, rounds);
        two.push_back(datagrams_per_second(plan, 2, standing));
        one.push_back(datagrams_per_second(plan, 1, standing));
    }
    Row result = row(fmt::format("4 links, {} ms, offloading senders", path_delay / 1ms),
                     "--threads 2", "--threads 1", "per_cpu_second_ratio");
    result.value = median(two);
    result.baseline_value = median(one);
    result.target = 1.0 / 0.85; // of baseline / value
    return result;
}

} // namespace

std::vector<Row> measure_scale(const Plan& plan, bool fifo)
{
    const auto standing = fifo ? Standing::real_time : Standing::ordinary;
    constexpr int rounds = 3;
    set_real_time(fifo);
    std::vector<Row> rows;
    rows.push_back(compare_lateness("clients", clients_most, rounds, [&](std::size_t clients) {
        return late_clients(plan, clients, rate_of_one * clients_most, standing);
    }));
    rows.push_back(compare_lateness("links", links_most, rounds, [&](std::size_t count) {
        return late_links(plan, count, rate_of_one * links_most, standing);
    }));
    rows.push_back(compare_threads(plan, rounds, standing));
    set_real_time(false);
    return rows;
}

} // namespace hapnet::bench
