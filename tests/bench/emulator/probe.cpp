// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/emulator/probe.hpp"

#include "proto/base/random.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/wait.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <linux/filter.h>
#include <linux/sock_diag.h>
#include <sys/socket.h>
#include <tuple>
#include <utility>

namespace hapnet::bench {

namespace {

using namespace std::chrono_literals;

constexpr std::size_t burst_max = net::BatchSender::batch_max;

/// The silence of the path after which missing datagrams count as lost.
constexpr base::Duration quiet = 60ms;

/// The lateness up to which a rate counts as kept up.
constexpr base::Duration grace = 10ms;

/// A longer send call was interrupted.
constexpr base::Duration send_max = 1ms;

/// A SCHED_FIFO thread must sleep at times, or the kernel's own threads do not run.
constexpr base::Duration awake_max = 10ms;
constexpr base::Duration rest = 50us;

net::Endpoint any_port() { return net::resolve({"127.0.0.1", 0}); }

/// The datagrams that the kernel has dropped at this socket.
std::uint32_t drops(int descriptor)
{
    std::array<std::uint32_t, SK_MEMINFO_VARS> numbers{};
    socklen_t length = sizeof numbers;
    std::ignore = getsockopt(descriptor, SOL_SOCKET, SO_MEMINFO, numbers.data(), &length);
    return numbers[SK_MEMINFO_DROPS];
}

} // namespace

double Tally::missing() const
{
    if (sent == 0) return 0.0;
    return static_cast<double>(sent - std::min(received, sent)) / static_cast<double>(sent);
}

Prober::Prober(Sending sending)
    : sending_{sending},
      a_{any_port()},
      b_{any_port(), sending == Sending::offload ? net::Load::bulk : net::Load::stream},
      burst_(burst_max * payload_bytes)
{}

void Prober::begin()
{
    first_number_ = next_number_;
    highest_ = next_number_;
    overflowed_ = b_.overflowed();
    sunk_ = drops(b_.descriptor());
    tally_ = {};
    sent_at_.clear();
    stopped_.clear();
    errors_.clear();
    due_.clear();
}

TimingTrial Prober::measure_timing(const Load& load)
{
    begin();
    const auto count = static_cast<std::uint64_t>(base::to_seconds(load.duration) * load.rate);
    errors_.reserve(count);
    due_.reserve(count);
    sent_at_.reserve(count);
    const auto phase = base::Seed{1}.stream("bench/phase");
    std::array<std::byte, payload_bytes> payload{};
    auto when = net::monotonic_now() + 1ms;
    for (std::uint64_t i = 0; i < count; ++i) {
        when += base::from_seconds((0.5 + phase.uniform(i)) / load.rate);
        net::sleep_until(when);
        const Note note{next_number_++, net::monotonic_now()};
        std::memcpy(payload.data(), &note, sizeof note);
        sent_at_.push_back(note.sent_at);
        if (a_.send(load.to, payload) == net::SendOutcome::sent) ++tally_.sent;
        if (net::monotonic_now() - note.sent_at > send_max) stopped_.push_back(note.sent_at);
        receive(load);
    }
    receive_rest(load);
    std::vector<base::Duration> beside;
    for (std::size_t i = 0; i < errors_.size(); ++i) {
        if (has_sent_shortly_before(due_[i])) beside.push_back(errors_[i]);
    }
    auto departures = this->departures(load.delay);
    std::sort(beside.begin(), beside.end());
    std::sort(errors_.begin(), errors_.end());
    return {errors_, beside, std::move(departures), tally_};
}

std::vector<Departure> Prober::departures(base::Duration delay) const
{
    std::vector<Departure> departures;
    departures.reserve(errors_.size());
    for (std::size_t i = 0; i < errors_.size(); ++i) {
        if (std::binary_search(stopped_.begin(), stopped_.end(), due_[i] - delay)) continue;
        departures.push_back({due_[i], errors_[i]});
    }
    return departures;
}

/// True if a datagram other than the one due was sent shortly before.
bool Prober::has_sent_shortly_before(base::TimePoint due) const
{
    const auto next = std::lower_bound(sent_at_.begin(), sent_at_.end(), due);
    return next != sent_at_.begin() && due - *(next - 1) <= TimingTrial::shortly;
}

RateTrial Prober::measure_rate(const Load& load)
{
    if (sending_ == Sending::ordinary && !is_sink_) make_sink();
    std::ignore = connect(a_.descriptor(), load.to.address(), load.to.length());
    begin();
    const auto start = net::monotonic_now();
    auto now = start;
    auto slept = start;
    while (now - start < load.duration) {
        const auto wanted = load.rate * base::to_seconds(now - start);
        if (static_cast<double>(tally_.sent + burst_max) <= wanted) send_burst(load.to);
        receive(load);
        now = net::monotonic_now();
        if (now - slept > awake_max) net::sleep_until(slept = now + rest);
    }
    receive_until(load, now + load.delay + grace);
    const double missing = tally_.missing();
    receive_rest(load);
    const double took = base::to_seconds(now - start);
    return {tally_, static_cast<double>(tally_.sent) / took, missing};
}

void Prober::make_sink()
{
    sock_filter drop_all{BPF_RET | BPF_K, 0, 0, 0};
    const sock_fprog program{1, &drop_all};
    is_sink_ =
        setsockopt(b_.descriptor(), SOL_SOCKET, SO_ATTACH_FILTER, &program, sizeof program) == 0;
}

void Prober::send_burst(const net::Endpoint& to)
{
    std::array<std::span<const std::byte>, burst_max> datagrams;
    std::array<iovec, burst_max> vectors{};
    std::array<mmsghdr, burst_max> headers{};
    const Note stamp{0, net::monotonic_now()};
    for (std::size_t i = 0; i < burst_max; ++i) {
        const Note note{next_number_++, stamp.sent_at};
        std::byte* const place = burst_.data() + i * payload_bytes;
        std::memcpy(place, &note, sizeof note);
        datagrams[i] = {place, payload_bytes};
        vectors[i] = {place, payload_bytes};
        headers[i].msg_hdr.msg_iov = &vectors[i];
        headers[i].msg_hdr.msg_iovlen = 1;
    }
    if (sending_ == Sending::offload) {
        for (const auto outcome : a_.send_batch(to, datagrams)) {
            if (outcome == net::SendOutcome::sent) ++tally_.sent;
        }
        return;
    }
    const int sent = sendmmsg(a_.descriptor(), headers.data(), burst_max, 0);
    if (sent > 0) tally_.sent += static_cast<std::uint64_t>(sent);
}

/// Receives all that has arrived. Datagrams that our own socket dropped have passed the path, too.
void Prober::receive(const Load& load)
{
    if (is_sink_) {
        const auto sunk = drops(b_.descriptor());
        tally_.received += static_cast<std::uint32_t>(sunk - sunk_);
        sunk_ = sunk;
        return;
    }
    for (const net::Received& datagram : b_.receive()) {
        Note note;
        if (datagram.bytes.size() != payload_bytes) continue;
        std::memcpy(&note, datagram.bytes.data(), sizeof note);
        if (note.number < first_number_ || note.number >= next_number_) continue;
        ++tally_.received;
        if (note.number < highest_) ++tally_.reordered;
        highest_ = std::max(highest_, note.number);
        if (errors_.size() < errors_.capacity()) {
            errors_.push_back(datagram.at - note.sent_at - load.delay);
            due_.push_back(note.sent_at + load.delay);
        }
    }
    tally_.received += b_.overflowed() - overflowed_;
    overflowed_ = b_.overflowed();
}

void Prober::receive_until(const Load& load, base::TimePoint end)
{
    while (tally_.received < tally_.sent && net::monotonic_now() < end) {
        net::wait_readable(std::array{b_.descriptor()}, net::monotonic_now() + 1ms);
        receive(load);
    }
}

void Prober::receive_rest(const Load& load)
{
    auto silent_since = net::monotonic_now();
    while (tally_.received < tally_.sent) {
        const auto before = tally_.received;
        net::wait_readable(std::array{b_.descriptor()}, net::monotonic_now() + 1ms);
        receive(load);
        const auto now = net::monotonic_now();
        if (tally_.received > before) silent_since = now;
        if (now - silent_since > load.delay + quiet) return;
    }
}

} // namespace hapnet::bench
