// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "ctl/connection.hpp"

#include "proto/net/clock.hpp"
#include "proto/net/wait.hpp"

#include <array>
#include <string_view>
#include <vector>

namespace hapnet::ctl {

using TransferState = net::Transfer::State;

Connection::Connection(const std::string& path, net::StopSignal& stop)
    : stop_{stop}, stream_{net::UnixStream::connect(path)}
{
    wait_set_.add(stream_.descriptor(), 0, {});
}

Connection::State Connection::send(std::string_view line, base::TimePoint deadline)
{
    const std::string text = std::string{line} + "\n";
    std::string_view rest = text;
    while (!rest.empty()) {
        const auto sent = stream_.write(rest);
        if (sent.state == TransferState::moved) {
            rest.remove_prefix(sent.bytes);
        } else if (sent.state == TransferState::later) {
            const State state = wait({.to_write = true}, deadline);
            if (state != State::good) return state;
        } else {
            return State::good; // lines that it sent before it closed may say why
        }
    }
    return State::good;
}

Connection::State Connection::receive(std::optional<base::TimePoint> deadline)
{
    std::vector<char> buffer(std::size_t{64} << 10);
    while (true) {
        if (const auto end = input_.find('\n'); end != std::string::npos) {
            line_ = input_.substr(0, end);
            input_.erase(0, end + 1);
            return State::good;
        }
        const auto taken = stream_.read(buffer);
        if (taken.state == TransferState::moved) {
            input_.append(buffer.data(), taken.bytes);
        } else if (taken.state == TransferState::later) {
            const State state = wait({.to_read = true}, deadline);
            if (state != State::good) return state;
        } else {
            return State::closed;
        }
    }
}

Connection::State Connection::wait(net::WaitSet::Interest interest,
                                   std::optional<base::TimePoint> deadline)
{
    wait_set_.change(stream_.descriptor(), 0, interest);
    net::wait_readable(std::array{wait_set_.descriptor(), stop_.descriptor()}, deadline);
    if (stop_.requested()) return State::stopped;
    return base::is_due(deadline, net::monotonic_now()) ? State::late : State::good;
}

} // namespace hapnet::ctl
